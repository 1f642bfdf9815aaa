// Every scene in bad/ is refused with exactly the message beside it, by the reader and by the
// program.
#include "io/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/wait.h>
#include <unistd.h>

using namespace weft;
namespace fs = std::filesystem;

namespace {

fs::path const kBad = fs::path(WEFT_SOURCE_DIR) / "tests/io/bad";

std::string read_bytes(fs::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> bad_scenes() {
    std::vector<std::string> names;
    for (fs::directory_entry const& entry : fs::directory_iterator(kBad))
        if (entry.path().extension() == ".xml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// `text` with file names instead of paths.
std::string without_folder(std::string text) {
    std::string const folder = kBad.string() + "/";
    for (size_t at = 0; (at = text.find(folder, at)) != std::string::npos;)
        text.erase(at, folder.size());
    return text;
}

std::string expected_message(std::string const& name) {
    std::string text = read_bytes(kBad / (name + ".xml.expected"));
    if (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

class BadScene : public testing::TestWithParam<std::string> {};

TEST_P(BadScene, IsRefusedWithItsMessage) {
    std::string message = "no error";
    try {
        io::read_scene_file((kBad / (GetParam() + ".xml")).string());
    } catch (InputError const& e) {
        message = e.what();
    }
    EXPECT_EQ(without_folder(message), expected_message(GetParam()));
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, BadScene, testing::ValuesIn(bad_scenes()),
                         [](auto const& tested) { return tested.param; });

TEST(BadScenes, CorpusIsThere) { EXPECT_GT(bad_scenes().size(), 100u); }

struct Override {
    char const *text, *message;
};

TEST(BadScenes, OverridesAreRefusedWithTheirMessage) {
    std::string const scene = "<scene id='room'><camera type='perspective'/>"
                              "<light type='point' id='lamp'/></scene>";
    for (Override const& o : {
             Override{"camera.fov", "--set camera.fov: expected PATH.PARAM=VALUE, for example "
                                    "camera.fov=30"},
             {"fov=30", "--set fov=30: expected PATH.PARAM=VALUE, for example camera.fov=30"},
             {".fov=30", "--set .fov=30: expected PATH.PARAM=VALUE, for example camera.fov=30"},
             {"camera.=30", "--set camera.=30: expected PATH.PARAM=VALUE, for example "
                            "camera.fov=30"},
             {"", "--set : expected PATH.PARAM=VALUE, for example camera.fov=30"},
             {"camra.fov=30", "--set camra.fov=30: no object has the id or tag 'camra' (did you "
                              "mean 'camera'?)"},
             {"room.lmap.power=1", "--set room.lmap.power=1: no object has the id or tag 'lmap' "
                                   "(did you mean 'lamp'?)"},
             {"camera.fvo=30", "--set camera.fvo=30: unknown parameter 'fvo' of <camera "
                               "type=\"perspective\"> (did you mean 'fov'?)"},
             {"camera.fov=wide", "--set camera.fov=wide: 'fov' of <camera type=\"perspective\"> "
                                 "expects a number, found 'wide'"},
             {"camera.width=0", "--set camera.width=0: 'width' of <camera type=\"perspective\"> "
                                "expects a value of at least 1 and at most 65536, found '0'"},
             {"lamp.type=sport", "--set lamp.type=sport: unknown type 'sport' of <light> (did you "
                                 "mean 'spot'?)"},
         }) {
        try {
            io::parse_scene(scene, "s.xml", "", {o.text});
            ADD_FAILURE() << "no error for " << o.text;
        } catch (InputError const& e) {
            EXPECT_STREQ(e.what(), o.message);
        }
    }
}

TEST(BadScenes, MissingFileAndFolder) {
    for (auto const& [path, reason] : std::vector<std::pair<std::string, std::string>>{
             {(kBad / "none.xml").string(), "No such file or directory"},
             {kBad.string(), "found a folder"},
             {"/dev/zero", "expected a regular file"}}) {
        try {
            io::read_scene_file(path);
            ADD_FAILURE() << "no error for " << path;
        } catch (InputError const& e) {
            EXPECT_EQ(std::string(e.what()).find(path), 0u) << e.what();
            EXPECT_NE(std::string(e.what()).find(reason), std::string::npos) << e.what();
        }
    }
}

/// A scratch folder, removed in the end.
struct Scratch {
    fs::path path;
    Scratch() {
        std::string name = (fs::temp_directory_path() / "weft_bad_XXXXXX").string();
        path = ::mkdtemp(name.data());
    }
    ~Scratch() { fs::remove_all(path); }
};

/// Runs `weft render SCENE.xml -o picture.exr`; what it wrote to stderr goes to `errors`.
int render(fs::path const& weft, std::string const& name, fs::path const& folder,
           std::string& errors) {
    std::string const command =
        "'" + weft.string() + "' render '" + (kBad / (name + ".xml")).string() + "' -o '" +
        (folder / "picture.exr").string() + "' >'" + (folder / "out").string() + "' 2>'" +
        (folder / "err").string() + "'";
    int const status = std::system(command.c_str());
    errors = read_bytes(folder / "err");
    EXPECT_EQ(read_bytes(folder / "out"), "");
    fs::remove(folder / "err");
    fs::remove(folder / "out");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(BadScenes, ProgramSaysOneLineAndWritesNothing) {
    fs::path const weft = fs::path(WEFT_BINARY_DIR) / "weft";
    if (!fs::exists(weft)) GTEST_SKIP() << "the program is not built";
    Scratch const scratch;
    for (char const* name : {"camera_missing", "image_zero", "include_cyclic", "matrix_singular",
                             "mesh_index", "mesh_nan", "mesh_truncated", "number_word",
                             "parameter_unknown", "tag_unknown", "texture_missing", "truncated"}) {
        SCOPED_TRACE(name);
        std::string const line = "error: " + expected_message(name) + "\n";
        std::string errors;
        EXPECT_EQ(render(weft, name, scratch.path, errors), 2);
        EXPECT_EQ(without_folder(errors), line);
        EXPECT_TRUE(fs::is_empty(scratch.path)) << "something was written";

        std::ofstream(scratch.path / "picture.exr") << "an older picture";
        EXPECT_EQ(render(weft, name, scratch.path, errors), 2);
        EXPECT_EQ(without_folder(errors), line);
        EXPECT_EQ(read_bytes(scratch.path / "picture.exr"), "an older picture");
        fs::remove(scratch.path / "picture.exr");
        EXPECT_TRUE(fs::is_empty(scratch.path)) << "something was written";
    }
}

} // namespace
