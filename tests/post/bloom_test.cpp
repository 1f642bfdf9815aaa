// Bloom: where the light goes, and that none is lost.
#include "post/bloom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/hash.h"
#include "io/scene_file.h"

using namespace weft;

namespace {

double sum_of(image::Image const& image, int channel) {
    double sum = 0;
    for (size_t i = size_t(channel); i < image.pixels.size(); i += size_t(image.channels))
        sum += image.pixels[i];
    return sum;
}

image::Image random_light(int width, int height, int channels) {
    Rng rng(7);
    image::Image image = image::make_image(width, height, channels);
    for (float& x : image.pixels) x = rng.next();
    return image;
}

scene::Bloom glare(float strength) {
    scene::Bloom bloom;
    bloom.strength = strength;
    return bloom;
}

scene::Bloom over_threshold(float threshold, float sigma, int radius = 0) {
    scene::Bloom bloom;
    bloom.kind = scene::BloomKind::threshold;
    bloom.threshold = threshold, bloom.sigma = sigma, bloom.radius = radius;
    return bloom;
}

} // namespace

/// The sum that each pixel stands for, term by term, with the picture mirrored at its borders.
TEST(Convolve, IsTheSumOverTheMirroredPicture) {
    int const w = 12, h = 7;
    image::Image const image = random_light(w, h, 1);
    post::EvenKernel const kernel = post::glare_kernel(w, h, 40);
    auto weight = [&](int dx, int dy) {
        return double(kernel.weights[size_t(std::abs(dy)) * size_t(w + 1) + size_t(std::abs(dx))]);
    };
    auto mirrored = [](int i, int n) {
        i = ((i % (2 * n)) + 2 * n) % (2 * n);
        return i < n ? i : 2 * n - 1 - i;
    };
    double total = 0;
    for (int dy = -h + 1; dy <= h; ++dy)
        for (int dx = -w + 1; dx <= w; ++dx) total += weight(dx, dy);
    std::vector<float> values = image.pixels;
    post::convolve(values, kernel);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            double expected = 0;
            for (int dy = -h + 1; dy <= h; ++dy)
                for (int dx = -w + 1; dx <= w; ++dx)
                    expected +=
                        weight(dx, dy) * image.at(mirrored(x + dx, w), mirrored(y + dy, h), 0);
            EXPECT_NEAR(values[size_t(y * w + x)], expected / total, 1e-6) << x << " " << y;
        }
}

TEST(Glare, KeepsAllLight) {
    for (auto [w, h] : {std::pair{64, 48}, {101, 37}, {1, 1}, {1, 9}, {320, 180}}) {
        image::Image image = random_light(w, h, 3);
        image.at(w / 3, h / 2, 0) = 1e6f; // a sun
        image.at(0, 0, 1) = 3e4f;         // and one in the corner
        image::Image const bloomed = post::apply_bloom(glare(0.4f), image);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum_of(bloomed, c) / sum_of(image, c), 1, 1e-4) << w << " x " << h;
        for (float x : bloomed.pixels) EXPECT_GE(x, 0);
    }
}

TEST(Glare, APictureOfOneColourStays) {
    image::Image image = image::make_image(50, 40, 3);
    for (float& x : image.pixels) x = 0.7f;
    for (float x : post::apply_bloom(glare(0.62f), image).pixels) EXPECT_NEAR(x, 0.7f, 1e-5);
}

TEST(Glare, NoStrengthIsNoChange) {
    image::Image const image = random_light(30, 20, 3);
    EXPECT_EQ(post::apply_bloom(glare(0), image).pixels, image.pixels);
}

/// 0.478 f1 + 0.138 f2 of Spencer et al. 1995, which integrate to 1 over the half sphere where
/// angles are small.
TEST(Glare, FallsOffAsPublished) {
    auto f1 = [](double t) { return 20.91 / std::pow(t + 0.02, 3); };
    auto f2 = [](double t) { return 72.37 / std::pow(t + 0.02, 2); };
    double sum = 0;
    double const step = 0.001, square_degree = std::pow(M_PI / 180, 2);
    for (double t = step / 2; t < 90; t += step)
        sum += 2 * M_PI * t * (0.478 * f1(t) + 0.138 * f2(t)) * step * square_degree;
    EXPECT_NEAR(sum, 0.62, 0.01); // what the help says of the eye

    auto const kernel = post::glare_kernel(200, 150, 20); // 0.1 degrees a pixel
    auto weight = [&](int x, int y) { return double(kernel.weights[size_t(y * 201 + x)]); };
    for (int d : {10, 20, 40, 80, 150}) {
        double const expected = 0.478 * f1(0.1 * d) + 0.138 * f2(0.1 * d);
        EXPECT_NEAR(weight(d, 0) / expected, 1, 5e-3) << d;
        EXPECT_NEAR(weight(0, d) / weight(d, 0), 1, 1e-6) << d;
    }
    EXPECT_NEAR(weight(60, 80) / weight(100, 0), 1, 1e-4); // round
}

