// Other dialects of the scene format. dialects/NAME.xml is what another program writes,
// NAME_today.xml the same in today's words, and NAME.notes what the reader has to say. That both
// render to the same picture, bit by bit, tests/post/dialects_test.cpp tests.
#include "io/convert.h"
#include "io/scene_file.h"
#include "scene/scene_hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

using namespace weft;
namespace fs = std::filesystem;

namespace {

fs::path const kFolder = fs::path(WEFT_SOURCE_DIR) / "tests/io/dialects";

std::string read_bytes(fs::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> dialect_scenes() {
    std::vector<std::string> names;
    for (fs::directory_entry const& entry : fs::directory_iterator(kFolder))
        if (entry.path().extension() == ".notes") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// One per line, with file names instead of paths.
std::string lines_of(std::vector<std::string> const& notes) {
    std::string text;
    for (std::string const& note : notes) text += note + "\n";
    std::string const folder = kFolder.string() + "/";
    for (size_t at = 0; (at = text.find(folder, at)) != std::string::npos;)
        text.erase(at, folder.size());
    return text;
}

template <class Variant>
std::string attributes(Variant const& variant) {
    return match(variant, [](auto const& v) {
        return std::string(v.info.type) + schema::write_attributes(v);
    });
}

/// What a file asks for, but for places in it.
std::vector<std::string> summary(io::SceneFile const& file) {
    std::vector<std::string> lines;
    for (scene::RenderJob const& job : file.jobs)
        lines.push_back(attributes(job.integrator) + " " + job.image_name + " " +
                        std::to_string(scene::scene_hash(*job.scene)) +
                        (job.test ? schema::write_attributes(*job.test) + " test" : ""));
    for (scene::PostprocessJob const& job : file.postprocesses) {
        std::string line = attributes(job.postprocess);
        auto const pictures = scene::pictures_of(job.postprocess);
        for (auto const& [name, id] : pictures.inputs)
            line += " " + std::string(name) + "=" + file.pictures[size_t(id.index)].name;
        lines.push_back(line + " " + file.pictures[size_t(pictures.output.index)].name);
    }
    return lines;
}

class Dialect : public testing::TestWithParam<std::string> {
  protected:
    std::string const old_path = (kFolder / (GetParam() + ".xml")).string();
    std::string const today_path = (kFolder / (GetParam() + "_today.xml")).string();
};

TEST_P(Dialect, IsReadAsItIsMeant) {
    io::SceneFile const old = io::read_scene_file(old_path),
                        today = io::read_scene_file(today_path);
    EXPECT_EQ(lines_of(old.notes), read_bytes(kFolder / (GetParam() + ".notes")));
    EXPECT_FALSE(old.notes.empty());
    EXPECT_EQ(lines_of(today.notes), "");
    EXPECT_EQ(summary(old), summary(today));
    EXPECT_FALSE(summary(old).empty());
}

TEST_P(Dialect, IsConverted) {
    std::string const today = read_bytes(today_path);
    io::Converted const once = io::convert_scene(read_bytes(old_path), old_path, today_path);
    EXPECT_EQ(once.text, today);
    EXPECT_EQ(lines_of(once.notes), read_bytes(kFolder / (GetParam() + ".notes")));
    io::Converted const twice = io::convert_scene(today, today_path, today_path);
    EXPECT_EQ(twice.text, today);
    EXPECT_EQ(lines_of(twice.notes), "");
}

INSTANTIATE_TEST_SUITE_P(All, Dialect, testing::ValuesIn(dialect_scenes()),
                         [](auto const& tested) { return tested.param; });

/// Every spelling that a type declares, as help shows it, and every other name of a parameter.
TEST(Dialects, EverySpellingHasACase) {
    std::string all;
    for (std::string const& name : dialect_scenes()) all += read_bytes(kFolder / (name + ".xml"));
    auto const is_there = [&](std::string_view word) {
        return all.find("\"" + std::string(word) + "\"") != std::string::npos ||
               all.find(" " + std::string(word) + "=\"") != std::string::npos ||
               all.find("<" + std::string(word)) != std::string::npos;
    };
    for (schema::Schema const& s : io::all_schemas()) {
        for (schema::Spelling const& spelling : s.info.spellings) {
            EXPECT_FALSE(spelling.today.empty());
            EXPECT_NE(spelling.today.back(), '.') << spelling.today;
            EXPECT_TRUE(is_there(spelling.type.empty() ? spelling.parameter : spelling.type))
                << schema::spelling_text(spelling);
        }
        for (schema::Field const& field : s.fields)
            for (schema::Alias const& alias : field.attr.aliases)
                EXPECT_TRUE(is_there(alias.name)) << alias.name;
    }
}

/// A word that is today's for one type must not be another dialect's for the same.
TEST(Dialects, NoAliasHidesAName) {
    for (schema::Schema const& s : io::all_schemas()) {
        std::set<std::string_view> names;
        for (schema::Field const& field : s.fields) names.insert(field.name);
        for (schema::Field const& field : s.fields)
            for (schema::Alias const& alias : field.attr.aliases)
                EXPECT_TRUE(names.insert(alias.name).second)
                    << s.info.category << " " << s.info.type << ": " << alias.name;
    }
}

std::string convert(std::string const& text) {
    return io::convert_scene(text, "old.xml", "new.xml").text;
}

TEST(Convert, LeavesWhatIsTodaysAlready) {
    for (fs::path const& folder : {fs::path(WEFT_SOURCE_DIR) / "scenes", kFolder / "../bad",
                                   fs::path(WEFT_SOURCE_DIR) / "tests/fuzz/corpus/scene"})
        for (fs::directory_entry const& entry : fs::directory_iterator(folder)) {
            if (entry.path().extension() != ".xml") continue;
            SCOPED_TRACE(entry.path());
            std::string const text = read_bytes(entry.path());
            try {
                io::Converted const converted =
                    io::convert_scene(text, entry.path().string(), entry.path().string());
                bool const changes = std::any_of(
                    converted.notes.begin(), converted.notes.end(), [](std::string const& note) {
                        return note.find("not converted") == std::string::npos;
                    });
                if (!changes) {
                    EXPECT_EQ(converted.text, text);
                }
            } catch (InputError const&) {
                // No XML, or words of a dialect that mean nothing.
            }
        }
}

TEST(Convert, KeepsCommentsLayoutAndUnknownWords) {
    std::string const old =
        "\xef\xbb\xbf<?xml version=\"1.0\"?>\r\n"
        "<!-- who: \"me\" <camera> -->\r\n"
        "<lightwave>\n"
        "\t<default name='r' value='0.1'/>\n"
        "\t<include filename=\"parts.xml\"/>\n"
        "\t<camera   type='thinlens'\n\t\tid='c' fov='30'\tradius='${r}'> <!-- x -->\n"
        "\t\t<float value='3' name='focalDistance'/>\n"
        "\t\t<shiny  value = '&lt;1>'  />\n"
        "\t</camera >\n\n"
        "</lightwave>\n<!-- end -->\n";
    std::string expected = old;
    std::string const tag = "<camera   type='thinlens'\n\t\tid='c' fov='30'\tradius='${r}'>";
    expected.replace(expected.find(tag), tag.size(),
                     "<camera type=\"thinlens\" id=\"c\" fov=\"30\" lensRadius=\"${r}\">");
    expected.replace(expected.find("</camera >"), 10, "</camera>");
    EXPECT_EQ(convert(old), expected);
}

TEST(Convert, FileNamesLeadToWhereTheyLed) {
    std::string const old =
        "<include filename=\"a/parts.xml\"/>"
        "<texture id=\"t\" type=\"image\" filename=\"a/wood.png\"/>"
        "<texture id=\"u\" type=\"image\"><image filename=\"../b.png\"/></texture>"
        "<texture id=\"v\" type=\"image\" filename=\"/c.png\"/>"
        "<shape id=\"s\" type=\"mesh\"><string name=\"filename\" "
        "value=\"m.ply\"/></shape>";
    EXPECT_EQ(io::convert_scene(old, "/x/y/old.xml", "/x/z/new.xml").text,
              "<include filename=\"../y/a/parts.xml\"/>"
              "<texture id=\"t\" type=\"image\" filename=\"../y/a/wood.png\"/>"
              "<texture id=\"u\" type=\"image\" filename=\"../b.png\"></texture>"
              "<texture id=\"v\" type=\"image\" filename=\"/c.png\"/>"
              "<shape id=\"s\" type=\"mesh\" filename=\"../y/m.ply\"></shape>");
}

/// Text that the file spells in another way stays what it says.
TEST(Convert, EscapesWhatItWrites) {
    EXPECT_EQ(convert("<image id='&lt;&quot;&#10;&amp;>' />"),
              "<image id='&lt;&quot;&#10;&amp;>' />");
    EXPECT_EQ(convert("<camera type='thinlens' id='&lt;&quot;&#10;&amp;>' radius='1'/>"),
              "<camera type=\"thinlens\" id=\"&lt;&quot;&#10;&amp;>\" lensRadius=\"1\"/>");
}

TEST(Defaults, StandForVariables) {
    std::string const scene =
        "<default name='wide' value='35'/><default name='wide' value='50'/>"
        "<lightwave><default name='size' value='8'/><scene id='s'><camera type='perspective' "
        "width='${size}0' fov='${wide}'/></scene></lightwave>";
    io::SceneFile const file = io::parse_scene(scene, "s.xml", "");
    auto const& camera = std::get<scene::Perspective>(file.jobs.at(0).scene->cameras.at(0));
    EXPECT_EQ(camera.view.width, 80);
    EXPECT_EQ(camera.fov, 35);
}

TEST(Notes, OnePerFileAndAlias) {
    std::string const lens = "<camera type='thinlens' radius='1'/>";
    io::SceneFile const file =
        io::parse_scene("<scene id='a'>" + lens + "</scene><scene id='b'>\n" + lens + "</scene>" +
                            "<integrator type='direct' nee='true'><ref "
                            "id='a'/></integrator><integrator type='direct' "
                            "nee='true'><ref id='b'/></integrator>",
                        "s.xml", "");
    EXPECT_EQ(
        file.notes,
        (std::vector<std::string>{
            "s.xml:1:39: 'radius' of <camera type=\"thinlens\"> is called `lensRadius` today",
            "s.xml:2:71: 'nee' of <integrator type=\"direct\"> has no effect: this integrator "
            "has one way to find light"}));
}

TEST(Notes, OverridesMayUseBothWords) {
    std::string const scene =
        "<scene><camera type='thinlens' radius='1' focalDistance='2'/></scene>";
    for (char const* o : {"camera.lensRadius=0.5", "camera.focusDistance=3"}) {
        SCOPED_TRACE(o);
        bool const radius = std::string(o).find("lens") != std::string::npos;
        if (!radius) {
            EXPECT_THROW(io::parse_scene(scene, "s.xml", "", {o}), InputError); // given twice
            continue;
        }
        auto const file = io::parse_scene(scene, "s.xml", "", {o});
        EXPECT_EQ(std::get<scene::ThinLens>(file.jobs.at(0).scene->cameras.at(0)).lens_radius,
                  0.5f);
    }
}

} // namespace
