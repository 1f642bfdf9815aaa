// What image files say about themselves: colours, windows, and the order of rows and columns.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <OpenImageIO/imageio.h>
#include <lcms2.h>

#include "base/hash.h"
#include "image/image.h"
#include "image/shown_picture.h"
#include "image/texture_cache.h"
#include "image/texture_file.h"

using namespace weft;
using namespace weft::image;
namespace fs = std::filesystem;

namespace {

class FileWords : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_words_XXXXXX").string();
        ASSERT_TRUE(mkdtemp(name.data()));
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(std::string const& name) const { return (folder_ / name).string(); }

    void write(std::string const& name, OIIO::ImageSpec const& spec,
               std::vector<float> const& pixels) const {
        auto const output = OIIO::ImageOutput::create(path(name));
        ASSERT_TRUE(output && output->open(path(name), spec)) << name;
        ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
        ASSERT_TRUE(output->close());
    }
    /// 2 x 2 floats of one colour.
    void write_exr(std::string const& name, Color const& c, Primaries const* primaries) const {
        OIIO::ImageSpec spec(2, 2, 3, OIIO::TypeDesc::FLOAT);
        if (primaries)
            spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                           primaries->data());
        std::vector<float> pixels;
        for (int i = 0; i < 4; ++i) pixels.insert(pixels.end(), {c.r, c.g, c.b});
        write(name, spec, pixels);
    }
    /// A PNG of 2 x 2 texels (200, 100, 200), with `chunks` before its pixels.
    void write_png(std::string const& name, std::string const& chunks) const {
        OIIO::ImageSpec const spec(2, 2, 3, OIIO::TypeDesc::UINT8);
        std::vector<float> pixels;
        for (int i = 0; i < 4; ++i)
            pixels.insert(pixels.end(), {200 / 255.f, 100 / 255.f, 200 / 255.f});
        write("plain.png", spec, pixels);
        std::string const plain = bytes("plain.png");
        std::string text = plain.substr(0, 33) + chunks; // signature and IHDR
        for (size_t at = 33; at < plain.size();) {       // all but what else the writer said
            size_t const length =
                12 + (size_t(uint8_t(plain[at + 2])) << 8 | uint8_t(plain[at + 3]));
            std::string const kind = plain.substr(at + 4, 4);
            if (kind == "IDAT" || kind == "IEND") text += plain.substr(at, length);
            at += length;
        }
        std::ofstream(path(name), std::ios::binary) << text;
    }
    std::string bytes(std::string const& name) const {
        std::ifstream in(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    Texel texel(std::string const& name, Encoding encoding = {Transfer::srgb}, int x = 0,
                int y = 0) {
        warnings_.clear();
        return read_texture(path(name), encoding, Channels::color, &warnings_).texel(0, x, y);
    }
    void expect(Texel const& found, Color const& right, float tolerance = 2e-4f) {
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], right[k], tolerance) << "channel " << k;
    }

    fs::path folder_;
    std::vector<std::string> warnings_;
};

uint32_t crc(std::string const& text) {
    uint32_t c = ~0u;
    for (char ch : text) {
        c ^= uint8_t(ch);
        for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    }
    return ~c;
}
std::string big_endian(uint32_t n) { return {char(n >> 24), char(n >> 16), char(n >> 8), char(n)}; }
std::string chunk(std::string const& name, std::string const& contents) {
    return big_endian(uint32_t(contents.size())) + name + contents +
           big_endian(crc(name + contents));
}
std::string gamma_chunk(double encoded) {
    return chunk("gAMA", big_endian(uint32_t(std::lround(encoded * 1e5))));
}

Color const kScreen(0.577580f, 0.127438f, 0.577580f); ///< (200, 100, 200) by sRGB's curve
Color const kData(200 / 255.f, 100 / 255.f, 200 / 255.f);

