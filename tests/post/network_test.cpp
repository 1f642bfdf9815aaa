// The network with what goes in and comes out: with weights made here, and with the published ones
// where they are installed.
#include <gtest/gtest.h>

#include <dlfcn.h>
#include <tbb/global_control.h>

#include <fstream>
#include <limits>

#include "post/network.h"
#include "tests/post/pictures.h"
#include "tests/support/scenes.h"

namespace weft::post {
namespace {

using namespace weft::testing;

TEST(HdrCurve, JoinsRisesAndComesBack) {
    EXPECT_EQ(encode_hdr(0), 0);
    EXPECT_NEAR(encode_hdr(65504), 1, 1e-6);
    EXPECT_NEAR(encode_hdr(1), 1 / 3.1351f, 2e-3) << "100 cd/m^2 is 1 before the last scaling";
    float last = 0;
    for (double y = 1e-9; y < 65504; y *= 1.001) {
        float const code = encode_hdr(float(y));
        EXPECT_GT(code, last) << y;
        EXPECT_NEAR(decode_hdr(code), y, 5e-5 * y + 1e-9) << y;
        last = code;
    }
}

/// Weights in a file of a folder that lasts as long as this.
struct WeightsOnDisk {
    TemporaryFolder folder;
    std::string path = folder / "w.tza";
    explicit WeightsOnDisk(Weights const& weights) {
        std::ofstream(path, std::ios::binary) << weights_bytes(weights);
    }
};

void expect_near(image::Image const& a, image::Image const& b, double relative,
                 char const* what = "") {
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    double worst = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        double const scale = std::max(1e-3, std::abs(double(b.pixels[i])));
        worst = std::max(worst, std::abs(double(a.pixels[i]) - double(b.pixels[i])) / scale);
    }
    EXPECT_LT(worst, relative) << what;
}

TEST(Network, OfIdentityGivesThePictureBack) {
    WeightsOnDisk const weights(identity_weights(9));
    // A size that is no multiple of anything, and light of a thousand times the rest.
    image::Image color = noisy_picture(131, 77);
    for (int y = 20; y < 30; ++y)
        for (int x = 20; x < 30; ++x)
            for (int c = 0; c < 3; ++c) color.at(x, y, c) = 1000;
    image::Image const other = constant_picture(131, 77, 0.5f);
    expect_near(denoise_network({&color, &other, &other}, {weights.path, "", ""}, 1024), color,
                1e-4);

    // What is no light becomes black, what is beyond the range its end.
    image::Image odd = color;
    float const nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    odd.at(1, 2, 0) = nan;
    odd.at(3, 4, 1) = -infinity;
    odd.at(5, 6, 2) = infinity;
    odd.at(7, 8, 0) = -5;
    odd.at(9, 10, 1) = 3e38f;
    image::Image const result = denoise_network({&odd, &odd, &odd}, {weights.path, "", ""}, 1024);
    for (float x : result.pixels) EXPECT_TRUE(std::isfinite(x) && x >= 0);
    EXPECT_EQ(result.at(1, 2, 0), 0);
    EXPECT_EQ(result.at(3, 4, 1), 0);
    EXPECT_EQ(result.at(5, 6, 2), 0);
    EXPECT_EQ(result.at(7, 8, 0), 0);
    EXPECT_GT(result.at(9, 10, 1), 1e4);
}

TEST(Network, TilesDoNotShow) {
    WeightsOnDisk const weights(random_weights(3, 5));
    image::Image const color = noisy_picture(900, 700);
    auto result = [&](int memory) {
        return denoise_network({&color}, {weights.path, "", ""}, memory);
    };
    auto const tiles = tile_count(UnetSize::base, color.width, color.height, 3, 120);
    ASSERT_GT(tiles, 3);
    ASSERT_EQ(tile_count(UnetSize::base, color.width, color.height, 3, 4096), 1);
    expect_near(result(120), result(4096), 1e-4);
}

TEST(Network, SaysWhereMemoryIsShort) {
    WeightsOnDisk const weights(random_weights(3, 5));
    image::Image const color = noisy_picture(900, 700);
    EXPECT_THROW(denoise_network({&color}, {weights.path, "", ""}, 10), InputError);
}

/// OpenMP's threads, which oneDNN uses; the library is there, since oneDNN is.
void use_threads(int count) {
    using Set = void(int);
    auto* const set = reinterpret_cast<Set*>(dlsym(RTLD_DEFAULT, "omp_set_num_threads"));
    if (set) set(count);
}

TEST(Network, DoesNotDependOnThreads) {
    WeightsOnDisk const weights(random_weights(3, 6));
    image::Image const color = noisy_picture(200, 150);
    image::Image first;
    for (int threads : {1, 2, 5}) {
        use_threads(threads);
        tbb::global_control const limit(tbb::global_control::max_allowed_parallelism,
                                        size_t(threads));
        image::Image const result = denoise_network({&color}, {weights.path, "", ""}, 1024);
        if (first.pixels.empty()) first = result;
        EXPECT_EQ(first.pixels, result.pixels) << threads;
    }
}

// --- with the published weights

/// The paths of the weights for `input`, if they are all there.
std::optional<NetworkWeights> published(DenoiseInput const& input,
                                        Quality quality = Quality::high) {
    return find_weights(weights_files(input, quality), weight_folders());
}

#define PUBLISHED_OR_SKIP(input)                                                                   \
    if (!published(input))                                                                         \
    GTEST_SKIP() << "no published weights here: tools/setup denoise fetches them"

TEST(PublishedNetwork, TilesDoNotShow) {
    image::Image const color = noisy_picture(520, 430);
    image::Image const albedo = noisy_picture(520, 430, 2), normal = noisy_picture(520, 430, 3);
    DenoiseInput const input{&color, &albedo, &normal};
    PUBLISHED_OR_SKIP(input);
    ASSERT_GT(tile_count(UnetSize::large, color.width, color.height, 9, 256), 1);
    expect_near(denoise_network(input, *published(input), 256),
                denoise_network(input, *published(input), 4096), 1e-4);
}

TEST(PublishedNetwork, KeepsConstants) {
    for (float value : {0.f, 1e-3f, 0.18f, 1.f, 50.f}) {
        image::Image const color = constant_picture(150, 100, value),
                           half = constant_picture(150, 100, 0.5f);
        for (DenoiseInput const& input : {DenoiseInput{&color}, DenoiseInput{&color, &half},
                                          DenoiseInput{&color, &half, &half}}) {
            PUBLISHED_OR_SKIP(input);
            image::Image const result = denoise_network(input, *published(input), 1024);
            for (float x : result.pixels) ASSERT_EQ(x, value);
        }
    }
}

TEST(PublishedNetwork, KeepsLightsBright) {
    image::Image color = noisy_picture(160, 120);
    double before = 0, after = 0;
    for (int y = 40; y < 60; ++y)
        for (int x = 70; x < 100; ++x)
            for (int c = 0; c < 3; ++c) before += double(color.at(x, y, c) = 500);
    DenoiseInput const input{&color};
    PUBLISHED_OR_SKIP(input);
    image::Image const result = denoise_network(input, *published(input), 1024);
    for (int y = 40; y < 60; ++y)
        for (int x = 70; x < 100; ++x)
            for (int c = 0; c < 3; ++c) after += double(result.at(x, y, c));
    EXPECT_NEAR(after / before, 1, 0.05);
}

TEST(PublishedNetwork, GivesFiniteLightForAnything) {
    image::Image const color = unfit_picture(96, 80, 3), albedo = unfit_picture(96, 80, 4),
                       normal = unfit_picture(96, 80, 5);
    DenoiseInput const input{&color, &albedo, &normal};
    PUBLISHED_OR_SKIP(input);
    for (float x : denoise_network(input, *published(input), 1024).pixels)
        ASSERT_TRUE(std::isfinite(x) && x >= 0);
}

} // namespace
} // namespace weft::post
