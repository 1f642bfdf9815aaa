// The fibre: energy over a grid of its parameters, and which way its lobes go.
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/lobes/configurations.h"

using namespace weft;
using namespace weft::lobes;

namespace {

Vec3 direction(float theta, float phi) {
    return {std::sin(theta), std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi)};
}

/// f over the whole sphere by the midpoint rule in the fibre's own angles.
double sphere_integral(Hair const& hair, Vec3 const& wo) {
    constexpr int thetas = 192, phis = 256;
    double sum = 0;
    for (int i = 0; i < thetas; ++i) {
        float const theta = kPi * ((float(i) + 0.5f) / thetas - 0.5f);
        double row = 0;
        for (int j = 0; j < phis; ++j)
            row += hair.eval(wo, direction(theta, 2 * kPi * (float(j) + 0.5f) / phis)).f.g;
        sum += row * std::cos(theta);
    }
    return sum * kPi / thetas * 2 * kPi / phis;
}

TEST(Hair, WhiteFurnace) {
    double worst = 0;
    for (float const beta_m : {0.1f, 0.3f, 0.6f, 1.f})
        for (float const beta_n : {0.1f, 0.3f, 0.6f, 1.f})
            for (float const h : {-0.95f, 0.f, 0.6f})
                for (float const theta : {-80.f, 0.f, 50.f}) {
                    Hair const hair({.beta_m = beta_m, .beta_n = beta_n}, h);
                    double const leaves = sphere_integral(hair, direction(radians(theta), 0.4f));
                    worst = std::max(worst, std::abs(leaves - 1));
                    EXPECT_NEAR(leaves, 1, 0.01)
                        << beta_m << " " << beta_n << " " << h << " " << theta;
                }
    std::printf("white hair: worst |integral - 1| %.2g\n", worst);
}

TEST(Hair, AlbedoOfPigmentIsExact) {
    for (float const h : {-0.8f, 0.1f})
        for (float const theta : {-60.f, 10.f}) {
            Hair const hair({.sigma_a = sigma_a_from_melanin(0.5f, 0.3f)}, h);
            Vec3 const wo = direction(radians(theta), 1.2f);
            EXPECT_NEAR(sphere_integral(hair, wo), hair.albedo(wo).g, 1e-3);
        }
}

/// A black fibre only reflects off its surface: the mirror image about the normal that h means.
TEST(Hair, ReflectsAboutTheNormalOfTheRoundFibre) {
    for (float const h : {-0.9f, -0.3f, 0.f, 0.5f}) {
        Vec3 const x(1, 0, 0), wo = direction(radians(25.f), 0.8f);
        Vec3 const across = normalize(Vec3(0, wo.y, wo.z));
        float const phi = std::atan2(across.z, across.y) - std::asin(h);
        Vec3 const n = direction(0, phi);
        ASSERT_NEAR(dot(x, cross(n, across)), h, 1e-6);
        Hair const hair({.sigma_a = Color(1e3f), .beta_m = 0.05f, .beta_n = 0.05f, .alpha = 0}, h);
        Vec3 const mirrored = reflect(wo, n);
        float const peak = hair.eval(wo, mirrored).f.g;
        float const mirrored_phi = std::atan2(mirrored.z, mirrored.y);
        for (float const away : {-0.1f, 0.1f}) {
            float const theta = std::asin(mirrored.x);
            EXPECT_GT(peak, 2 * hair.eval(wo, direction(theta, mirrored_phi + away)).f.g) << h;
            EXPECT_GT(peak, 2 * hair.eval(wo, direction(theta + away, mirrored_phi)).f.g) << h;
        }
    }
}

TEST(Hair, ScalesTiltReflectionTowardsTheRoot) {
    float const alpha = radians(3.f);
    Hair const hair({.sigma_a = Color(1e3f), .beta_m = 0.1f, .alpha = alpha}, 0);
    Vec3 const wo(0, 0, 1);
    float const at_peak = hair.eval(wo, direction(-2 * alpha, kPi / 2)).f.g;
    EXPECT_GT(at_peak, hair.eval(wo, direction(0, kPi / 2)).f.g);
    EXPECT_GT(at_peak, hair.eval(wo, direction(-4 * alpha, kPi / 2)).f.g);
}

/// A clear fibre focuses what passes through its middle straight behind it.
TEST(Hair, TransmitsForwards) {
    Hair const hair({.beta_m = 0.2f, .beta_n = 0.2f, .alpha = 0}, 0);
    Vec3 const wo(0, 0, 1);
    EXPECT_GT(hair.eval(wo, {0, 0, -1}).f.g, 10 * hair.eval(wo, {0, 1, 0}).f.g);
}

TEST(Hair, Pigments) {
    EXPECT_EQ(sigma_a_from_melanin(0, 0), Color());
    // Eumelanin takes blue light most and red light least; so does pheomelanin, more steeply.
    Color const brown = sigma_a_from_melanin(1, 0), red = sigma_a_from_melanin(0, 1);
    EXPECT_LT(brown.r, brown.g);
    EXPECT_LT(brown.g, brown.b);
    EXPECT_GT(red.b / red.r, brown.b / brown.r);
    // At beta_n = 0 the divisor of eq. 9 is 5.969.
    Color const c = sigma_a_from_color(Color(0.5f, 0.2f, 1), 0);
    EXPECT_NEAR(c.r, square(std::log(0.5f) / 5.969f), 1e-6);
    EXPECT_LT(c.r, c.g);
    EXPECT_NEAR(c.b, 0, 1e-6);
    EXPECT_TRUE(is_finite(sigma_a_from_color(Color(0), 0.3f)));
}

} // namespace
