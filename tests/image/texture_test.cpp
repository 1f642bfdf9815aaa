// Textures: decoding as whole images are decoded, mip levels, and that it changes no bit whether
// texels lie in memory or in tiles, whatever the memory.
#include "image/texture_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <OpenImageIO/imageio.h>

#include "base/color.h"
#include "base/hash.h"
#include "image/image.h"
#include "image/texture_file.h"
#include "image/write.h"

using namespace weft;
using namespace weft::image;
namespace fs = std::filesystem;

namespace {

class Textures : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_texture_XXXXXX").string();
        ASSERT_TRUE(mkdtemp(name.data()));
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(std::string const& name) const { return (folder_ / name).string(); }

    /// Noise, in the type of texel given.
    void write_noise(std::string const& name, int width, int height, int channels,
                     TexelType type) const {
        std::vector<float> pixels(size_t(width) * size_t(height) * size_t(channels));
        Rng rng(7);
        for (float& v : pixels) v = rng.next();
        OIIO::TypeDesc const types[] = {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16,
                                        OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT};
        auto const output = OIIO::ImageOutput::create(path(name));
        ASSERT_TRUE(
            output->open(path(name), OIIO::ImageSpec(width, height, channels, types[int(type)])));
        ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
        ASSERT_TRUE(output->close());
    }
    /// A cache that keeps nothing in memory.
    TextureCacheOptions tiles_only() const {
        TextureCacheOptions options;
        options.small_texels = 0;
        options.memory = 1 << 20;
        options.folder = path("cache");
        return options;
    }
    size_t converted_files() const {
        return size_t(std::distance(fs::directory_iterator(folder_ / "cache"), {}));
    }

    fs::path folder_;
};

bool same_bits(Texel const& a, Texel const& b) { return std::memcmp(&a, &b, 12) == 0; }

/// The number of texels of all levels that differ.
int differences(Texture const& a, Texture const& b) {
    EXPECT_EQ(a.level_count(), b.level_count());
    int count = 0;
    for (int l = 0; l < std::min(a.level_count(), b.level_count()); ++l) {
        EXPECT_EQ(a.level(l).width, b.level(l).width);
        EXPECT_EQ(a.level(l).height, b.level(l).height);
        for (int y = 0; y < a.level(l).height; ++y)
            for (int x = 0; x < a.level(l).width; ++x)
                count += !same_bits(a.texel(l, x, y), b.texel(l, x, y));
    }
    return count;
}

} // namespace

TEST_F(Textures, DecodeAsTheWholeImageWould) {
    write_noise("8.png", 37, 21, 3, TexelType::u8);
    write_noise("16.png", 37, 21, 3, TexelType::u16);
    for (char const* name : {"8.png", "16.png"}) {
        Image const floats = read_image(path(name));
        Texture const gamma = read_texture(path(name), {Transfer::gamma22}),
                      srgb = read_texture(path(name), {Transfer::srgb}),
                      data = read_texture(path(name), {Transfer::linear});
        for (int y = 0; y < 21; ++y)
            for (int x = 0; x < 37; ++x)
                for (int c = 0; c < 3; ++c) {
                    float const v = floats.at(x, y, c);
                    float const step = float(size_t(v * 65535 + 0.5f)) / 65535;
                    ASSERT_EQ(data.texel(0, x, y)[c], v);
                    ASSERT_EQ(gamma.texel(0, x, y)[c], std::pow(step, 2.2f));
                    ASSERT_EQ(srgb.texel(0, x, y)[c], srgb_to_linear(step));
                }
    }
}

TEST_F(Textures, FloatsAreLinearAndGreyIsGrey) {
    write_noise("grey.exr", 9, 5, 1, TexelType::f32);
    Image const floats = read_image(path("grey.exr"));
    Texture const texture = read_texture(path("grey.exr"), {Transfer::gamma22});
    for (int x = 0; x < 9; ++x)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(texture.texel(0, x, 2)[c], floats.at(x, 2, 0));
}

