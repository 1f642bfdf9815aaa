// FLIP: what its papers state, and properties that follow from them.
#include "post/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/color.h"
#include "base/error.h"
#include "base/hash.h"

using namespace weft;

namespace {

image::Image uniform(Color const& c, int width = 40, int height = 30) {
    image::Image image = image::make_image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int i = 0; i < 3; ++i) image.at(x, y, i) = c[i];
    return image;
}

image::Image noise(uint64_t seed, float scale) {
    Rng rng(seed);
    image::Image image = image::make_image(48, 32, 3);
    for (float& x : image.pixels) x = scale * rng.next();
    return image;
}

/// Light over 12 stops, with a bright spot.
image::Image scene_light(float noise_scale, uint64_t seed) {
    Rng rng(seed);
    image::Image image = image::make_image(64, 48, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = std::exp2(float(x) / 8 - 6 + float(c)) *
                                    (1 + noise_scale * (rng.next() - 0.5f));
    image.at(10, 10, 0) = image.at(10, 10, 1) = image.at(10, 10, 2) = 300;
    return image;
}

} // namespace

TEST(Flip, EqualPicturesHaveNone) {
    image::Image const a = noise(1, 1);
    for (float e : post::ldr_flip(a, a).pixels) EXPECT_EQ(e, 0);
    image::Image const light = scene_light(0, 1);
    EXPECT_EQ(post::mean_error(post::hdr_flip(light, light).errors), 0);
}

/// The distance that the error is relative to is that of green and blue (2020, section 4.1.3).
TEST(Flip, GreenAndBlueAreAsFarApartAsCanBe) {
    image::Image const e = post::ldr_flip(uniform({0, 1, 0}), uniform({0, 0, 1}));
    for (float x : e.pixels) EXPECT_NEAR(x, 1, 1e-5);
}

/// Uniform pictures have no features and are not changed by blurring, so that FLIP is the colour
/// difference: for greys, |L1 - L2| to the power of 0.7 over 41.2760 (2020, c_max), times 0.95 /
/// 0.4 below the knee and what is left above it.
TEST(Flip, UniformGreysFollowTheFormula) {
    auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
    for (auto [a, b] : {std::pair{0.2, 0.25}, {0.5, 0.9}, {0.05, 0.95}, {0.1, 0.1001}}) {
        double const far = 41.2760, knee = 0.4 * far;
        double const d = std::pow(std::abs(lightness(a) - lightness(b)), 0.7);
        double const expected =
            d < knee ? 0.95 / knee * d : 0.95 + (d - knee) / (far - knee) * 0.05;
        image::Image const e = post::ldr_flip(uniform(Color(float(a))), uniform(Color(float(b))));
        for (float x : e.pixels) EXPECT_NEAR(x, expected, 2e-4) << a << " " << b;
    }
}

TEST(Flip, BothWaysAreTheSameAndWithinRange) {
    image::Image const a = noise(1, 1), b = noise(2, 1.3f);
    image::Image const forth = post::ldr_flip(a, b), back = post::ldr_flip(b, a);
    EXPECT_EQ(forth.pixels, back.pixels);
    for (float e : forth.pixels) {
        EXPECT_GE(e, 0);
        EXPECT_LE(e, 1);
    }
    EXPECT_GT(post::mean_error(forth), 0.05);
}

/// More distance or fewer pixels per degree: noise blurs away.
TEST(Flip, WhatIsTooFineIsNotSeen) {
    image::Image const a = noise(1, 1), b = noise(2, 1);
    double last = 2;
    for (float ppd : {10.f, 30.f, 67.f, 150.f}) {
        double const error = post::mean_error(post::ldr_flip(a, b, ppd));
        EXPECT_LT(error, last) << ppd;
        last = error;
    }
}

/// An edge that is there in one picture alone counts for more than its difference of colour.
TEST(Flip, EdgesCount) {
    image::Image const flat = uniform(Color(0.5f));
    image::Image step = flat;
    for (int y = 0; y < step.height; ++y)
        for (int x = 20; x < step.width; ++x)
            for (int c = 0; c < 3; ++c) step.at(x, y, c) = 0.6f;
    image::Image const e = post::ldr_flip(flat, step);
    float const at_edge = e.at(20, 15, 0), away = e.at(39, 15, 0);
    EXPECT_GT(at_edge, away);
    EXPECT_EQ(e.at(0, 15, 0), 0);
}

/// Of an edge it knows: where the pictures are not black, HDR-FLIP does not depend on exposure.
TEST(HdrFlip, DoesNotDependOnTheUnitOfLight) {
    image::Image a = scene_light(0, 1), b = scene_light(0.2f, 2);
    post::HdrFlip const plain = post::hdr_flip(a, b);
    for (image::Image* i : {&a, &b})
        for (float& x : i->pixels) x *= 16;
    post::HdrFlip const brighter = post::hdr_flip(a, b);
    EXPECT_NEAR(brighter.start, plain.start - 4, 1e-4);
    EXPECT_EQ(brighter.exposures, plain.exposures);
    EXPECT_NEAR(post::mean_error(brighter.errors), post::mean_error(plain.errors), 1e-4);
}

/// The exposures of the 2021 paper: log2 of the light that Narkowicz' curve shows as 0.85 over the
/// brightest and over the median luminance, at most a stop apart.
TEST(HdrFlip, ExposuresCoverTheReference) {
    image::Image a = uniform(Color(0.25f));
    for (int c = 0; c < 3; ++c) a.at(3, 3, c) = 64;
    post::HdrFlip const flip = post::hdr_flip(a, a);
    EXPECT_NEAR(flip.stop - flip.start, 8, 1e-4);
    EXPECT_EQ(flip.exposures, 8);
    double const x = 64 * std::exp2(double(flip.start)) * 0.6;
    EXPECT_NEAR(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.85, 1e-5);
}

TEST(HdrFlip, SeesHighlightsThatClippingHides) {
    image::Image const a = scene_light(0, 1);
    image::Image b = a;
    for (int c = 0; c < 3; ++c) b.at(10, 10, c) = 3;
    EXPECT_GT(post::hdr_flip(a, b).errors.at(10, 10, 0), 0.3f);
    EXPECT_LT(post::ldr_flip(a, b).at(10, 10, 0), 1e-6f);
}

TEST(HdrFlip, TakesAnyNumbers) {
    image::Image a = scene_light(0.1f, 1), b = scene_light(0.1f, 2);
    a.pixels[100] = std::numeric_limits<float>::quiet_NaN();
    b.pixels[200] = std::numeric_limits<float>::infinity();
    b.pixels[300] = -1e30f;
    for (float e : post::hdr_flip(a, b).errors.pixels) EXPECT_TRUE(e >= 0 && e <= 1);
    image::Image const black = uniform(Color(0));
    EXPECT_EQ(post::mean_error(post::hdr_flip(black, black).errors), 0);
    EXPECT_THROW(post::hdr_flip(a, black), InputError);
}
