// How fast estimates converge, and how even the points are, against what theory says.
#include <gtest/gtest.h>

#include <vector>

#include "sampling/stream.h"
#include "tests/support/statistics.h"

namespace weft::sampling {
namespace {

constexpr double kSignificance = 0.01;
constexpr SamplerKind kKinds[] = {SamplerKind::Sobol, SamplerKind::Halton,
                                  SamplerKind::Independent};

double smooth(Vec2 u) { return 1 / (1 + double(u.x) + double(u.y)); }
double const kSmooth = 3 * std::log(3.0) - 4 * std::log(2.0);

double disk(Vec2 u) { return double(u.x) * u.x + double(u.y) * u.y < 1 ? 1 : 0; }
double const kDisk = M_PI / 4;

constexpr uint32_t kCounts[] = {16, 64, 256, 1024, 4096};
constexpr int kStreams = 400;

/// Errors of the estimate from the first kCounts[k] samples, for each stream and k.
template <class F>
std::vector<std::vector<double>> errors(SamplerKind kind, F&& f, double exact) {
    std::vector<std::vector<double>> e(std::size(kCounts), std::vector<double>(kStreams));
    for (int s = 0; s < kStreams; ++s) {
        double sum = 0;
        uint32_t i = 0;
        for (size_t k = 0; k < std::size(kCounts); ++k) {
            for (; i < kCounts[k]; ++i)
                sum += f(SampleStream(kind, {s, 3}, i, 21).get2(Dimension::Film));
            e[k][size_t(s)] = sum / i - exact;
        }
    }
    return e;
}

double rms(std::vector<double> const& e) {
    double sum = 0;
    for (double x : e) sum += x * x;
    return std::sqrt(sum / double(e.size()));
}

/// The exponent p of the least squares fit RMS ~ N^p.
double slope(std::vector<std::vector<double>> const& e) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    double const n = double(e.size());
    for (size_t k = 0; k < e.size(); ++k) {
        double const x = std::log(double(kCounts[k])), y = std::log(rms(e[k]));
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Owen 1997: N^-1.5 up to logarithms for smooth integrands and scrambled nets; N^-1 up to
/// logarithms for Halton points at counts that are not products of powers of its bases; N^-0.5
/// for independent ones.
TEST(Convergence, SmoothIntegrand) {
    double const sobol = slope(errors(SamplerKind::Sobol, smooth, kSmooth));
    double const halton = slope(errors(SamplerKind::Halton, smooth, kSmooth));
    double const independent = slope(errors(SamplerKind::Independent, smooth, kSmooth));
    RecordProperty("sobol", std::to_string(sobol));
    RecordProperty("halton", std::to_string(halton));
    RecordProperty("independent", std::to_string(independent));
    EXPECT_LT(sobol, -1.3);
    EXPECT_LT(halton, -0.9);
    EXPECT_NEAR(independent, -0.5, 0.1);
}

/// A curved edge crosses O(N^0.5) of the N cells of a net: N^-0.75.
TEST(Convergence, DiscontinuousIntegrand) {
    double const sobol = slope(errors(SamplerKind::Sobol, disk, kDisk));
    double const halton = slope(errors(SamplerKind::Halton, disk, kDisk));
    double const independent = slope(errors(SamplerKind::Independent, disk, kDisk));
    RecordProperty("sobol", std::to_string(sobol));
    RecordProperty("halton", std::to_string(halton));
    RecordProperty("independent", std::to_string(independent));
    EXPECT_LT(sobol, -0.65);
    EXPECT_LT(halton, -0.6);
    EXPECT_NEAR(independent, -0.5, 0.1);
}

/// Scrambling leaves every estimate unbiased, at any number of samples.
TEST(Convergence, EstimatesAreUnbiased) {
    double const level =
        testing::sidak(kSignificance, int(2 * std::size(kKinds) * std::size(kCounts)));
    for (SamplerKind kind : kKinds) {
        auto const a = errors(kind, smooth, kSmooth), b = errors(kind, disk, kDisk);
        for (auto const* e : {&a, &b})
            for (size_t k = 0; k < e->size(); ++k) {
                testing::Estimate const m = testing::estimate((*e)[k]);
                EXPECT_GT(testing::normal_tail(m.mean / std::sqrt(m.variance)), level)
                    << "sampler " << int(kind) << ", " << kCounts[k] << " samples, "
                    << (e == &a ? "smooth" : "disk");
            }
    }
}

/// The squared L2 star discrepancy in two dimensions (Warnock 1972).
double discrepancy2(std::vector<Vec2> const& p) {
    double const n = double(p.size());
    double single = 0, pairs = 0;
    for (Vec2 const& a : p) {
        single += (1 - double(a.x) * a.x) * (1 - double(a.y) * a.y);
        for (Vec2 const& b : p)
            pairs += (1 - double(std::max(a.x, b.x))) * (1 - double(std::max(a.y, b.y)));
    }
    return 1.0 / 9 - single / (2 * n) + pairs / (n * n);
}

/// Independent points have E[D^2] = (1/4 - 1/9) / n, checked here by a z-test. The scrambled
/// sets must beat them by the factors given, in the root mean square over streams.
TEST(Discrepancy, StratifiedStreamsAreMoreEven) {
    constexpr uint32_t kPoints = 256;
    constexpr int kSets = 100;
    constexpr Dimension kDimensions[] = {Dimension::Film, Dimension::Bsdf, Dimension::Phase};
    auto mean = [&](SamplerKind kind, Dimension d) {
        std::vector<double> values;
        for (int s = 0; s < kSets; ++s) {
            std::vector<Vec2> p;
            for (uint32_t i = 0; i < kPoints; ++i)
                p.push_back(SampleStream(kind, {s, 1}, i, 2).get2(d));
            values.push_back(discrepancy2(p));
        }
        return testing::estimate(values);
    };
    double const expected = (1.0 / 4 - 1.0 / 9) / kPoints;
    double const level = testing::sidak(kSignificance, std::size(kDimensions));
    for (Dimension d : kDimensions) {
        testing::Estimate const e = mean(SamplerKind::Independent, d);
        EXPECT_GT(testing::normal_tail((e.mean - expected) / std::sqrt(e.variance)), level);
        double const sobol = std::sqrt(expected / mean(SamplerKind::Sobol, d).mean);
        double const halton = std::sqrt(expected / mean(SamplerKind::Halton, d).mean);
        RecordProperty("sobol_" + std::to_string(int(d)), std::to_string(sobol));
        RecordProperty("halton_" + std::to_string(int(d)), std::to_string(halton));
        EXPECT_GT(sobol, 5) << int(d);
        EXPECT_GT(halton, d == Dimension::Film ? 4 : 1) << int(d);
    }
}

} // namespace
} // namespace weft::sampling
