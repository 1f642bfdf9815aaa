#include <gtest/gtest.h>

#include "base/hash.h"
#include "base/warp.h"
#include "lights/delta_lights.h"
#include "tests/support/statistics.h"

namespace weft::lights {
namespace {

TEST(PointLight, falls_with_the_square_of_the_distance) {
    PointLight const light{{1, 2, 3}, {8, 4, 2}};
    LightSample const s = light.sample({1, 2, 1});
    EXPECT_EQ(s.wi, Vec3(0, 0, 1));
    EXPECT_EQ(s.distance, 2);
    EXPECT_EQ(s.radiance, Color(2, 1, 0.5f));
    EXPECT_TRUE(is_black(light.sample({1, 2, 3}).radiance));
    EXPECT_FLOAT_EQ(light.power().g, 16 * kPi);
}

TEST(DirectionalLight, is_the_same_everywhere) {
    DirectionalLight const light{{0, 0.6f, 0.8f}, {1, 2, 3}};
    LightSample const s = light.sample();
    EXPECT_EQ(s.wi, light.direction);
    EXPECT_EQ(s.distance, kInfinity);
    EXPECT_EQ(s.radiance, light.irradiance);
    EXPECT_EQ(s.pdf, 1);
    EXPECT_TRUE(s.delta);
    EXPECT_FLOAT_EQ(light.power(2).b, 12 * kPi);
}

/// The point at distance 2 whose direction from the light is `degrees` off the axis.
Vec3 off_axis(SpotLight const& light, float angle) {
    return light.position +
           Vec3(std::cos(radians(angle)), std::sin(radians(angle)), 0) * 2.f; // axis +x
}

TEST(SpotLight, falloff_is_linear_in_the_angle) {
    SpotLight const light{{3, 1, 2}, {1, 0, 0}, Color(4), radians(40), radians(20)};
    struct {
        float angle, share;
    } const expected[] = {{0, 1},     {10, 1},        {19.9f, 1},      {20, 1}, {22.5f, 0.75f},
                          {25, 0.5f}, {27.5f, 0.25f}, {29, 0.1f},      {30, 0}, {31, 0},
                          {90, 0},    {180, 0},       {-22.5f, 0.75f}, {-35, 0}};
    for (auto const& e : expected) {
        LightSample const s = light.sample(off_axis(light, e.angle));
        EXPECT_NEAR(s.radiance.r, e.share, 1e-5) << e.angle; // 4 / 2^2
        EXPECT_NEAR(s.distance, 2, 1e-6);
    }
    EXPECT_TRUE(is_black(light.sample(light.position).radiance));
}

TEST(SpotLight, hard_edge_and_extremes) {
    SpotLight hard{{0, 0, 0}, {1, 0, 0}, Color(4), radians(40), 0};
    EXPECT_FLOAT_EQ(hard.sample(off_axis(hard, 19.99f)).radiance.r, 1);
    EXPECT_EQ(hard.sample(off_axis(hard, 20.01f)).radiance.r, 0);
    // A beam a tenth of a degree wide still has its edge in the right place.
    hard.angle = radians(0.1f);
    EXPECT_FLOAT_EQ(hard.sample(off_axis(hard, 0.0499f)).radiance.r, 1);
    EXPECT_EQ(hard.sample(off_axis(hard, 0.0501f)).radiance.r, 0);
    // 360 degrees is a point light.
    hard.angle = 2 * kPi;
    EXPECT_FLOAT_EQ(hard.sample(off_axis(hard, 180)).radiance.r, 1);
    EXPECT_NEAR(hard.power().r, 16 * kPi, 1e-4);
}

TEST(SpotLight, power_is_the_integral_of_the_intensity) {
    struct {
        float angle, falloff;
    } const lights[] = {{40, 20}, {10, 0}, {0, 60}, {120, 180}, {180, 180}, {200, 320}, {0, 400}};
    double const level = testing::sidak(0.01, int(std::size(lights)));
    for (auto const& l : lights) {
        SCOPED_TRACE(l.angle);
        SpotLight const light{{0, 0, 0},
                              normalize(Vec3(1, -2, 0.5f)),
                              Color(3),
                              radians(l.angle),
                              radians(l.falloff)};
        std::vector<double> values;
        Rng rng(21);
        for (int i = 0; i < 400'000; ++i)
            values.push_back(3.0 * double(light.attenuation(square_to_sphere(rng.next2()))) /
                             double(kSpherePdf));
        auto const e = testing::estimate(values);
        double const z = (e.mean - double(light.power().r)) / std::sqrt(e.variance);
        EXPECT_GT(testing::normal_tail(z), level) << e.mean << " for " << light.power().r;
    }
}

} // namespace
} // namespace weft::lights
