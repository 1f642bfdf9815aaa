// Phase functions and free flight, against what they promise.
#include <gtest/gtest.h>

#include <vector>

#include "base/hash.h"
#include "media/medium.h"
#include "media/phase.h"
#include "tests/support/statistics.h"

namespace weft::media {
namespace {

using weft::testing::sidak;

std::vector<float> const kAsymmetries{-0.9f, -0.5f, -0.05f, -9e-4f, 0,
                                      9e-4f, 0.05f, 0.3f,   0.7f,   0.9f};

double phase(double c, double g) { return henyey_greenstein(float(c), float(g)); }

/// The integral of phase(cos(wo, wi)) cos^power over the sphere, by Simpson's rule in cos.
double moment(double g, int power) {
    int const n = 20000;
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
        double const c = -1 + 2.0 * i / n, w = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
        sum += w * phase(c, g) * std::pow(c, power);
    }
    return 2 * M_PI * sum * (2.0 / n) / 3;
}

TEST(HenyeyGreenstein, IntegratesToOne) {
    for (float g : kAsymmetries) EXPECT_NEAR(moment(g, 0), 1, 2e-6) << "g = " << g;
}

TEST(HenyeyGreenstein, ForwardMeansAlongTheRay) {
    // Both directions leave the point: the cosine of deflection is -wo.wi, and its mean is g.
    for (float g : kAsymmetries) EXPECT_NEAR(-moment(g, 1), double(g), 2e-6) << "g = " << g;
}

TEST(HenyeyGreenstein, SamplesFollowTheDensity) {
    constexpr int bins = 40, turns = 8, samples = 400000;
    double const level = sidak(0.01, int(kAsymmetries.size()));
    Vec3 const wo = normalize(Vec3(0.3f, -0.8f, 0.5f));
    Frame const frame(wo);
    Rng rng(1);
    for (float g : kAsymmetries) {
        std::vector<double> observed(bins * turns), expected(bins * turns);
        for (int i = 0; i < samples; ++i) {
            Vec3 const wi = sample_henyey_greenstein(wo, g, rng.next2());
            ASSERT_NEAR(length(wi), 1, 1e-5);
            Vec3 const local = frame.to_local(wi);
            double const phi = std::atan2(local.y, local.x) / (2 * M_PI) + 0.5;
            int const row = std::clamp(int((local.z + 1) / 2 * bins), 0, bins - 1);
            ++observed[size_t(row * turns + std::min(int(phi * turns), turns - 1))];
        }
        for (int row = 0; row < bins; ++row) {
            int const n = 200; // Simpson's rule inside the bin
            double sum = 0;
            for (int i = 0; i <= n; ++i)
                sum += (i == 0 || i == n ? 1
                        : i % 2          ? 4
                                         : 2) *
                       phase(-1 + 2 * (row + double(i) / n) / bins, g);
            double const mass = 2 * M_PI * sum * (2.0 / bins / n) / 3;
            for (int t = 0; t < turns; ++t)
                expected[size_t(row * turns + t)] = samples * mass / turns;
        }
        auto const test = weft::testing::chi_square(observed, expected);
        EXPECT_GT(test.p_value, level)
            << "g = " << g << ": " << test.statistic << " of " << test.dof << " " << test.problem;
    }
}

TEST(HenyeyGreenstein, SampleCosineInvertsTheDistribution) {
    // The closed form of the cumulative distribution at the sampled cosine gives the random number
    // back, also where g is so small that a chi-square test would see nothing.
    for (double g : {-0.9, -0.3, -0.001, -0.0005, 0.0005, 0.001, 0.002, 0.3, 0.9})
        for (int i = 1; i < 64; ++i) {
            float const u = float(i) / 64;
            Vec3 const wi = sample_henyey_greenstein({0, 0, 1}, float(g), {u, 0.3f});
            double const c = -double(wi.z), gf = double(float(g));
            double const below =
                (1 - gf * gf) / (2 * gf) * (1 / std::sqrt(1 + gf * gf - 2 * gf * c) - 1 / (1 + gf));
            // The direction's cosine has float digits: a few half ulps times the density in it.
            EXPECT_NEAR(below, double(u), 3e-7 * (1 + 2 * M_PI * phase(-c, gf))) << "g = " << g;
        }
}

struct FlightCase {
    Medium medium;
    Color throughput;
    float limit;
};

std::vector<FlightCase> flight_cases() {
    return {
        {{Color(0.5f), Color(0.7f)}, Color(1), 1.5f},
        {{Color(3, 0.5f, 0.1f), Color(0)}, Color(1), 0.8f},
        {{Color(0), Color(4, 1, 0.2f)}, Color(1), 2},
        {{Color(0.1f, 0, 0), Color(2, 0, 1)}, Color(1), 1}, // green passes freely
        {{Color(0), Color(1, 2, 3)}, Color(0.1f, 0.9f, 0.02f), 0.7f},
        {{Color(0), Color(1, 2, 3)}, Color(0, 1, 0), 0.7f}, // only green left
        {{Color(0.2f, 0.1f, 0), Color(5, 0.5f, 0)}, Color(0.3f, 0, 1), 3},
        {{Color(0.5f), Color(1, 0.1f, 3)}, Color(1), kInfinity},
    };
}

TEST(Flight, PassesWithTheTransmittance) {
    // E[weight of passing] is the transmittance, and E[weight of scattering] is the integral of
    // scattering times transmittance, for each channel that the path still carries.
    constexpr int samples = 200000;
    auto const cases = flight_cases();
    double const level = sidak(0.01, int(cases.size()) * 6);
    Rng rng(2);
    for (size_t k = 0; k < cases.size(); ++k) {
        auto const& [medium, throughput, limit] = cases[k];
        std::vector<double> passed[3], scattered[3];
        for (int i = 0; i < samples; ++i) {
            MediumSample const s = sample_distance(medium, throughput, limit, rng.next2());
            ASSERT_GE(s.distance, 0);
            ASSERT_LE(s.distance, limit);
            for (int c = 0; c < 3; ++c) {
                passed[c].push_back(s.scattered ? 0 : double(s.weight[c]));
                scattered[c].push_back(s.scattered ? double(s.weight[c]) : 0);
            }
        }
        for (int c = 0; c < 3; ++c) {
            if (throughput[c] == 0) continue;
            double const sigma = medium.extinction()[c];
            double const tr = sigma == 0 ? 1 : std::exp(-sigma * double(limit));
            double const albedo = sigma == 0 ? 0 : medium.scattering[c] / sigma;
            auto check = [&](std::vector<double> const& values, double truth, char const* what) {
                auto const e = weft::testing::estimate(values);
                if (e.variance < 1e-18)
                    EXPECT_NEAR(e.mean, truth, 1e-5) << what << ", case " << k << ", channel " << c;
                else
                    EXPECT_GT(weft::testing::normal_tail((e.mean - truth) / std::sqrt(e.variance)),
                              level)
                        << what << ", case " << k << ", channel " << c << ": " << e.mean
                        << " instead of " << truth;
            };
            check(passed[c], tr, "passing");
            check(scattered[c], albedo * (1 - tr), "scattering");
        }
    }
}

TEST(Flight, WeightsAreBounded) {
    // The carried colour never grows in sum: throughput . weight <= throughput's sum.
    Rng rng(3);
    for (auto const& [medium, throughput, limit] : flight_cases())
        for (int i = 0; i < 20000; ++i) {
            MediumSample const s = sample_distance(medium, throughput, limit, rng.next2());
            Color const c = throughput * s.weight;
            ASSERT_LE(c.r + c.g + c.b, (throughput.r + throughput.g + throughput.b) * 1.0001f);
        }
}

TEST(Transmittance, KnowsInfinityAndZero) {
    Medium const medium{Color(1, 0, 2), Color(0)};
    Color const far = transmittance(medium, kInfinity);
    EXPECT_EQ(far, Color(0, 1, 0));
    EXPECT_EQ(transmittance(medium, 0), Color(1));
    EXPECT_FLOAT_EQ(transmittance(medium, 0.5f).r, std::exp(-0.5f));
}

} // namespace
} // namespace weft::media