TEST_F(FileWords, ChromaticitiesOfExr) {
    // What the colour (0.25, 0.5, 0.75) of Rec. 709 is in other systems. XYZ is IEC 61966-2-1's
    // matrix; ACES2065-1 and ACEScg are by the matrices that their users know (1.70505 -0.62179
    // -0.08326 ... from AP1), inverted.
    write_exr("plain.exr", {0.25f, 0.5f, 0.75f}, nullptr);
    write_exr("rec709.exr", {0.25f, 0.5f, 0.75f}, &kRec709Primaries);
    write_exr("xyz.exr", {0.4172504f, 0.4648883f, 0.7773293f}, &kXyzPrimaries);
    Primaries const ap0{0.7347f, 0.2653f, 0, 1, 0.0001f, -0.077f, 0.32168f, 0.33767f},
        ap1{0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f};
    write_exr("ap0.exr", {0.434436f, 0.501752f, 0.713343f}, &ap0);
    write_exr("ap1.exr", {0.358571f, 0.485815f, 0.712300f}, &ap1);
    for (char const* name : {"plain.exr", "rec709.exr", "xyz.exr", "ap0.exr", "ap1.exr"}) {
        expect(texel(name), {0.25f, 0.5f, 0.75f});
        EXPECT_TRUE(warnings_.empty());
        Image const image = read_image(path(name));
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at(1, 1, k), 0.25f * float(k + 1), 2e-4f);
    }
    // White stays white.
    write_exr("white.exr", Color(1), &ap1);
    expect(texel("white.exr"), Color(1), 1e-5f);
    // Whoever states another colour space is heard first, and told.
    expect(texel("xyz.exr", {Transfer::linear, true}), {0.4172504f, 0.4648883f, 0.7773293f});
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_NE(warnings_[0].find("primaries 1,0 0,1 0,0 0.3333,0.3333, which is not followed"),
              std::string::npos)
        << warnings_[0];
}

TEST_F(FileWords, GammaAndPrimariesOfPng) {
    write_png("none.png", "");
    write_png("gamma1.png", gamma_chunk(1));
    write_png("gamma22.png", gamma_chunk(1 / 2.2));
    write_png("gamma18.png", gamma_chunk(1 / 1.8));
    write_png("srgb.png", gamma_chunk(1) + chunk("sRGB", std::string(1, '\0'))); // sRGB wins
    expect(texel("none.png"), kScreen);
    expect(texel("gamma22.png"), kScreen);
    expect(texel("srgb.png"), kScreen);
    expect(texel("gamma1.png"), kData);
    auto const power = [](float x) { return std::pow(x, 1.8f); };
    expect(texel("gamma18.png"), {power(kData.r), power(kData.g), power(kData.b)});
    EXPECT_TRUE(warnings_.empty());
    // glTF ignores all of that, and says so.
    expect(texel("gamma1.png", {Transfer::srgb, true}), kScreen);
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_NE(warnings_[0].find("a gamma of 1"), std::string::npos) << warnings_[0];
    texel("srgb.png", {Transfer::srgb, true});
    EXPECT_TRUE(warnings_.empty());

    // Display P3 by its chromaticities, white first, and by code points.
    std::string chrm;
    for (int n : {31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000})
        chrm += big_endian(uint32_t(n));
    write_png("p3.png", gamma_chunk(1 / 2.2) + chunk("cHRM", chrm));
    write_png("cicp.png", chunk("cICP", std::string("\x0c\x0d\x00\x01", 4)));
    // Linear P3 to linear Rec. 709: rows 1.2249 -0.2249 0, -0.0421 1.0421 0, -0.0196
    // -0.0786 1.0983.
    Color const p3(1.22494f * kScreen.r - 0.22494f * kScreen.g,
                   -0.04206f * kScreen.r + 1.04206f * kScreen.g,
                   (-0.01964f + 1.09827f) * kScreen.r - 0.07864f * kScreen.g);
    expect(texel("p3.png"), p3, 1e-3f);
    expect(texel("cicp.png"), p3, 1e-3f);
    write_png("pq.png", chunk("cICP", std::string("\x09\x10\x00\x01", 4)));
    texel("pq.png");
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_NE(warnings_[0].find("code points 9/16"), std::string::npos) << warnings_[0];
}

