#include "film/filter.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "base/hash.h"
#include "tests/support/statistics.h"

namespace weft::film {
namespace {

constexpr double kSignificance = 0.01;

struct Case {
    char const* name;
    Filter filter;
    double radius;
    std::function<double(double)> profile; ///< the filter as the textbooks have it, any scale
};

std::vector<Case> cases() {
    auto gaussian = [](double s) {
        return [s](double x) { return std::exp(-x * x / (2 * s * s)); };
    };
    auto harris = [](double r) {
        return [r](double x) {
            double const v = 2 * M_PI * (x / (2 * r) + 0.5);
            return 0.35875 - 0.48829 * std::cos(v) + 0.14128 * std::cos(2 * v) -
                   0.01168 * std::cos(3 * v);
        };
    };
    auto tent = [](double r) { return [r](double x) { return 1 - std::abs(x) / r; }; };
    return {
        {"box", BoxFilter{}, 0.5, [](double) { return 1.0; }},
        {"box of radius 2", BoxFilter{2}, 2, [](double) { return 1.0; }},
        {"tent", TentFilter{}, 1, tent(1)},
        {"tent of radius 1.7", TentFilter{1.7f}, 1.7f, tent(1.7f)},
        {"gaussian", GaussianFilter{}, 1.5, gaussian(0.5)},
        {"gaussian of 0.8", GaussianFilter{0.8f}, 3 * 0.8f, gaussian(0.8f)},
        {"Blackman-Harris", BlackmanHarrisFilter{}, 1.5, harris(1.5)},
        {"Blackman-Harris of radius 2.5", BlackmanHarrisFilter{2.5f}, 2.5, harris(2.5)},
    };
}

/// Integrals of the profile over `bins` equal parts of [-radius, radius], normalised (midpoint
/// rule, 256 points a bin).
std::vector<double> bin_masses(Case const& c, int bins) {
    constexpr int kPoints = 256;
    std::vector<double> mass(static_cast<size_t>(bins));
    double total = 0;
    for (int i = 0; i < bins * kPoints; ++i) {
        double const f = c.profile(c.radius * (2 * (i + 0.5) / (bins * kPoints) - 1));
        mass[size_t(i / kPoints)] += f;
        total += f;
    }
    for (double& m : mass) m /= total;
    return mass;
}

TEST(Filter, OffsetsFollowTheAnalyticProfile) {
    constexpr int kBins = 40, kSamples = 1 << 21;
    auto const all = cases();
    double const level = testing::sidak(kSignificance, int(all.size()));
    for (size_t k = 0; k < all.size(); ++k) {
        std::vector<double> const mass = bin_masses(all[k], kBins);
        std::vector<double> observed(kBins * kBins), expected(kBins * kBins);
        for (size_t i = 0; i < expected.size(); ++i)
            expected[i] = mass[i / kBins] * mass[i % kBins] * kSamples;
        Rng rng(1000 + k);
        auto bin = [&](float x) {
            return std::clamp(int((x / all[k].radius + 1) / 2 * kBins), 0, kBins - 1);
        };
        for (int i = 0; i < kSamples; ++i) {
            Vec2 const p = sample_filter(all[k].filter, rng.next2());
            ASSERT_LE(std::abs(p.x), all[k].radius) << all[k].name;
            ASSERT_LE(std::abs(p.y), all[k].radius) << all[k].name;
            observed[size_t(bin(p.y) * kBins + bin(p.x))] += 1;
        }
        testing::ChiSquare const test = testing::chi_square(observed, expected);
        EXPECT_GT(test.p_value, level) << all[k].name << " chi2 " << test.statistic << " dof "
                                       << test.dof << " " << test.problem;
    }
}

/// Finer than any histogram: the analytic distribution function of each quantile is its u again.
TEST(Filter, QuantilesInvertTheAnalyticDistributionFunction) {
    constexpr int kBins = 4096;
    for (Case const& c : cases()) {
        std::vector<double> const mass = bin_masses(c, kBins);
        std::vector<double> cdf(kBins + 1);
        for (size_t i = 0; i < kBins; ++i) cdf[i + 1] = cdf[i] + mass[i];
        double worst = 0;
        for (int i = 0; i < 10000; ++i) {
            float const u = (float(i) + 0.5f) / 10000;
            double const k = (sample_filter(c.filter, {u, 0.5f}).x / c.radius + 1) / 2 * kBins;
            int const b = std::clamp(int(k), 0, kBins - 1);
            worst = std::max(worst, std::abs(cdf[size_t(b)] + mass[size_t(b)] * (k - b) - u));
        }
        EXPECT_LT(worst, 1e-5) << c.name;
    }
}

TEST(Filter, MeansAreZero) {
    constexpr int kSamples = 200000;
    auto const all = cases();
    double const level = testing::sidak(kSignificance, 2 * int(all.size()));
    for (Case const& c : all) {
        Rng rng(7);
        std::vector<double> x(kSamples), y(kSamples);
        for (size_t i = 0; i < kSamples; ++i) {
            Vec2 const p = sample_filter(c.filter, rng.next2());
            x[i] = p.x;
            y[i] = p.y;
        }
        for (auto const& values : {x, y}) {
            testing::Estimate const e = testing::estimate(values);
            EXPECT_GT(testing::normal_tail(e.mean / std::sqrt(e.variance)), level) << c.name;
        }
    }
}

TEST(Filter, QuantilesAreSymmetricAndMonotone) {
    for (Case const& c : cases()) {
        EXPECT_EQ(sample_filter(c.filter, Vec2(0.5f)), Vec2(0)) << c.name;
        float previous = -float(c.radius) * 1.0001f;
        for (int i = 0; i < 1 << 16; ++i) {
            float const u = float(i) / (1 << 16);
            Vec2 const p = sample_filter(c.filter, {u, 1 - u == 1 ? kOneMinusEpsilon : 1 - u});
            // u = 0 has no partner below 1.
            ASSERT_TRUE(i == 0 || p.x == -p.y) << c.name << " at " << u;
            ASSERT_GT(p.x, previous) << c.name << " at " << u;
            previous = p.x;
        }
        float const first = sample_filter(c.filter, Vec2(0)).x;
        float const last = sample_filter(c.filter, Vec2(kOneMinusEpsilon)).x;
        EXPECT_NEAR(first, -c.radius, 1e-6 * c.radius) << c.name;
        EXPECT_LE(last, c.radius) << c.name;
    }
}

TEST(Filter, DensityIsTheNormalisedProfile) {
    constexpr int kSteps = 2000;
    for (Case const& c : cases()) {
        double integral = 0, profile = 0, peak = 0;
        for (int i = 0; i < kSteps; ++i) {
            double const x = c.radius * (2 * (i + 0.5) / kSteps - 1);
            double const y = 0.1 * c.radius;
            integral += filter_density(c.filter, {float(x), float(y)});
            profile += c.profile(x);
            peak = std::max(peak, c.profile(x));
        }
        double const h = 2 * c.radius / kSteps;
        double const fy = c.profile(0.1 * c.radius) / (profile * h);
        EXPECT_NEAR(integral * h, fy, 2e-4 * fy) << c.name;
        for (int i = 0; i < kSteps; ++i) {
            double const x = c.radius * (2 * (i + 0.5) / kSteps - 1);
            double const fx = c.profile(x) / (profile * h);
            double const scale = peak / (profile * h);
            EXPECT_NEAR(filter_density(c.filter, {float(x), float(0.1 * c.radius)}), fx * fy,
                        1e-4 * scale * fy)
                << c.name << " at " << x;
        }
        EXPECT_EQ(filter_density(c.filter, {float(c.radius) * 1.01f, 0}), 0) << c.name;
        EXPECT_EQ(filter_density(c.filter, {0, float(c.radius) * -1.01f}), 0) << c.name;
    }
}

} // namespace
} // namespace weft::film
