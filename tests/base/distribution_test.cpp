#include "base/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "base/hash.h"
#include "tests/support/statistics.h"

namespace weft {
namespace {

constexpr double kSignificance = 0.01;

using Weights = std::vector<float>;

/// Zeros at the ends, in the middle, alone; weights of very different size; odd lengths.
std::vector<Weights> weight_lists() {
    std::vector<Weights> lists = {
        {1},
        {0, 0, 3, 0, 1, 0, 0, 5, 0},
        {0, 1},
        {1, 0},
        {2, 2, 2},
        {1e-6f, 1, 1e6f, 0, 100},
        {1e-30f, 3e-30f, 0, 2e-30f},
    };
    Rng rng(5);
    Weights many(999);
    for (float& w : many) w = rng.next() < 0.3f ? 0 : square(rng.next());
    many.front() = many.back() = 0;
    lists.push_back(many);
    return lists;
}

double sum(Weights const& w) { return std::accumulate(w.begin(), w.end(), 0.0); }

/// Random numbers, and the ones next to every step of the distribution function.
std::vector<float> numbers(Weights const& w) {
    std::vector<float> u = {0, 0x1p-24f, 0.5f, kOneMinusEpsilon};
    double running = 0;
    for (float x : w) {
        float const step = float((running += x) / sum(w));
        for (float v : {std::nextafter(step, 0.f), step, std::nextafter(step, 1.f)})
            u.push_back(std::min(v, kOneMinusEpsilon));
    }
    Rng rng(6);
    for (int i = 0; i < 20000; ++i) u.push_back(rng.next());
    return u;
}

TEST(Distribution1D, BinsAreChosenByWeight) {
    constexpr int kSamples = 400000;
    auto const lists = weight_lists();
    double const level = testing::sidak(kSignificance, int(lists.size()));
    for (size_t k = 0; k < lists.size(); ++k) {
        Weights const& w = lists[k];
        Distribution1D const d(w);
        ASSERT_EQ(d.size(), w.size());
        EXPECT_NEAR(d.total(), sum(w), 1e-6 * sum(w));
        std::vector<double> observed(w.size()), expected(w.size());
        for (size_t i = 0; i < w.size(); ++i) expected[i] = kSamples * w[i] / sum(w);
        Rng rng(k);
        for (int i = 0; i < kSamples; ++i) observed[d.choose(rng.next()).index] += 1;
        testing::ChiSquare const test = testing::chi_square(observed, expected);
        EXPECT_GT(test.p_value, level) << "list " << k << " " << test.problem;
    }
}

TEST(Distribution1D, BinsOfWeightZeroAreNeverChosen) {
    for (Weights const& w : weight_lists()) {
        Distribution1D const d(w);
        for (size_t i = 0; i < w.size(); ++i)
            EXPECT_TRUE(w[i] > 0 || d.probability(uint32_t(i)) == 0);
        for (float u : numbers(w)) {
            ASSERT_GT(w[d.choose(u).index], 0) << u;
            ASSERT_GT(w[d.sample(u).bin], 0) << u;
        }
    }
}

TEST(Distribution1D, SamplesCarryTheirBinAndDensity) {
    for (Weights const& w : weight_lists()) {
        Distribution1D const d(w);
        float const n = float(w.size());
        for (float u : numbers(w)) {
            Distribution1D::Sample const s = d.sample(u);
            ASSERT_TRUE(s.x >= 0 && s.x <= kOneMinusEpsilon);
            ASSERT_EQ(s.bin, uint32_t(s.x * n)) << "u " << u << " n " << n;
            ASSERT_EQ(s.pdf, d.probability(s.bin) * n);
            // Sums of probabilities carry the rounding of floats below 1.
            ASSERT_NEAR(s.pdf, w[s.bin] / sum(w) * n, n * 1.2e-7);
        }
    }
}

TEST(Distribution1D, PositionRisesWithTheRandomNumber) {
    for (Weights const& w : weight_lists()) {
        Distribution1D const d(w);
        float previous = 0;
        for (int i = 0; i < 1 << 16; ++i) {
            float const x = d.sample(float(i) / (1 << 16)).x;
            ASSERT_GE(x, previous);
            previous = x;
        }
    }
}

/// What is left of the random number after a choice is uniform again, whatever was chosen.
TEST(Distribution1D, TheRestOfTheRandomNumberIsUniform) {
    constexpr int kSamples = 200000, kBins = 20;
    Weights const w = {0, 3, 1, 0, 4};
    Distribution1D const d(w);
    std::vector<double> observed(w.size() * kBins), expected(w.size() * kBins);
    for (size_t i = 0; i < expected.size(); ++i)
        expected[i] = kSamples * w[i / kBins] / (sum(w) * kBins);
    Rng rng(9);
    for (int i = 0; i < kSamples; ++i) {
        Distribution1D::Choice const c = d.choose(rng.next());
        ASSERT_TRUE(c.u >= 0 && c.u <= kOneMinusEpsilon);
        ASSERT_EQ(c.probability, d.probability(c.index));
        observed[c.index * kBins + size_t(c.u * kBins)] += 1;
    }
    EXPECT_GT(testing::chi_square(observed, expected).p_value, kSignificance);
}

TEST(Distribution1D, AllZeroWeightsAreUniform) {
    Distribution1D const d(Weights(7, 0.f));
    EXPECT_EQ(d.total(), 0);
    for (uint32_t i = 0; i < 7; ++i) EXPECT_NEAR(d.probability(i), 1.0 / 7, 1e-7);
    for (int i = 0; i < 1000; ++i) {
        float const u = float(i) / 1000;
        EXPECT_NEAR(d.sample(u).x, u, 1e-6);
        EXPECT_NEAR(d.sample(u).pdf, 1, 1e-6);
    }
}

TEST(Distribution1D, AMillionSmallWeightsKeepTheirTotal) {
    Distribution1D const d(Weights(1000000, 1e-7f));
    EXPECT_NEAR(d.total(), 0.1, 1e-7);
    EXPECT_EQ(d.choose(0).index, 0u);
    EXPECT_NEAR(d.choose(0.5f).index, 500000, 1);
    EXPECT_NEAR(d.choose(kOneMinusEpsilon).index, 999999, 1);
}

struct Grid {
    uint32_t width, height;
    Weights weights;
};

std::vector<Grid> grids() {
    Grid odd{49, 33, {}}, wide{2048, 3, {}}, holes{7, 5, Weights(35, 0.f)};
    Rng rng(3);
    for (uint32_t i = 0; i < 49 * 33; ++i)
        odd.weights.push_back(i / 49 % 4 == 1 || rng.next() < 0.2f ? 0 : rng.next());
    for (uint32_t i = 0; i < 2048 * 3; ++i) wide.weights.push_back(float(i % 2));
    holes.weights[10] = 1;
    holes.weights[24] = 3;
    return {odd, wide, holes};
}

TEST(Distribution2D, CellsAreChosenByWeight) {
    constexpr int kSamples = 1 << 20;
    auto const all = grids();
    double const level = testing::sidak(kSignificance, int(all.size()));
    for (size_t k = 0; k < all.size(); ++k) {
        Grid const& g = all[k];
        Distribution2D const d(g.weights, g.width, g.height);
        EXPECT_NEAR(d.total(), sum(g.weights), 1e-6 * sum(g.weights));
        std::vector<double> observed(g.weights.size()), expected(g.weights.size());
        for (size_t i = 0; i < expected.size(); ++i)
            expected[i] = kSamples * g.weights[i] / sum(g.weights);
        Rng rng(100 + k);
        for (int i = 0; i < kSamples; ++i) {
            Vec2 const p = d.sample(rng.next2()).p;
            ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x < 1 && p.y < 1);
            observed[size_t(p.y * float(g.height)) * g.width + size_t(p.x * float(g.width))] += 1;
        }
        testing::ChiSquare const test = testing::chi_square(observed, expected);
        EXPECT_GT(test.p_value, level) << "grid " << k << " " << test.problem;
    }
}

TEST(Distribution2D, PdfIsThatOfTheSampleAndNeverZeroThere) {
    for (Grid const& g : grids()) {
        Distribution2D const d(g.weights, g.width, g.height);
        Rng rng(8);
        for (int i = 0; i < 1 << 20; ++i) {
            auto const s = d.sample(rng.next2());
            ASSERT_GT(s.pdf, 0);
            ASSERT_NEAR(d.pdf(s.p), s.pdf, 1e-6f * s.pdf) << s.p;
        }
    }
}

TEST(Distribution2D, PdfIsProportionalToTheWeightsAndIntegratesToOne) {
    for (Grid const& g : grids()) {
        Distribution2D const d(g.weights, g.width, g.height);
        double const cells = double(g.weights.size());
        double integral = 0;
        for (uint32_t i = 0; i < g.weights.size(); ++i) {
            Vec2 const p((float(i % g.width) + 0.5f) / float(g.width),
                         (float(i / g.width) + 0.5f) / float(g.height));
            integral += d.pdf(p) / cells;
            EXPECT_NEAR(d.pdf(p), g.weights[i] / sum(g.weights) * cells, 4e-4);
        }
        EXPECT_NEAR(integral, 1, 1e-5);
    }
}

TEST(Distribution2D, AllZeroWeightsAreUniform) {
    Distribution2D const d(Weights(12, 0.f), 4, 3);
    for (Vec2 u : {Vec2(0), Vec2(0.3f, 0.9f), Vec2(kOneMinusEpsilon)}) {
        EXPECT_NEAR(d.sample(u).pdf, 1, 1e-6);
        EXPECT_NEAR(d.sample(u).p.x, u.x, 1e-6);
        EXPECT_NEAR(d.sample(u).p.y, u.y, 1e-6);
        EXPECT_NEAR(d.pdf(u), 1, 1e-6);
    }
}

} // namespace
} // namespace weft