TEST_F(FileWords, IccProfiles) {
    auto const write_jpeg = [&](char const* name, cmsHPROFILE profile) {
        cmsUInt32Number size = 0;
        cmsSaveProfileToMem(profile, nullptr, &size);
        std::vector<uint8_t> icc(size);
        cmsSaveProfileToMem(profile, icc.data(), &size);
        cmsCloseProfile(profile);
        OIIO::ImageSpec spec(16, 16, 3, OIIO::TypeDesc::UINT8);
        spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(size)), icc.data());
        spec.attribute("Compression", "jpeg:100");
        std::vector<float> pixels;
        for (int i = 0; i < 256; ++i) pixels.insert(pixels.end(), {kData.r, kData.g, kData.b});
        write(name, spec, pixels);
    };
    auto const profile = [](double gamma, double green_x, double green_y) {
        cmsCIExyY const d65{0.3127, 0.3290, 1};
        cmsCIExyYTRIPLE const p{{0.64, 0.33, 1}, {green_x, green_y, 1}, {0.15, 0.06, 1}};
        cmsToneCurve* const curve = cmsBuildGamma(nullptr, gamma);
        cmsToneCurve* const curves[]{curve, curve, curve};
        cmsHPROFILE const made = cmsCreateRGBProfile(&d65, &p, curves);
        cmsFreeToneCurve(curve);
        return made;
    };
    write_jpeg("srgb.jpg", cmsCreate_sRGBProfile());
    write_jpeg("gamma18.jpg", profile(1.8, 0.30, 0.60));
    write_jpeg("adobe.jpg", profile(2.2, 0.21, 0.71));
    expect(texel("srgb.jpg"), kScreen, 0.01f); // JPEG's own loss
    // The curve of lightwave is kept where a file says no more than that it is for a screen.
    float const g22 = std::pow(kData.g, 2.2f);
    EXPECT_NEAR(texel("srgb.jpg", {Transfer::gamma22})[1], g22, 0.01f);
    auto const power = [](float x) { return std::pow(x, 1.8f); };
    expect(texel("gamma18.jpg"), {power(kData.r), power(kData.g), power(kData.b)}, 0.01f);
    // Adobe RGB (1998) to Rec. 709: rows 1.3984 -0.3984 0, 0 1 0, 0 -0.0429 1.0429.
    float const r = std::pow(kData.r, 2.2f);
    expect(texel("adobe.jpg"), {1.39836f * r - 0.39836f * g22, g22, 1.04293f * r - 0.04293f * g22},
           0.015f);
    EXPECT_TRUE(warnings_.empty());
    texel("adobe.jpg", {Transfer::srgb, true});
    EXPECT_EQ(warnings_.size(), 1u);
}

TEST_F(FileWords, WindowsOfExr) {
    auto const write_window = [&](char const* name, int data, int x, int shown,
                                  std::vector<float> const& pixels) {
        OIIO::ImageSpec spec(data, data, 3, OIIO::TypeDesc::HALF);
        spec.x = spec.y = x;
        spec.full_x = spec.full_y = 0;
        spec.full_width = spec.full_height = shown;
        write(name, spec, pixels);
    };
    std::vector<float> red, framed;
    for (int i = 0; i < 4; ++i) red.insert(red.end(), {1, 0, 0});
    for (int y = -1; y < 3; ++y)
        for (int x = -1; x < 3; ++x) {
            bool const inside = x >= 0 && y >= 0 && x < 2 && y < 2;
            framed.insert(framed.end(), {inside ? 1.f : 0.f, inside ? 0.f : 1.f, 0});
        }
    write_window("crop.exr", 2, 0, 4, red);
    write_window("overscan.exr", 4, -1, 2, framed);
    Texture const crop = read_texture(path("crop.exr"), {Transfer::srgb}),
                  inner = read_texture(path("overscan.exr"), {Transfer::srgb});
    ASSERT_EQ(crop.width, 4);
    ASSERT_EQ(inner.width, 2);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            expect(crop.texel(0, x, y), {x < 2 && y < 2 ? 1.f : 0.f, 0, 0});
            if (x < 2 && y < 2) expect(inner.texel(0, x, y), {1, 0, 0});
        }
    // A conversion to tiles shows the same.
    make_texture_file(path("crop.exr"), path("crop.tx"), {Transfer::srgb});
    Texture const tiles = read_texture(path("crop.tx"), {Transfer::srgb});
    ASSERT_EQ(tiles.width, 4);
    expect(tiles.texel(0, 3, 3), Color(0));
    expect(tiles.texel(0, 1, 1), {1, 0, 0});
}

// ---- Radiance -----------------------------------------------------------------------------------

constexpr int kColumns = 16, kRows = 12;

/// Powers of two, all different in a row and a column.
std::array<uint8_t, 4> hdr_pixel(int x, int y) {
    return {128, uint8_t(64 + 4 * y), uint8_t(64 + 4 * x), uint8_t(129 + (x + y) % 3)};
}
Color hdr_color(int x, int y) {
    auto const p = hdr_pixel(x, y);
    float const scale = std::ldexp(1.f, int(p[3]) - 136);
    return {float(p[0]) * scale, float(p[1]) * scale, float(p[2]) * scale};
}

std::string hdr(std::string const& header, std::string const& resolution, int orientation,
                bool old_runs = false) {
    std::string text = "#?RADIANCE\n" + header + "\n" + resolution + "\n";
    bool const turned = orientation > 4;
    int const columns = turned ? kRows : kColumns, lines = turned ? kColumns : kRows;
    // Where stored pixels are shown.
    std::vector<std::array<uint8_t, 4>> stored(size_t(kColumns * kRows));
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kColumns; ++x) {
            Vec2i const p = stored_place(orientation, x, y, columns, lines);
            stored[size_t(p.y * columns + p.x)] = hdr_pixel(x, y);
        }
    for (int line = 0; line < lines; ++line) {
        auto const* row = &stored[size_t(line * columns)];
        if (old_runs) {
            for (int i = 0; i < columns;) {
                int run = 1;
                while (i + run < columns && row[i + run] == row[i]) ++run;
                for (uint8_t c : row[i]) text.push_back(char(c));
                if (run > 1) text += {1, 1, 1, char(run - 1)};
                i += run;
            }
        } else {
            text += {2, 2, 0, char(columns)};
            for (size_t k = 0; k < 4; ++k) {
                text.push_back(char(columns)); // one run of different bytes
                for (int i = 0; i < columns; ++i) text.push_back(char(row[i][k]));
            }
        }
    }
    return text;
}

