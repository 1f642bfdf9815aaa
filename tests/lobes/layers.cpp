// What the diffuse and layer lobes promise beyond what holds for every lobe.
#include <gtest/gtest.h>

#include "tests/lobes/configurations.h"

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::testing;

namespace {

/// f integrated over the upper hemisphere by the midpoint rule in the cosine's root, which is
/// densest at the horizon, and in the azimuth.
template <class L>
double hemisphere_integral(L const& lobe, Vec3 const& wo) {
    constexpr int n = 256;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        float const t = (float(i) + 0.5f) / n, z = t * t, r = safe_sqrt(1 - z * z);
        for (int j = 0; j < n; ++j) {
            float const phi = 2 * kPi * (float(j) + 0.5f) / n;
            sum += 2 * t * lobe.eval(wo, {r * std::cos(phi), r * std::sin(phi), z}).f.g;
        }
    }
    return sum * 2 * kPi / (n * n);
}

constexpr float kCosines[] = {0.01f, 0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 0.9f, 0.999f};

TEST(OrenNayar, WhiteReflectsAll) {
    for (float const roughness : {0.f, 0.2f, 0.5f, 1.f})
        for (float const c : kCosines) {
            OrenNayar const lobe(Color(1), roughness);
            Vec3 const wo = at_angle(degrees(std::acos(c)));
            EXPECT_NEAR(hemisphere_integral(lobe, wo), 1, 1e-3) << roughness << " " << c;
            EXPECT_NEAR(lobe.albedo(wo).g, 1, 1e-6);
        }
}

TEST(OrenNayar, AlbedoOfColoursIsExact) {
    for (float const rho : {0.1f, 0.5f, 0.9f})
        for (float const c : kCosines) {
            OrenNayar const lobe(Color(rho), 0.8f);
            Vec3 const wo = at_angle(degrees(std::acos(c)));
            EXPECT_NEAR(hemisphere_integral(lobe, wo), lobe.albedo(wo).g, 1e-3) << rho << " " << c;
        }
}

TEST(OrenNayar, SmoothIsLambert) {
    OrenNayar const lobe(Color(0.3f), 0);
    for (float const angle : {0.f, 30.f, 85.f})
        EXPECT_NEAR(lobe.eval(at_angle(60), at_angle(angle)).f.g,
                    0.3f * Lambert{}.eval(at_angle(60), at_angle(angle)).f.g, 1e-6);
}

TEST(BurleyDiffuse, GivesNoMoreThanItReceives) {
    for (float roughness = 0; roughness <= 1; roughness += 0.1f)
        for (float const c : kCosines) {
            BurleyDiffuse const lobe{roughness};
            Vec3 const wo = at_angle(degrees(std::acos(c)));
            double const albedo = hemisphere_integral(lobe, wo);
            EXPECT_LE(albedo, 1 + 1e-4) << roughness << " " << c;
            EXPECT_NEAR(albedo, lobe.albedo(wo).g, 0.015) << roughness << " " << c;
        }
}

/// Where nothing gives too much, roughness 0, the model is as published.
TEST(BurleyDiffuse, IsAsPublishedWhereItMayBe) {
    BurleyDiffuse const lobe{0};
    for (float const c : kCosines) {
        Vec3 const wo = at_angle(degrees(std::acos(c)));
        EXPECT_NEAR(hemisphere_integral(lobe, wo), lobe.unlimited_albedo(wo.z), 1e-4) << c;
        float const a = std::pow(1 - wo.z, 5.f), b = std::pow(1 - 0.5f, 5.f);
        EXPECT_NEAR(lobe.eval(wo, at_angle(60)).f.g,
                    0.5f * kInvPi * (1 - 0.5f * a) * (1 - 0.5f * b), 1e-5);
    }
}

/// The layer of fibres that Zeltner et al. 2022 publish: reflectances by the rational fit to their
/// table in MaterialX 1.39, which is good to 0.005 there.
TEST(Sheen, ReflectsWhatTheLayerDoes) {
    EXPECT_NEAR(sheen_albedo(1, 1), 0.34f, 0.01f);
    EXPECT_NEAR(sheen_albedo(1, 0.218f), 0.63f, 0.01f);
    EXPECT_NEAR(sheen_albedo(7 / 15.f, 0.071f), 0.58f, 0.01f);
    EXPECT_NEAR(sheen_albedo(7 / 15.f, 0.444f), 0.16f, 0.01f);
    EXPECT_NEAR(sheen_albedo(4 / 15.f, 0.218f), 0.17f, 0.01f);
    EXPECT_NEAR(sheen_albedo(0, 0.5f), 0, 1e-4f);
}

/// Normal incidence on a sharp coat: F G1(1)^2 times what of GTR1's long tail returns.
TEST(Clearcoat, SharpIsFresnel) {
    float const albedo = Clearcoat(1e-3f, 1.5f).albedo({0, 0, 1}).g;
    EXPECT_LT(albedo, 0.04f);
    EXPECT_GT(albedo, 0.035f);
}

} // namespace
