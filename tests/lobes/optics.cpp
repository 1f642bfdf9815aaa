// The functions that lobes are made of, against closed forms and quadrature.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "lobes/fresnel.h"
#include "lobes/microfacet.h"
#include "tests/lobes/configurations.h"

using namespace weft;
using namespace weft::lobes;

namespace {

TEST(Fresnel, Dielectric) {
    EXPECT_NEAR(fresnel_dielectric(1, 1.5f), 0.04f, 1e-6);
    EXPECT_NEAR(fresnel_f0(1.5f), 0.04f, 1e-6);
    EXPECT_FLOAT_EQ(fresnel_dielectric(0, 1.5f), 1);
    EXPECT_EQ(fresnel_dielectric(0.5f, 1), 0);
    // At Brewster's angle only the perpendicular half is left: ((n^2 - 1) / (n^2 + 1))^2 / 2.
    float const n2 = 1.5f * 1.5f;
    EXPECT_NEAR(fresnel_dielectric(1 / std::sqrt(1 + n2), 1.5f), square((n2 - 1) / (n2 + 1)) / 2,
                1e-6);
    // Total reflection begins at sin = 1 / 1.5.
    float const critical = std::sqrt(1 - 1 / n2);
    EXPECT_EQ(fresnel_dielectric(critical - 1e-4f, 1 / 1.5f), 1);
    EXPECT_LT(fresnel_dielectric(critical + 1e-4f, 1 / 1.5f), 1);
    // The same both ways along one ray.
    for (float c = 0.05f; c < 1; c += 0.1f) {
        float cos_t;
        float const there = fresnel_dielectric(c, 1.7f, cos_t);
        EXPECT_NEAR(there, fresnel_dielectric(cos_t, 1 / 1.7f), 1e-5);
    }
}

TEST(Fresnel, Conductor) {
    // Normal incidence: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
    float const n = 0.2f, k = 3.9f; // silver, about
    EXPECT_NEAR(fresnel_conductor(1, n, k), (square(n - 1) + k * k) / (square(n + 1) + k * k),
                1e-6);
    EXPECT_NEAR(fresnel_conductor(0, n, k), 1, 1e-6);
    for (float c = 0.01f; c < 1; c += 0.05f)
        EXPECT_NEAR(fresnel_conductor(c, 1.5f, 0), fresnel_dielectric(c, 1.5f), 2e-6) << c;
    Color const gold =
        fresnel_conductor(0.7f, Color(0.14f, 0.37f, 1.44f), Color(3.98f, 2.38f, 1.6f));
    EXPECT_FLOAT_EQ(gold.g, fresnel_conductor(0.7f, 0.37f, 2.38f));
}

TEST(Fresnel, Schlick) {
    Color const f0(0.04f, 0.5f, 1);
    EXPECT_EQ(fresnel_schlick(1, f0), f0);
    EXPECT_EQ(fresnel_schlick(0, f0), Color(1));
    EXPECT_NEAR(fresnel_schlick(0.5f, f0).r, 0.04 + 0.96 / 32, 1e-6);
}

TEST(Microfacet, InverseErrorFunction) {
    for (float x = -3; x <= 3; x += 0.01f) {
        float const e = std::erf(x);
        EXPECT_NEAR(std::erf(erf_inverse(e)), e, 1e-6) << x;
    }
    EXPECT_TRUE(std::isfinite(erf_inverse(1)));
    EXPECT_TRUE(std::isfinite(erf_inverse(-1)));
}

TEST(Microfacet, ScaledBeta) {
    Rng rng(3);
    for (int i = 0; i < 20000; ++i) {
        float const a = std::pow(10.f, 10 * rng.next() - 6),
                    b = std::pow(10.f, 10 * rng.next() - 6);
        double const truth =
            std::exp(std::lgamma(2.0 + a) + std::lgamma(1.0 + b) - std::lgamma(2.0 + a + b));
        EXPECT_NEAR(scaled_beta(a, b), truth, 1e-4 * truth + 1e-12) << a << " " << b;
    }
}

/// Integrates f(m) over the upper hemisphere, in slopes graded to the distribution's width.
template <class F>
double integrate_normals(Vec2 alpha, F&& f) {
    constexpr int n = 1200;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        // Slopes r = tan(v pi / 2) reach infinity smoothly.
        double const v = (i + 0.5) / n, r = std::tan(v * 3.14159265358979 / 2);
        double const dr = (1 + r * r) * 3.14159265358979 / 2 / n;
        for (int j = 0; j < n / 4; ++j) {
            double const phi = (j + 0.5) / (n / 4) * 2 * 3.14159265358979;
            double const x = r * std::cos(phi) * alpha.x, y = r * std::sin(phi) * alpha.y;
            double const z = 1 / std::sqrt(1 + x * x + y * y);
            // d omega = dx dy z^3.
            sum += f(Vec3(float(x * z), float(y * z), float(z))) * z * z * z * r * dr *
                   (2 * 3.14159265358979 / (n / 4)) * alpha.x * alpha.y;
        }
    }
    return sum;
}

/// `smith`: exact. Otherwise anisotropic areas may be too large, which shadows more.
template <class Distribution>
void check_areas(bool smith = true) {
    for (Vec2 const& alpha : {Vec2(0.01f, 0.01f), Vec2(0.3f, 0.3f), Vec2(0.9f, 0.1f), Vec2(1, 1)}) {
        Distribution const d{alpha.x, alpha.y};
        // The microsurface projects onto the unit square it covers, and to sigma(w) along w.
        double const flat =
            integrate_normals(alpha, [&](Vec3 const& m) { return d.density(m) * m.z; });
        EXPECT_NEAR(flat, 1, 1e-3);
        for (float const angle : {20.f, 60.f, 85.f}) {
            Vec3 const w = lobes::testing::at_angle(angle);
            double const sigma = integrate_normals(
                alpha, [&](Vec3 const& m) { return d.density(m) * std::max(0.f, dot(w, m)); });
            EXPECT_GE(d.projected_area(w), sigma * (1 - 2e-3)) << alpha.x << " at " << angle;
            double const bound = smith || alpha.x == alpha.y ? 1 + 2e-3 : 1.35;
            EXPECT_LE(d.projected_area(w), sigma * bound) << alpha.x << " at " << angle;
        }
    }
}

TEST(Microfacet, ProjectedAreas) {
    check_areas<Ggx>();
    check_areas<Beckmann>();
    check_areas<AshikhminShirley>(false);
}

} // namespace
