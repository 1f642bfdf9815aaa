// For every configuration of every smooth lobe: samples follow the density, the density
// integrates to what sampling achieves, and value, density and albedo agree.
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/lobes/configurations.h"
#include "tests/lobes/quadrature.h"
#include "tests/lobes/sphere_chi_square.h"

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::testing;

namespace {

constexpr double kAlpha = 0.01; // over each test
constexpr float kAngles[] = {0.5f, 45, 80, 89};

/// In parts that may run beside each other; the significance is over all of them.
class SmoothLobeParts : public ::testing::TestWithParam<int> {};
constexpr int kParts = 4;
INSTANTIATE_TEST_SUITE_P(Of4, SmoothLobeParts, ::testing::Range(0, kParts));

TEST_P(SmoothLobeParts, SamplesFollowTheDensity) {
    constexpr int samples = 1 << 17;
    struct Outcome {
        std::string name;
        SphereTest test;
    };
    std::vector<Outcome> outcomes;
    int count = 0;
    for_each_configuration<true>([&](auto const& c) {
        for (float const angle : kAngles) {
            if (count++ % kParts != GetParam()) continue;
            Vec3 const wo = at_angle(angle);
            auto lobe = c.lobe;
            look_up(lobe, wo);
            SphereChiSquare test([&](Vec3 const& u) { return lobe.sample(wo, u); },
                                 [&](Vec3 const& wi) { return lobe.eval(wo, wi).pdf; });
            outcomes.push_back(
                {c.name + " at " + std::to_string(angle), test.run(uint64_t(count), samples)});
        }
    });
    double const level = weft::testing::sidak(kAlpha, count);
    double worst_integral = 0;
    for (auto const& [name, test] : outcomes) {
        EXPECT_GE(test.chi_square.p_value, level)
            << name << ": chi-square " << test.chi_square.statistic << " of " << test.chi_square.dof
            << " " << test.chi_square.problem;
        // Two-sided binomial test at the same level, plus the quadrature's error.
        double const sigma = std::sqrt(test.success * (1 - test.success) / samples);
        double const difference = std::abs(test.integral - test.success);
        double const beyond = std::max(difference - 1e-3, 0.0);
        EXPECT_TRUE(beyond == 0 || weft::testing::normal_tail(beyond / sigma) >= level)
            << name << ": the density integrates to " << test.integral << ", " << test.success
            << " of the samples succeed";
        if (test.success == 1) worst_integral = std::max(worst_integral, difference);
    }
    std::printf("%d chi-square tests; worst |integral - 1| without failures: %.2g\n",
                int(outcomes.size()), worst_integral);
}

/// The mean of f eta_scale / pdf over samples, per channel, with its variance.
template <class L>
std::array<weft::testing::Estimate, 3> monte_carlo_albedo(L lobe, Vec3 const& wo, int samples,
                                                          uint64_t seed) {
    look_up(lobe, wo);
    Rng rng(seed);
    std::array<std::vector<double>, 3> values;
    for (int i = 0; i < samples; ++i) {
        Vec3 const wi = lobe.sample(wo, rng.next3());
        LobeValue const v = wi == Vec3(0) ? LobeValue{} : lobe.eval(wo, wi);
        float const scale = v.pdf > 0 ? eta_scale_towards(lobe, wi) / v.pdf : 0.f;
        for (int k = 0; k < 3; ++k) values[size_t(k)].push_back(v.f[k] * scale);
    }
    return {weft::testing::estimate(values[0]), weft::testing::estimate(values[1]),
            weft::testing::estimate(values[2])};
}

TEST(SmoothLobes, GiveNoMoreThanTheyReceive) {
    struct Case {
        std::string name;
        weft::testing::Estimate albedo;
        double gain;
    };
    std::vector<Case> cases;
    for_each_configuration<true>([&](auto const& c) {
        for (float const angle : {0.f, 30.f, 60.f, 80.f, 89.f, 89.99f}) {
            auto const mc = monte_carlo_albedo(c.lobe, at_angle(angle), 1 << 12, cases.size());
            for (auto const& e : mc)
                cases.push_back({c.name + " at " + std::to_string(angle), e, c.gain});
        }
    });
    double const level = weft::testing::sidak(kAlpha, int(cases.size()));
    for (auto const& [name, e, gain] : cases) {
        double const beyond = e.mean - 1 - gain;
        EXPECT_TRUE(beyond <= 0 ||
                    weft::testing::normal_tail(beyond / std::sqrt(e.variance)) / 2 >= level)
            << name << ": " << e.mean << " +- " << std::sqrt(e.variance);
    }
}

struct AlbedoError {
    double sum = 0, worst = 0;
    int count = 0;
    void add(Color const& a, Color const& b) {
        for (int k = 0; k < 3; ++k) {
            double const e = std::abs(a[k] - b[k]);
            sum += e;
            worst = std::max(worst, e);
            ++count;
        }
    }
    double mean() const { return count ? sum / count : 0; }
};

/// Every alternative, at its configurations: mean error over angles.
TEST(SmoothLobes, AlbedoIsWhatLeaves) {
    for_each_type<LobeVariant>([&]<class L>() {
        if constexpr (SmoothLobe<L>) {
            AlbedoError isotropic, anisotropic;
            std::string name;
            for (Configuration<L> const& c : test_configurations<L>()) {
                name = c.name.substr(0, c.name.find(' '));
                for (float cos_o = 0.025f; cos_o < 1; cos_o += 0.05f) {
                    for (float const azimuth : {0.f, 0.7f, 1.5f}) {
                        Vec3 const wo = at_angle(degrees(std::acos(cos_o)), azimuth);
                        Color const truth = quadrature_albedo(c.lobe, wo, 1 << 11);
                        (c.isotropic ? isotropic : anisotropic).add(c.lobe.albedo(wo), truth);
                    }
                }
            }
            std::printf("%-20s albedo error: isotropic mean %.4f worst %.3f, anisotropic mean %.4f "
                        "worst %.3f\n",
                        name.c_str(), isotropic.mean(), isotropic.worst, anisotropic.mean(),
                        anisotropic.worst);
            EXPECT_LE(isotropic.mean(), 0.01) << name;
            EXPECT_LE(anisotropic.mean(), 0.05) << name;
        }
    });
}

/// The tables over all of their domain that materials use, not at favourite places.
template <class Distribution>
void check_tables(char const* name, Shadowing shadowing) {
    Rng rng(17);
    AlbedoError reflection, dielectric;
    for (int i = 0; i < 400; ++i) {
        float const alpha = std::max(square(square(rng.next())), 1e-3f);
        float const eta = std::exp(rng.next() * 2 - 1); // 0.37 ... 2.72
        float const u = rng.next(), cos_o = i % 2 ? std::max(u, 0.01f) : std::pow(0.01f, u);
        Vec3 const wo = at_angle(degrees(std::acos(cos_o)));
        Distribution const facets{alpha, alpha, shadowing};
        FacetAlbedo const truth = facet_albedo(facets, wo, eta);
        DielectricAlbedo const d = dielectric_albedo(facets, wo, eta);
        reflection.add(Color(white_albedo(facets, wo)), Color(float(truth.white)));
        dielectric.add({d.reflected, d.transmitted, d.reflected + d.transmitted},
                       {float(truth.reflected), float(truth.transmitted),
                        float(truth.reflected + truth.transmitted)});
    }
    std::printf("%s tables: reflection mean %.1e worst %.1e, dielectric mean %.1e worst %.1e\n",
                name, reflection.mean(), reflection.worst, dielectric.mean(), dielectric.worst);
    // What the tables promise, and what the sum over facets leaves. The area of Ashikhmin and
    // Shirley's distribution is itself interpolated and bends at its nodes.
    constexpr bool bends = std::is_same_v<Distribution, AshikhminShirley>;
    EXPECT_LE(reflection.mean(), bends ? 3e-4 : 1e-4);
    EXPECT_LE(reflection.worst, bends ? 7e-3 : 5e-4);
    EXPECT_LE(dielectric.mean(), 2e-4);
    EXPECT_LE(dielectric.worst, bends ? 4e-3 : 2e-3);
}

TEST(SmoothLobes, AlbedoTablesAreAccurateBetweenNodes) {
    for (auto const shadowing : {Shadowing::Separable, Shadowing::Correlated}) {
        check_tables<Ggx>("Ggx", shadowing);
        check_tables<Beckmann>("Beckmann", shadowing);
        check_tables<AshikhminShirley>("AshikhminShirley", shadowing);
    }
}

} // namespace
