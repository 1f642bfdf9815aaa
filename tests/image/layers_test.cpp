// Layers and parts of EXR files: which are the picture, and that a tool keeps all others.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include <OpenImageIO/imageio.h>

#include "image/compare.h"
#include "image/layers.h"
#include "image/rewrite.h"
#include "image/shown_picture.h"
#include "image/texture_cache.h"

namespace weft::image {
namespace {

namespace fs = std::filesystem;

TEST(Layers, AreFoundByTheirNames) {
    std::vector<std::string> const channels{"A",        "B",        "G",     "R",   "albedo.B",
                                            "albedo.G", "albedo.R", "N.X",   "N.Y", "N.Z",
                                            "depth.Z",  "half.R",   "half.G"};
    EXPECT_EQ(find_layer(channels, ""), (ChannelTriple{3, 2, 1}));
    EXPECT_EQ(find_layer(channels, "albedo"), (ChannelTriple{6, 5, 4}));
    EXPECT_EQ(find_layer(channels, "N"), (ChannelTriple{7, 8, 9}));
    EXPECT_FALSE(find_layer(channels, "half"));
    EXPECT_FALSE(find_layer(channels, "depth"));
    EXPECT_EQ(layer_names(channels), (std::vector<std::string>{"albedo", "N"}));
    EXPECT_EQ(find_albedo_layer(channels), "albedo");
    EXPECT_EQ(find_normal_layer(channels), "N");
    EXPECT_FALSE(find_layer({"x", "y", "z"}, ""));

    auto with = [](std::string const& layer, std::string const& components) {
        std::vector<std::string> names{"R", "G", "B"};
        for (char c : components) names.push_back(layer + "." + c);
        return names;
    };
    for (char const* name : {"ViewLayer.Denoising Albedo", "denoise_albedo", "Albedo"})
        EXPECT_EQ(find_albedo_layer(with(name, "RGB")), name);
    for (char const* name :
         {"ViewLayer.Denoising Normal", "Ns", "normal", "sh_normal", "Normals"}) {
        EXPECT_EQ(find_normal_layer(with(name, "XYZ")), name);
        EXPECT_EQ(find_normal_layer(with(name, "rgb")), name);
    }
    EXPECT_EQ(find_albedo_layer({"albedo.R", "albedo.G", "albedo.B", "denoise_albedo.R",
                                 "denoise_albedo.G", "denoise_albedo.B"}),
              "denoise_albedo");
    EXPECT_EQ(find_kept_layer(with("x.denoise_kept", "RGB")), "x.denoise_kept");
    EXPECT_EQ(find_kept_layer(with("emission", "RGB")), "") << "which may be out of focus";
    EXPECT_EQ(find_albedo_layer(with("diffuse", "RGB")), "");
    EXPECT_EQ(find_normal_layer({"R", "G", "B"}), "");
}

TEST(Layers, AreTakenAndPutBack) {
    Image all = make_image(2, 1, 4);
    all.pixels = {1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_EQ(take_channels(all, {3, 0, 1}).pixels, (std::vector<float>{4, 1, 2, 8, 5, 6}));
    Image three = make_image(2, 1, 3);
    three.pixels = {-1, -2, -3, -4, -5, -6};
    put_channels(three, {2, 1, 3}, all);
    EXPECT_EQ(all.pixels, (std::vector<float>{1, -2, -1, -3, 5, -5, -4, -6}));
}

TEST(Layers, OfOtherProgramsAreThePicture) {
    auto const colors = [](std::vector<std::string> const& layers) {
        std::vector<std::string> names;
        for (std::string const& layer : layers)
            for (char const* letter : {".R", ".G", ".B"}) names.push_back(layer + letter);
        return find_colors(names);
    };
    EXPECT_EQ(colors({"ViewLayer.Depth", "ViewLayer.Combined"}), (ChannelTriple{3, 4, 5}));
    EXPECT_EQ(colors({"albedo", "beauty"}), (ChannelTriple{3, 4, 5}));
    EXPECT_EQ(colors({"albedo", "N"}), std::nullopt);
    EXPECT_EQ(find_colors({"Combined.R", "Combined.G", "Combined.B", "B", "G", "R"}),
              (ChannelTriple{5, 4, 3}));
}

/// A part of a file: 2 x 2 pixels, channel c of which is `value` + c.
struct TestPart {
    std::string name;
    std::vector<std::string> channels;
    float value;
    int size = 2;
    OIIO::TypeDesc type = OIIO::TypeFloat;
};

class Parts : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_parts_XXXXXX").string();
        ASSERT_TRUE(mkdtemp(name.data()));
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(std::string const& name) const { return (folder_ / name).string(); }

    std::string write(std::string const& name, std::vector<TestPart> const& parts) const {
        std::vector<OIIO::ImageSpec> specs;
        for (TestPart const& p : parts) {
            specs.emplace_back(p.size, p.size, int(p.channels.size()), p.type);
            specs.back().channelnames = p.channels;
            specs.back().full_width = specs.back().full_height = parts[0].size; // as parts must
            specs.back().attribute("oiio:subimagename", p.name);
            specs.back().attribute("note", "of " + p.name);
        }
        auto const output = OIIO::ImageOutput::create(path(name));
        bool good = specs.size() == 1 ? output->open(path(name), specs[0])
                                      : output->open(path(name), int(specs.size()), specs.data());
        for (size_t i = 0; i < parts.size(); ++i) {
            if (i > 0)
                good &= output->open(path(name), specs[i], OIIO::ImageOutput::AppendSubimage);
            std::vector<float> pixels;
            for (int k = 0; k < parts[i].size * parts[i].size; ++k)
                for (size_t c = 0; c < parts[i].channels.size(); ++c)
                    pixels.push_back(parts[i].value + float(c));
            good &= output->write_image(OIIO::TypeFloat, pixels.data());
        }
        EXPECT_TRUE(output->close() && good) << name << ": " << output->geterror();
        return path(name);
    }
    Texel texel(std::string const& path, Channels channels = Channels::color) {
        return read_texture(path, {Transfer::linear}, channels).texel(0, 1, 1);
    }

    fs::path folder_;
};

std::vector<TestPart> const kAsNukeWrites{{"albedo", {"R", "G", "B"}, 10},
                                          {"rgba", {"R", "G", "B", "A"}, 20},
                                          {"N", {"X", "Y", "Z"}, 30},
                                          {"depth", {"Z"}, 40}};

TEST_F(Parts, AreLayersOfOneImage) {
    Image const image = read_image(write("all.exr", kAsNukeWrites));
    EXPECT_EQ(image.names, (std::vector<std::string>{"albedo.R", "albedo.G", "albedo.B", "R", "G",
                                                     "B", "A", "N.X", "N.Y", "N.Z", "depth.Z"}));
    EXPECT_TRUE(image.apart.empty());
    EXPECT_EQ(colors_of(image).at(1, 1, 2), 22);
    EXPECT_EQ(take_layer(image, "N").at(0, 1, 0), 30);
    EXPECT_EQ(take_layer(image, "depth").at(0, 1, 0), 40);
    EXPECT_THROW(take_layer(image, "dept"), InputError);
    EXPECT_EQ(find_albedo_layer(image.names), "albedo");
}

TEST_F(Parts, ArriveAsTheyWereBesideWhatIsChanged) {
    auto parts = kAsNukeWrites;
    parts.push_back({"small", {"R", "G", "B"}, 50, 1});
    parts.push_back({"ids", {"id"}, 0.3f, 2, OIIO::TypeUInt32}); // more digits than a float has
    std::string const from = write("all.exr", parts), to = path("out.exr");
    Image image = read_image(from);
    EXPECT_EQ(image.apart, std::vector<std::string>{"small"});
    put_channels(make_image(2, 2, 3), *find_colors(image.names), image);
    rewrite_exr(to, from, image, {{"weft:postprocess", "black"}});

    Image const again = read_image(to);
    for (ChannelDifference const& c : compare_channels(again, read_image(from), true)) {
        EXPECT_TRUE(c.in_image && c.in_reference) << c.name;
        bool const changed = c.name == "R" || c.name == "G" || c.name == "B";
        EXPECT_EQ(c.difference.max > 0, changed) << c.name;
    }
    EXPECT_EQ(again.apart, image.apart);
    EXPECT_EQ(read_part(to, "small").pixels, read_part(from, "small").pixels);
    EXPECT_EQ(read_metadata(to).at("weft:postprocess"), "black");
    auto const a = OIIO::ImageInput::open(from), b = OIIO::ImageInput::open(to);
    uint32_t ids_a[4], ids_b[4];
    ASSERT_TRUE(a->read_image(5, 0, 0, 1, OIIO::TypeUInt32, ids_a));
    ASSERT_TRUE(b->read_image(5, 0, 0, 1, OIIO::TypeUInt32, ids_b));
    EXPECT_EQ(ids_a[3], ids_b[3]);
    EXPECT_EQ(b->spec(2).get_string_attribute("note"), "of N");
}

TEST_F(Parts, AndLayersAreTextures) {
    std::string const parts = write("all.exr", kAsNukeWrites),
                      layers = write("one.exr", {{"",
                                                  {"ViewLayer.Combined.R", "ViewLayer.Combined.G",
                                                   "ViewLayer.Combined.B", "ViewLayer.Depth.Z",
                                                   "ViewLayer.DiffCol.R", "ViewLayer.DiffCol.G",
                                                   "ViewLayer.DiffCol.B"},
                                                  1}});
    EXPECT_EQ(texel(parts)[0], 20) << "the picture, though it comes second";
    EXPECT_EQ(texel(parts, Channels::alpha)[0], 23);
    EXPECT_EQ(texel(parts + ":albedo")[1], 11);
    EXPECT_EQ(texel(parts + ":N")[2], 32);
    EXPECT_EQ(texel(parts + ":depth")[0], 40);
    EXPECT_EQ(texel(layers)[1], 2);
    EXPECT_EQ(texel(layers + ":ViewLayer.DiffCol")[1], 6);
    EXPECT_EQ(texel(layers + ":ViewLayer.Depth")[0], 4);

    // Two layers of a file are two textures, wherever they are kept.
    TextureCache cache;
    auto const first = cache.load(parts + ":albedo", {Transfer::linear}, false),
               second = cache.load(parts + ":N", {Transfer::linear}, false);
    EXPECT_NE(first->source->contents_hash(), second->source->contents_hash());
    TextureCacheOptions options;
    options.folder = path("tiles");
    options.small_texels = 0;
    TextureCache tiled(options);
    EXPECT_EQ(tiled.load(parts + ":albedo", {Transfer::linear}, false)->texel(0, 0, 0)[1], 11);
    EXPECT_EQ(tiled.load(parts + ":N", {Transfer::linear}, false)->texel(0, 0, 0)[1], 31);
}

TEST_F(Parts, SayWhatIsNotPlain) {
    std::string const layers = write(
        "two.exr",
        {{"", {"diffuse.R", "diffuse.G", "diffuse.B", "normal.X", "normal.Y", "normal.Z"}, 1}});
    auto const message = [&](std::string const& file) -> std::string {
        try {
            texel(file);
        } catch (InputError const& e) {
            return e.what();
        }
        return "none";
    };
    EXPECT_NE(
        message(layers).find("found the layers 'diffuse', 'normal'; 'two.exr:NAME' takes one"),
        std::string::npos)
        << message(layers);
    EXPECT_NE(message(layers + ":diffus").find("expected a layer 'diffus', found 'diffuse'"),
              std::string::npos)
        << message(layers + ":diffus");
}

} // namespace
} // namespace weft::image
