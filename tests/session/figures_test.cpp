// The figures of scenes/figures: each one loads and renders, and the light and the card of
// light_or_card.xml are the same.
#include <gtest/gtest.h>

#include "session/render.h"
#include "tests/support/scenes.h"

namespace weft::session {
namespace {

using namespace weft::testing;

std::string const kFolder = std::string(WEFT_SOURCE_DIR) + "/scenes/figures/";

RenderResult render_figure(lights::Stage const& stage, scene::RenderJob const& job, int spp,
                           uint32_t seed) {
    RenderOptions options;
    options.limits.spp = spp;
    options.picture.seed = seed;
    return render(stage, job, options);
}

TEST(Figures, LoadAndRender) {
    int count = 0;
    for (auto const& entry : std::filesystem::directory_iterator(kFolder)) {
        if (entry.path().extension() != ".xml" || entry.path().stem() == "studio") continue;
        ++count;
        SCOPED_TRACE(entry.path().stem().string());
        auto const file = io::read_scene_file(entry.path().string());
        ASSERT_EQ(file.jobs.size(), 1u);
        EXPECT_EQ(file.jobs[0].image_name, entry.path().stem());
        EXPECT_TRUE(file.warnings.empty());
        auto const stage = lights::Stage::commit(file.jobs[0].scene, {"", {64, 36}});
        RenderResult const result = render_figure(*stage, file.jobs[0], 4, 1);
        EXPECT_EQ(result.bad_samples, 0u);
        double mean = 0;
        for (float value : result.image.pixels) mean += double(value);
        mean /= double(result.image.pixels.size());
        EXPECT_TRUE(mean > 0.02 && mean < 2) << "badly exposed: " << mean;
    }
    EXPECT_EQ(count, 15);
}

/// Both halves of the picture by blocks of pixels: the mean of each over many seeds, whose
/// pictures are independent, and its variance.
TEST(Figures, LightAndCardAgree) {
    constexpr int kWidth = 32, kHeight = 18, kBlock = 4, kRows = 3, kSeeds = 120;
    constexpr int kBlocks = kWidth / kBlock * kRows, kHalf = kWidth / kBlock / 2;
    constexpr int kBlockHeight = kHeight / kRows;
    constexpr double kAlpha = 0.01;
    // A box: wider filters would see a little of the one half in the other.
    auto const file = io::read_scene_file(kFolder + "light_or_card.xml", {"integrator.filter=box"});
    auto const stage = lights::Stage::commit(file.jobs[0].scene, {"", {kWidth, kHeight}});
    std::vector<std::vector<double>> values(3 * kBlocks);
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        image::Image const picture = render_figure(*stage, file.jobs[0], 16, seed).image;
        std::vector<double> sums(3 * kBlocks);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (int c = 0; c < 3; ++c)
                    sums[size_t(3 * (y / kBlockHeight * 2 * kHalf + x / kBlock) + c)] +=
                        double(picture.at(x, y, c)) / (kBlockHeight * kBlock);
        for (size_t i = 0; i < sums.size(); ++i) values[i].push_back(sums[i]);
    }
    double const level = sidak(kAlpha, 3 * kBlocks / 2);
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kHalf; ++column)
            for (int c = 0; c < 3; ++c) {
                size_t const left = size_t(3 * (row * 2 * kHalf + column) + c);
                Estimate const light = estimate(values[left]),
                               card = estimate(values[left + 3 * kHalf]);
                EXPECT_GT(difference_p_value(light, card), level)
                    << "row " << row << ", column " << column << ", channel " << c << ": light "
                    << light.mean << " +- " << std::sqrt(light.variance) << ", card " << card.mean
                    << " +- " << std::sqrt(card.variance);
                EXPECT_GT(light.mean, 1e-3);
            }
}

} // namespace
} // namespace weft::session
