// Tone mapping: closed forms, and what no light can be.
#include <gtest/gtest.h>

#include "pictures.h"
#include "post/apply.h"

using namespace weft;

namespace {

image::Image mapped(image::Image const& picture, scene::ToneOperator curve, float bias = 0.85f) {
    scene::Tonemap tonemap;
    tonemap.input.index = 0;
    tonemap.curve = curve, tonemap.bias = bias;
    post::Pictures pictures;
    pictures[0].image = picture;
    return post::apply(tonemap, post::Inputs{pictures}).image;
}

image::Image one_row(int channels, std::vector<float> pixels) {
    image::Image image = image::make_image(int(pixels.size()) / channels, 1, channels);
    image.pixels = std::move(pixels);
    return image;
}

} // namespace

TEST(Tonemap, ReinhardByChannel) {
    image::Image const out =
        mapped(one_row(4, {3, 1, 0, 7, 0.25f, 99, 1e30f, 0}), scene::ToneOperator::reinhard);
    EXPECT_EQ(out.pixels, (std::vector<float>{0.75f, 0.5f, 0, 7, 0.2f, 0.99f, 1, 0}))
        << "alpha stays";
}

/// The display's luminance for the world's (equation 4), with log10 and the base between 2 and 10.
TEST(Tonemap, DragoIsItsFormula) {
    for (float const bias : {0.5f, 0.85f, 1.f}) {
        image::Image const out =
            mapped(one_row(1, {8, 2, 0.5f, 0}), scene::ToneOperator::drago, bias);
        EXPECT_NEAR(out.pixels[0], 1, 1e-6) << "the brightest";
        for (int i = 1; i < 3; ++i) {
            double const l = i == 1 ? 2 : 0.5;
            double const base = 2 + 8 * std::pow(l / 8, std::log(bias) / std::log(0.5));
            EXPECT_NEAR(out.pixels[size_t(i)],
                        std::log10(l + 1) / std::log10(base) / std::log10(9.0), 1e-6)
                << bias;
        }
        EXPECT_EQ(out.pixels[3], 0);
    }
}

TEST(Tonemap, DragoKeepsColours) {
    image::Image const out = mapped(one_row(3, {4, 2, 1, 40, 20, 10}), scene::ToneOperator::drago);
    for (size_t i : {0u, 3u}) {
        EXPECT_NEAR(out.pixels[i], 2 * out.pixels[i + 1], 1e-6);
        EXPECT_NEAR(out.pixels[i], 4 * out.pixels[i + 2], 1e-6);
    }
    EXPECT_NEAR(luminance(Color(out.pixels[3], out.pixels[4], out.pixels[5])), 1, 1e-6);
    EXPECT_GT(out.pixels[0], 0.1f * out.pixels[3]);
}

TEST(Tonemap, WhatIsNoLight) {
    float const nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();
    for (scene::ToneOperator const curve :
         {scene::ToneOperator::reinhard, scene::ToneOperator::drago}) {
        image::Image const out = mapped(one_row(1, {nan, inf, -1, 2, 0}), curve);
        EXPECT_TRUE(std::isnan(out.pixels[0])) << "a fault of a picture stays to be seen";
        EXPECT_EQ(out.pixels[2], -1);
        EXPECT_GT(out.pixels[3], 0.6f);
        EXPECT_LT(out.pixels[3], 1.001f);
        EXPECT_EQ(out.pixels[4], 0);
        EXPECT_EQ(mapped(one_row(3, {0, 0, 0}), curve).pixels, (std::vector<float>{0, 0, 0}));
    }
    EXPECT_EQ(mapped(one_row(1, {inf}), scene::ToneOperator::reinhard).pixels[0], 1);
    for (float x :
         mapped(weft::testing::unfit_picture(16, 16, 3), scene::ToneOperator::reinhard).pixels)
        EXPECT_TRUE(!(x > 1));
}