/// The same scene at half the resolution glares as far, in degrees.
TEST(Glare, DoesNotDependOnTheResolution) {
    auto beyond_2_degrees = [](int n) {
        image::Image image = image::make_image(n, n, 1);
        for (int y = n / 2 - n / 80; y < n / 2 + n / 80; ++y)
            for (int x = n / 2 - n / 80; x < n / 2 + n / 80; ++x) image.at(x, y, 0) = 1;
        double const all = sum_of(image, 0);
        image::Image const bloomed = post::apply_bloom(glare(1), image);
        double beyond = 0;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                if (std::hypot(x + 0.5 - n / 2, y + 0.5 - n / 2) * 40 / n > 2)
                    beyond += bloomed.at(x, y, 0);
        return beyond / all;
    };
    EXPECT_NEAR(beyond_2_degrees(160), beyond_2_degrees(320), 0.005);
    EXPECT_GT(beyond_2_degrees(160), 0.1);
}

TEST(Bloom, WhatIsNotFiniteStaysAndScattersNothing) {
    image::Image image = random_light(40, 30, 4);
    image.at(10, 10, 1) = std::numeric_limits<float>::quiet_NaN();
    image.at(20, 10, 2) = std::numeric_limits<float>::infinity();
    for (scene::Bloom const& bloom : {glare(0.3f), over_threshold(0.5f, 2)}) {
        image::Image const bloomed = post::apply_bloom(bloom, image);
        int bad = 0;
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                for (int c = 0; c < 3; ++c) bad += !std::isfinite(bloomed.at(x, y, c));
                EXPECT_EQ(bloomed.at(x, y, 3), image.at(x, y, 3)) << "alpha";
            }
        EXPECT_EQ(bad, 2);
        EXPECT_TRUE(std::isnan(bloomed.at(10, 10, 1)));
    }
}

TEST(Bloom, ThresholdAddsABlurredCopyOfTheBright) {
    image::Image image = image::make_image(41, 41, 3);
    for (float& x : image.pixels) x = 0.5f;
    image.at(20, 20, 0) = 4, image.at(20, 20, 1) = 2, image.at(20, 20, 2) = 1;
    image::Image const bloomed = post::apply_bloom(over_threshold(1, 2, 6), image);
    // 3 / 4 of the pixel is brighter than the threshold.
    EXPECT_NEAR(sum_of(bloomed, 0) - sum_of(image, 0), 3, 1e-3);
    EXPECT_NEAR(sum_of(bloomed, 2) - sum_of(image, 2), 0.75, 1e-3);
    double const middle = bloomed.at(20, 20, 0) - 4.;
    EXPECT_NEAR((bloomed.at(22, 20, 0) - 0.5) / middle, std::exp(-0.5), 1e-3);
    EXPECT_NEAR(bloomed.at(27, 20, 0), 0.5, 1e-6);
    image::Image const dim = random_light(20, 20, 3);
    EXPECT_EQ(post::apply_bloom(over_threshold(1, 2), dim).pixels, dim.pixels);
}

TEST(Bloom, SceneFilesOfLightwaveMeanTheThreshold) {
    auto kind_of = [](std::string const& attributes) {
        auto const file = io::parse_scene(
            "<integrator type='path'><scene><camera type='perspective'/></scene><image "
            "id='a'/></integrator><postprocess type='bloom'" +
                attributes + "><ref name='input' id='a'/><image id='b'/></postprocess>",
            "s.xml", "");
        return std::get<scene::Bloom>(file.postprocesses.at(0).postprocess).kind;
    };
    EXPECT_EQ(kind_of(""), scene::BloomKind::glare);
    EXPECT_EQ(kind_of(" threshold='1.3'"), scene::BloomKind::threshold);
    EXPECT_EQ(kind_of(" kind='threshold'"), scene::BloomKind::threshold);
}