TEST_F(Textures, LevelsKeepTheMeanOfLinearValues) {
    // Sizes that are no powers of two: every texel counts by its area.
    write_noise("odd.exr", 173, 59, 3, TexelType::f32);
    Texture texture = read_texture(path("odd.exr"), {Transfer::linear});
    texture.add_levels();
    EXPECT_EQ(texture.level_count(), 8);
    auto mean = [&](int level) {
        MipLevel const& l = texture.level(level);
        double sum = 0;
        for (int y = 0; y < l.height; ++y)
            for (int x = 0; x < l.width; ++x) sum += double(texture.texel(level, x, y)[1]);
        return sum / (double(l.width) * l.height);
    };
    for (int l = 1; l < texture.level_count(); ++l) EXPECT_NEAR(mean(l), mean(0), 1e-5) << l;

    // Black and white screen pixels have the linear mean 1/2, not the decoded half of 255.
    Image board = make_image(2, 2, 3);
    for (int c = 0; c < 3; ++c) board.at(0, 0, c) = board.at(1, 1, c) = 1;
    write_png(path("board.png"), board);
    Texture coded = read_texture(path("board.png"), {Transfer::srgb});
    coded.add_levels();
    EXPECT_NEAR(coded.texel(1, 0, 0)[0], srgb_to_linear(188 / 255.f), 1e-5f); // the nearest code
}

TEST_F(Textures, MemoryAndTilesGiveTheSameBits) {
    struct Case {
        char const* name;
        int channels;
        TexelType type;
    };
    for (Case const& c : {Case{"a.png", 3, TexelType::u8}, Case{"b.png", 1, TexelType::u8},
                          Case{"c.png", 4, TexelType::u16}, Case{"d.exr", 3, TexelType::f16},
                          Case{"e.exr", 3, TexelType::f32}, Case{"f.exr", 1, TexelType::f32}}) {
        SCOPED_TRACE(c.name);
        write_noise(c.name, 301, 203, c.channels, c.type);
        TextureCache memory, tiles(tiles_only());
        auto const a = memory.load(path(c.name), {Transfer::gamma22}, true),
                   b = tiles.load(path(c.name), {Transfer::gamma22}, true);
        EXPECT_TRUE(a->is_in_memory());
        EXPECT_FALSE(b->is_in_memory());
        EXPECT_EQ(differences(*a, *b), 0);
        EXPECT_EQ(tiles.failure(), "");
        // Across the borders of tiles, too.
        TiledFile::Quad const quad(*b->tiles(), 0, {63, 64}, {63, 64});
        size_t const bytes = b->format().bytes();
        EXPECT_EQ(std::memcmp(quad.p[3], a->texels(0) + (64 * 301 + 64) * bytes, bytes), 0);
        EXPECT_EQ(std::memcmp(quad.p[1], a->texels(0) + (63 * 301 + 64) * bytes, bytes), 0);
    }
}

TEST_F(Textures, ConversionsAreMadeOnceAndAnewWhereTheFileChanged) {
    write_noise("a.png", 100, 100, 3, TexelType::u8);
    int conversions = 0;
    auto load = [&] {
        TextureCacheOptions options = tiles_only();
        options.on_conversion = [&](std::string const&, double f) { conversions += f == 1; };
        TextureCache cache(options);
        return cache.load(path("a.png"), {Transfer::gamma22}, false)->width;
    };
    EXPECT_EQ(load(), 100);
    EXPECT_EQ(load(), 100);
    EXPECT_EQ(conversions, 1);
    write_noise("a.png", 90, 100, 3, TexelType::u8);
    EXPECT_EQ(load(), 90);
    EXPECT_EQ(conversions, 2);
    // A damaged conversion is made anew.
    for (auto const& entry : fs::directory_iterator(folder_ / "cache"))
        fs::resize_file(entry.path(), 100);
    EXPECT_EQ(load(), 90);
    EXPECT_EQ(conversions, 3);
    EXPECT_EQ(converted_files(), 2u);
}

TEST_F(Textures, AnUnwritableFolderIsAWarning) {
    write_noise("a.png", 100, 100, 3, TexelType::u8);
    TextureCacheOptions options = tiles_only();
    std::ofstream(path("file")) << "no folder";
    options.folder = path("file") + "/cache";
    TextureCache cache(options);
    EXPECT_TRUE(cache.load(path("a.png"), {Transfer::gamma22}, false)->is_in_memory());
    auto const warnings = cache.take_warnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("texture cache folder"), std::string::npos) << warnings[0];
}

