// What the diffuse and layer lobes promise beyond what holds for every lobe.
#include <cstdio>

#include <gtest/gtest.h>

#include "base/frame.h"
#include "base/warp.h"
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

TEST(BurleyDiffuse, WhiteReflectsAllAtAnyRoughness) {
    for (float roughness = 0; roughness <= 1; roughness += 0.1f)
        for (float const c : kCosines) {
            BurleyDiffuse const lobe{roughness};
            Vec3 const wo = at_angle(degrees(std::acos(c)));
            EXPECT_NEAR(hemisphere_integral(lobe, wo), 1, 2e-4) << roughness << " " << c;
            EXPECT_EQ(lobe.albedo(wo).g, 1) << roughness << " " << c;
        }
}

/// Seen from one direction it has the shape that was published.
TEST(BurleyDiffuse, IsAsPublishedButForItsAlbedo) {
    for (float const roughness : {0.f, 0.6f, 1.f}) {
        BurleyDiffuse const lobe{roughness};
        for (float const c : kCosines) {
            Vec3 const wo = at_angle(degrees(std::acos(c))), wi = at_angle(60);
            float const half = dot(wi, normalize(wo + wi));
            float const f90 = 0.5f + 2 * roughness * square(half);
            float const a = std::pow(1 - wo.z, 5.f), b = std::pow(1 - 0.5f, 5.f);
            float const published = 0.5f * kInvPi * (1 + (f90 - 1) * a) * (1 + (f90 - 1) * b);
            EXPECT_NEAR(lobe.eval(wo, wi).f.g, published / lobe.published_albedo(wo.z), 1e-5);
        }
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

/// A walk among microflakes whose normals lie around the layer's plane (Heitz et al. 2015): whether
/// light that comes along wo leaves the layer's top again.
bool returns(Vec3d const& wo, double cross_section, Rng& rng) {
    Vec3d back = wo; // the way the light came from
    double height = 1;
    for (;;) {
        double const sine2 = back.x * back.x + back.y * back.y;
        double const area = std::sqrt(sine2 + std::pow(cross_section * back.z, 2));
        height += std::log1p(-double(rng.next())) / area * back.z;
        if (height < 0) return false;
        if (height > 1) return true;
        // A visible normal of the ellipsoid: one of the unit sphere stretched to it.
        Vec3d const v = normalize(Vec3d(back.x, back.y, cross_section * back.z));
        Frame const around(Vec3(float(v.x), float(v.y), float(v.z)));
        Vec3 const n = around.to_world(square_to_cosine_hemisphere(rng.next2()));
        Vec3d const m = normalize(Vec3d(n.x, n.y, cross_section * double(n.z)));
        back = normalize(back - m * (2 * dot(back, m)));
    }
}

TEST(Sheen, TableIsTheLayerBetweenItsNodes) {
    Rng rng(5);
    double worst = 0;
    for (float const roughness : {0.015f, 0.03f, 0.06f, 0.11f, 0.23f, 0.52f, 0.83f, 1.f})
        for (float const c : {0.01f, 0.03f, 0.1f, 0.45f}) {
            constexpr int walks = 60000;
            int back = 0;
            Vec3d const wo(std::sqrt(1 - double(c) * double(c)), 0, double(c));
            for (int i = 0; i < walks; ++i) back += returns(wo, double(square(roughness)), rng);
            double const truth = double(back) / walks;
            double const sigma = std::sqrt(truth * (1 - truth) / walks);
            double const error = std::abs(double(sheen_albedo(roughness, c)) - truth);
            worst = std::max(worst, error - 3.5 * sigma); // 32 comparisons at 0.01
            EXPECT_LE(error, 2e-3 + 3.5 * sigma) << roughness << " " << c << ": " << truth;
        }
    std::printf("sheen table: worst error beyond noise %.4f\n", worst);
}

TEST(Clearcoat, TableIsWhatLeavesBetweenItsNodes) {
    for (float const alpha : {1e-3f, 0.0023f, 0.02f, 0.06f, 0.21f, 0.47f})
        for (float const c : {0.01f, 0.03f, 0.08f, 0.2f, 0.4f, 0.7f, 1.f})
            for (float const ior : {1.3f, 3.f}) {
                Clearcoat const lobe(alpha, ior);
                Vec3 const wo = at_angle(degrees(std::acos(c)), 0);
                constexpr int samples = 28657; // a Fibonacci lattice
                double sum = 0;
                for (int i = 0; i < samples; ++i) {
                    double const turn = 0.61803398874989484820 * i;
                    Vec3 const wi = lobe.sample(
                        wo, {float((i + 0.5) / samples), float(turn - std::floor(turn)), 0});
                    LobeValue const v = wi == Vec3(0) ? LobeValue{} : lobe.eval(wo, wi);
                    if (v.pdf > 0) sum += double(v.f.g / v.pdf) / samples;
                }
                EXPECT_NEAR(clearcoat_albedo(alpha, lobe.f0(), c), sum, 5e-4)
                    << alpha << " " << c << " " << ior;
            }
}

/// Normal incidence on a sharp coat: F G1(1)^2 times what of GTR1's long tail returns.
TEST(Clearcoat, SharpIsFresnel) {
    float const albedo = Clearcoat(1e-3f, 1.5f).albedo({0, 0, 1}).g;
    EXPECT_LT(albedo, 0.04f);
    EXPECT_GT(albedo, 0.035f);
}

} // namespace
