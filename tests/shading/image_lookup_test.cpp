// Lookups in images: borders, filters, and what footprints do.
#include "shading/image_lookup.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/hash.h"
#include "tests/support/textures.h"

using namespace weft;
using namespace weft::shading;

namespace {

/// Noise of floats with mip levels.
std::shared_ptr<image::Texture const> noise(int width, int height) {
    std::vector<float> values(size_t(width) * size_t(height) * 3);
    Rng rng(3);
    for (float& v : values) v = rng.next();
    return weft::testing::texture_of(width, height, 3, values);
}

Color texel(image::Texture const& t, int level, int x, int y) {
    image::Texel const v = t.texel(level, x, y);
    return {v[0], v[1], v[2]};
}

int modulo(int i, int n) { return (i % n + n) % n; }

} // namespace

TEST(ImageLookup, BordersRepeatOrClamp) {
    auto const im = noise(7, 5);
    for (int y = -12; y < 17; ++y)
        for (int x = -15; x < 22; ++x) {
            // The centre of a texel is that texel, v running upwards.
            Vec2 const uv((float(x) + 0.5f) / 7, 1 - (float(y) + 0.5f) / 5);
            for (scene::TextureFilter filter :
                 {scene::TextureFilter::nearest, scene::TextureFilter::bilinear}) {
                Color const repeated = ImageLookup{im, 1, false, false, filter}.at(uv),
                            expected = texel(*im, 0, modulo(x, 7), modulo(y, 5));
                Color const clamped = ImageLookup{im, 1, true, true, filter}.at(uv),
                            edge = texel(*im, 0, std::clamp(x, 0, 6), std::clamp(y, 0, 4));
                Color const around = ImageLookup{im, 1, false, true, filter}.at(uv),
                            ring = texel(*im, 0, modulo(x, 7), std::clamp(y, 0, 4));
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(repeated[c], expected[c], 1e-5f);
                    EXPECT_NEAR(clamped[c], edge[c], 1e-5f);
                    EXPECT_NEAR(around[c], ring[c], 1e-5f);
                }
            }
        }
}

TEST(ImageLookup, AnyCoordinateIsSafe) {
    auto const im = noise(7, 5);
    float const inf = std::numeric_limits<float>::infinity();
    for (float u : {1e9f, -1e9f, 1e30f, -1e30f, inf, -inf, std::nanf("")})
        for (scene::TextureFilter filter :
             {scene::TextureFilter::nearest, scene::TextureFilter::bilinear,
              scene::TextureFilter::mipmap})
            for (bool clamp : {false, true})
                ImageLookup{im, 1, clamp, clamp, filter}.at({u, u}, {{u, u}, {u, u}});
}

TEST(ImageLookup, FootprintsMatterToMipmapAlone) {
    auto const im = noise(64, 64);
    UvFootprint const wide{{0.2f, 0}, {0, 0.2f}};
    Vec2 const uv(0.3f, 0.7f);
    for (scene::TextureFilter filter :
         {scene::TextureFilter::nearest, scene::TextureFilter::bilinear}) {
        ImageLookup const l{im, 1, false, false, filter};
        EXPECT_EQ(l.at(uv), l.at(uv, wide));
    }
    ImageLookup const l{im, 1, false, false, scene::TextureFilter::mipmap};
    EXPECT_NE(l.at(uv), l.at(uv, wide));
    // Below the size of a texel it is the image itself, bit by bit.
    ImageLookup const sharp{im, 1, false, false, scene::TextureFilter::bilinear};
    EXPECT_EQ(l.at(uv, {{1 / 64.f, 0}, {0, 1 / 64.f}}), sharp.at(uv));
    EXPECT_EQ(l.at(uv), sharp.at(uv));
}

TEST(ImageLookup, LevelsFollowTheFootprint) {
    auto const im = noise(256, 64);
    ImageLookup const l{im, 1, false, false, scene::TextureFilter::mipmap};
    auto isotropic = [](float texels) { return UvFootprint{{texels / 256, 0}, {0, texels / 64}}; };
    for (int k = 0; k < 6; ++k) EXPECT_FLOAT_EQ(l.level_of(isotropic(float(1 << k))), float(k));
    EXPECT_NEAR(l.level_of(isotropic(6)), 2.585f, 0.05f);
    // Of a long ellipse the shorter axis counts, up to 1 : 4, whichever is which.
    EXPECT_FLOAT_EQ(l.level_of({{8 / 256.f, 0}, {0, 2 / 64.f}}), 1);
    EXPECT_FLOAT_EQ(l.level_of({{2 / 256.f, 0}, {0, 8 / 64.f}}), 1);
    EXPECT_FLOAT_EQ(l.level_of({{32 / 256.f, 0}, {0, 1 / 64.f}}), 3);
    // The widest footprint sees the mean of the image everywhere.
    EXPECT_EQ(l.at({0.1f, 0.2f}, isotropic(1e6f)), l.at({0.9f, 0.5f}, isotropic(1e6f)));
    EXPECT_NEAR(l.at({0, 0}, isotropic(1e6f)).g, 0.5f, 0.01f);
}

TEST(ImageLookup, GoesFromLevelToLevelWithoutAStep) {
    auto const im = noise(128, 128);
    ImageLookup const l{im, 1, false, false, scene::TextureFilter::mipmap};
    Vec2 const uv(0.41f, 0.13f);
    auto at = [&](float texels) { return l.at(uv, {{texels / 128, 0}, {0, texels / 128}}).r; };
    for (float w = 1; w < 200; w *= 1.001f) EXPECT_NEAR(at(w), at(w * 1.001f), 2e-3f) << w;
}