TEST_F(Textures, BadFilesHaveTheMessagesOfImages) {
    auto message = [](auto const& read) {
        try {
            read();
        } catch (InputError const& e) {
            return std::string(e.what());
        }
        return std::string("none");
    };
    write_noise("whole.png", 200, 200, 3, TexelType::u8);
    fs::copy_file(path("whole.png"), path("cut.png"));
    fs::resize_file(path("cut.png"), fs::file_size(path("cut.png")) / 2);
    std::ofstream(path("junk.png")) << "junk";
    for (char const* name : {"missing.png", "cut.png", "junk.png"}) {
        std::string const expected = message([&] { read_image(path(name)); });
        EXPECT_NE(expected, "none");
        TextureCache tiles(tiles_only());
        EXPECT_EQ(message([&] { tiles.load(path(name), {Transfer::srgb}, false); }), expected);
        EXPECT_EQ(message([&] { read_texture(path(name), {Transfer::srgb}); }), expected);
    }
    // A texture file that lacks its end is found out before the render.
    make_texture_file(path("whole.png"), path("whole.tx"), {Transfer::srgb});
    fs::resize_file(path("whole.tx"), fs::file_size(path("whole.tx")) * 3 / 4);
    TextureCache tiles(tiles_only());
    EXPECT_NE(message([&] { tiles.load(path("whole.tx"), {Transfer::srgb}, false); }), "none");
}

TEST_F(Textures, FilesInMemoryAreThoseOnDisk) {
    auto bytes_of = [&](char const* name) {
        std::ifstream in(path(name), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    write_noise("a.png", 40, 30, 3, TexelType::u8);
    write_noise("b.jpg", 40, 30, 3, TexelType::u8);
    TextureCache cache;
    for (char const* name : {"a.png", "b.jpg"}) {
        std::string const bytes = bytes_of(name);
        auto const here =
                       cache.load({std::string("bytes of ") + name, bytes}, {Transfer::srgb}, true),
                   there = cache.load(path(name), {Transfer::srgb}, true);
        ASSERT_EQ(here->width, there->width);
        ASSERT_EQ(here->level_count(), there->level_count());
        EXPECT_EQ(std::memcmp(here->texels(0), there->texels(0), there->memory_bytes()), 0);
        for (size_t size : {size_t(0), size_t(3), bytes.size() / 2, bytes.size() - 13})
            EXPECT_THROW(cache.load({"cut", std::string_view(bytes).substr(0, size)},
                                    {Transfer::srgb}, false),
                         InputError)
                << name << " " << size;
    }
}

TEST_F(Textures, AlphaIsATextureOfItsOwn) {
    write_noise("rgba.png", 20, 10, 4, TexelType::u8);
    write_noise("rgb.png", 20, 10, 3, TexelType::u8);
    TextureCache cache;
    auto const alpha = cache.load(path("rgba.png"), {Transfer::srgb}, false, Channels::alpha);
    Image const image = read_image(path("rgba.png"));
    EXPECT_EQ(alpha->format().channels, 1);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) EXPECT_EQ(alpha->texel(0, x, y)[0], image.at(x, y, 3));
    auto const none = cache.load(path("rgb.png"), {Transfer::srgb}, true, Channels::alpha);
    EXPECT_EQ(none->texel(0, 0, 0)[0], 1);
    EXPECT_EQ(cache.load(path("rgb.png"), {Transfer::srgb}, false)->format().channels, 3);
}

TEST_F(Textures, StatisticsTellWhereTexelsLie) {
    write_noise("a.png", 100, 100, 3, TexelType::u8);
    TextureCache memory, tiles(tiles_only());
    memory.load(path("a.png"), {Transfer::gamma22}, false);
    tiles.load(path("a.png"), {Transfer::gamma22}, false);
    EXPECT_EQ(memory.statistics().memory_bytes, 30000u);
    EXPECT_EQ(memory.statistics().in_memory, 1u);
    EXPECT_EQ(tiles.statistics().memory_bytes, 0u);
    EXPECT_EQ(tiles.statistics().in_tiles, 1u);
    EXPECT_GT(tiles.statistics().tile_bytes, 30000u);
    EXPECT_LE(tiles.statistics().tile_limit, uint64_t(1) << 20);
}
