#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "image/compare.h"
#include "post/nlm.h"
#include "tests/post/pictures.h"

namespace weft::post {
namespace {

using namespace weft::testing;

TEST(Nlm, KeepsConstants) {
    for (float value : {0.f, 1e-6f, 0.18f, 1.f, 3000.f}) {
        image::Image const color = constant_picture(100, 70, value),
                           half = constant_picture(100, 70, 0.5f);
        for (DenoiseInput const& input : {DenoiseInput{&color}, DenoiseInput{&color, &half, &half}})
            for (float x : denoise_nlm(input).pixels) ASSERT_NEAR(x, value, 1e-5f * value);
    }
}

TEST(Nlm, TakesNoiseOutAndKeepsEdges) {
    Rng rng(2);
    auto clean = [](int x, int, int) { return x < 50 ? 0.2f : 0.8f; };
    image::Image const truth = picture_of(100, 80, clean);
    image::Image const noisy = picture_of(100, 80, [&](int x, int y, int c) {
        float sum = 0;
        for (int i = 0; i < 16; ++i) sum += float(rng.next_uint() >> 8) / 16777216.f;
        return clean(x, y, c) * sum / 8;
    });
    image::Image const result = denoise_nlm({&noisy});
    EXPECT_LT(image::compare(result, truth).mse, 0.08 * image::compare(noisy, truth).mse);
    double left = 0, right = 0;
    for (int y = 0; y < 80; ++y) {
        left += double(result.at(49, y, 0)) / 80;
        right += double(result.at(50, y, 0)) / 80;
    }
    EXPECT_NEAR(left, 0.2, 0.02);
    EXPECT_NEAR(right, 0.8, 0.04);
}

TEST(Nlm, KeepsLightsBrightAndLoneSamplesOut) {
    image::Image color = noisy_picture(128, 96);
    for (int y = 40; y < 48; ++y)
        for (int x = 60; x < 68; ++x)
            for (int c = 0; c < 3; ++c) color.at(x, y, c) = 500;
    for (int c = 0; c < 3; ++c) color.at(20, 20, c) = 500;
    image::Image const result = denoise_nlm({&color});
    for (int y = 40; y < 48; ++y)
        for (int x = 60; x < 68; ++x)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(result.at(x, y, c), 500, 15);
    EXPECT_LT(result.at(20, 20, 1), 5);
    for (int x : {58, 59, 68, 69}) EXPECT_LT(result.at(x, 44, 1), 5) << "light smeared";
}

TEST(Nlm, FeaturesKeepWhatColourCannotTell) {
    // Two surfaces, one twice as bright as the other, under the same noise.
    Rng rng(9);
    auto albedo_at = [](int x, int, int) { return (x / 4) % 2 ? 0.6f : 0.3f; };
    image::Image const albedo = picture_of(96, 64, albedo_at);
    image::Image const noisy = picture_of(96, 64, [&](int x, int y, int c) {
        return albedo_at(x, y, c) * -std::log(1 - 0.999f * float(rng.next_uint()) / 4294967296.f);
    });
    double with = image::compare(denoise_nlm({&noisy, &albedo}), albedo).mse,
           without = image::compare(denoise_nlm({&noisy}), albedo).mse;
    EXPECT_LT(with, 0.7 * without);
}

TEST(Nlm, TilesAndThreadsDoNotShow) {
    image::Image const color = noisy_picture(192, 160), albedo = noisy_picture(192, 160, 4);
    image::Image const whole = denoise_nlm({&color, &albedo});
    for (size_t threads : {1, 2, 5}) {
        tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_EQ(denoise_nlm({&color, &albedo}).pixels, whole.pixels);
    }
    // Moved around by whole blocks of the exposure, which it therefore keeps, and not whole tiles.
    image::Image moved = image::make_image(192, 160, 3), moved_albedo = moved;
    auto shift = [](image::Image const& from, image::Image& to) {
        for (int y = 0; y < 160; ++y)
            for (int x = 0; x < 192; ++x)
                for (int c = 0; c < 3; ++c)
                    to.at(x, y, c) = from.at((x + 16) % 192, (y + 32) % 160, c);
    };
    shift(color, moved);
    shift(albedo, moved_albedo);
    image::Image const other = denoise_nlm({&moved, &moved_albedo});
    for (int y = 20; y < 108; ++y)
        for (int x = 20; x < 156; ++x)
            EXPECT_NEAR(other.at(x, y, 1), whole.at(x + 16, y + 32, 1),
                        1e-4f * whole.at(x + 16, y + 32, 1));
}

TEST(Nlm, GivesFiniteLightForAnything) {
    image::Image const color = unfit_picture(80, 70, 3), albedo = unfit_picture(80, 70, 4),
                       normal = unfit_picture(80, 70, 5);
    for (float x : denoise_nlm({&color, &albedo, &normal}).pixels)
        ASSERT_TRUE(std::isfinite(x) && x >= 0);
}

} // namespace
} // namespace weft::post