class Radiance : public FileWords {
  protected:
    void expect_picture(std::string const& name, std::string const& text, float factor = 1) {
        std::ofstream(path(name), std::ios::binary) << text;
        warnings_.clear();
        Texture const t = read_texture(path(name), {Transfer::srgb}, Channels::color, &warnings_);
        EXPECT_TRUE(warnings_.empty());
        ASSERT_EQ(t.width, kColumns) << name;
        ASSERT_EQ(t.height, kRows) << name;
        Image const image = read_image(path(name));
        int wrong = 0;
        for (int y = 0; y < kRows; ++y)
            for (int x = 0; x < kColumns; ++x)
                for (int k = 0; k < 3; ++k) {
                    float const right = hdr_color(x, y)[k] * factor;
                    wrong += std::abs(t.texel(0, x, y)[k] - right) > 1e-5f * right;
                    wrong += image.at(x, y, k) != t.texel(0, x, y)[k];
                }
        EXPECT_EQ(wrong, 0) << name;
    }
    static inline std::string const kRgbe = "FORMAT=32-bit_rle_rgbe\n";
};

TEST_F(Radiance, AllOrdersOfRowsAndColumns) {
    char const* const resolutions[]{"-Y 12 +X 16", "-Y 12 -X 16", "+Y 12 -X 16", "+Y 12 +X 16",
                                    "+X 16 -Y 12", "-X 16 -Y 12", "-X 16 +Y 12", "+X 16 +Y 12"};
    for (int i = 0; i < 8; ++i)
        expect_picture("order" + std::to_string(i) + ".hdr", hdr(kRgbe, resolutions[i], i + 1));
}

TEST_F(Radiance, ExposureAndColorCorrection) {
    expect_picture("exposure.hdr", hdr(kRgbe + "EXPOSURE=4\n", "-Y 12 +X 16", 1), 0.25f);
    expect_picture("twice.hdr",
                   hdr("EXPOSURE=4\nEXPOSURE= 0.5\nCOLORCORR=2 2 2\n", "-Y 12 +X 16", 1), 0.25f);
}

TEST_F(Radiance, OldRunsAndXyz) {
    std::string const flat = "-Y 12 +X 16";
    expect_picture("old.hdr", hdr(kRgbe, flat, 1, true));
    // Runs of the old kind over more than one pixel.
    std::string text = "#?RADIANCE\n" + kRgbe + "\n-Y 1 +X 520\n";
    text += {char(128), char(128), char(128), char(129), 1, 1, 1, 7, 1, 1, 1, 2};
    std::ofstream(path("long.hdr"), std::ios::binary) << text;
    Image const image = read_image(path("long.hdr"));
    ASSERT_EQ(image.width, 520);
    EXPECT_EQ(image.at(519, 0, 2), 1);

    // XYZ of Rec. 709's white is white.
    text = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n";
    text += {char(122), char(128), char(139), char(129)};
    std::ofstream(path("xyz.hdr"), std::ios::binary) << text;
    Texel const white = texel("xyz.hdr");
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(white[k], 1, 0.02f);
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(Radiance, DamageIsToldAndEverySizeOfAFileIsSafe) {
    std::string const good = hdr(kRgbe, "-Y 12 +X 16", 1), old = hdr(kRgbe, "-Y 12 +X 16", 1, true);
    for (std::string const& whole : {good, old})
        for (size_t size = 0; size < whole.size(); size += 7) {
            std::ofstream(path("cut.hdr"), std::ios::binary) << whole.substr(0, size);
            EXPECT_THROW(read_image(path("cut.hdr")), InputError) << size;
        }
    Rng rng(9);
    for (int i = 0; i < 3000; ++i) { // any byte may be any other
        std::string text = i % 2 ? good : old;
        for (int k = 0; k < 3; ++k)
            text[size_t(rng.next_uint() % text.size())] = char(rng.next_uint());
        std::ofstream(path("odd.hdr"), std::ios::binary) << text;
        try {
            Image const image = read_image(path("odd.hdr"));
            EXPECT_EQ(image.pixels.size(), size_t(image.width) * size_t(image.height) * 3);
        } catch (InputError const&) {
        }
    }
}

} // namespace
