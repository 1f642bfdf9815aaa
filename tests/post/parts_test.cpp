// Pictures that sum to one, and the layers of a file.
#include <gtest/gtest.h>

#include "post/denoise_parts.h"
#include "tests/post/pictures.h"

namespace weft::post {
namespace {

using namespace weft::testing;

TEST(DenoisedParts, SumToTheDenoisedWhole) {
    std::vector<image::Image> parts{noisy_picture(90, 70, 1), noisy_picture(90, 70, 2),
                                    noisy_picture(90, 70, 3), constant_picture(90, 70, 0)};
    for (float& x : parts[1].pixels) x *= 300;
    for (float& x : parts[2].pixels) x *= 1e-3f;
    image::Image const albedo = constant_picture(90, 70, 0.5f);
    image::Image sum = constant_picture(90, 70, 0);
    for (auto const& part : parts)
        for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += part.pixels[i];
    for (Backend backend : {Backend::nlm, Backend::automatic}) {
        DenoiseOptions options;
        options.backend = backend;
        auto const result = denoise_parts(parts, {nullptr, &albedo}, options);
        EXPECT_EQ(result.whole.pixels, denoise({&sum, &albedo}, options).image.pixels);
        ASSERT_EQ(result.parts.size(), parts.size());
        for (size_t i = 0; i < sum.pixels.size(); ++i) {
            double total = 0;
            for (auto const& part : result.parts) total += double(part.pixels[i]);
            double const whole = double(result.whole.pixels[i]);
            ASSERT_NEAR(total, whole, 1e-6 * whole);
        }
        for (float x : result.parts[3].pixels) EXPECT_EQ(x, 0);
        // The parts are still what they were: the small one is no copy of the large one.
        double small = 0, before = 0;
        for (size_t i = 0; i < sum.pixels.size(); ++i) {
            small += double(result.parts[2].pixels[i]);
            before += double(parts[2].pixels[i]);
        }
        EXPECT_NEAR(small / before, 1, 0.3);
    }
}

TEST(DenoisedParts, OfBlackAreBlack) {
    std::vector<image::Image> const parts{constant_picture(8, 8, 0), constant_picture(8, 8, 0)};
    DenoiseOptions options;
    options.backend = Backend::nlm;
    for (auto const& part : denoise_parts(parts, {}, options).parts)
        for (float x : part.pixels) EXPECT_EQ(x, 0);
}

} // namespace
} // namespace weft::post
