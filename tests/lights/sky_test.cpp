#include <gtest/gtest.h>

#include <numbers>

#include "base/lat_long.h"
#include "lights/sky_model.h"
#include "lights/solar_position.h"

namespace weft::lights {
namespace {

double const kDeg = std::numbers::pi / 180;

// The authors' formulas, evaluated apart from this code with their tables.
TEST(Sky, is_the_model_of_its_authors) {
    struct Value {
        double turbidity, albedo, elevation, theta, gamma;
        Color radiance;
    };
    for (Value const& v :
         std::initializer_list<Value>{{2.5, 0.3, 30, 45, 60, {17.82883f, 31.75385f, 58.07617f}},
                                      {1, 0, 80, 20, 25, {13.28697f, 25.33900f, 55.93677f}},
                                      {10, 1, 5, 85, 90, {15.43108f, 14.04487f, 12.15815f}},
                                      {6.2, 0.5, 50, 0, 40, {38.07369f, 52.74702f, 81.87448f}},
                                      {4, 0.1, 0.5, 70, 20, {31.51306f, 20.30227f, 11.76639f}}}) {
        Color const found = SkyModel(v.turbidity, v.albedo, v.elevation * kDeg)
                                .radiance(v.theta * kDeg, v.gamma * kDeg);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c] / v.radiance[c], 1, 2e-5) << v.turbidity << ' ' << c;
    }
}

SkyParameters parameters(double elevation, float turbidity) {
    SkyParameters p;
    p.sun = Vec3(Vec3d(std::cos(elevation * kDeg), std::sin(elevation * kDeg), 0));
    p.turbidity = turbidity;
    p.ground = Color(1); // shines with what it receives over pi
    return p;
}

// Ranges that daylight has been measured to be in: Littlefair 1985; Darula and Kittler 2002, "CIE
// general sky standard defining luminance distributions".
TEST(Sky, daylight_is_as_bright_as_it_is) {
    auto const horizontal = [](double elevation, float turbidity, bool sun) {
        SkyParameters p = parameters(elevation, turbidity);
        p.ground = Color(0.2f);
        p.sun_factor = sun ? 1 : 0;
        return luminance(make_sky_table(p, 128, 64).texels.back()) * kPi / 0.2f;
    };
    float const noon = horizontal(60, 3, true), sky = horizontal(60, 3, false);
    EXPECT_GT(noon, 800); // W/m^2
    EXPECT_LT(noon, 1050);
    EXPECT_GT(sky, 80);
    EXPECT_LT(sky, 250);
    EXPECT_GT(luminance(sun_irradiance(2, 60 * kDeg)) * kDaylightEfficacy, 85'000); // lx
    EXPECT_LT(luminance(sun_irradiance(2, 60 * kDeg)) * kDaylightEfficacy, 110'000);
    float const dawn = horizontal(0, 3, true) * kDaylightEfficacy;
    EXPECT_GT(dawn, 300);
    EXPECT_LT(dawn, 5000);
    EXPECT_LT(horizontal(-6, 3, true), 0.02f * horizontal(0, 3, true));
    // Bluer at the zenith than at the horizon, and redder the lower the sun.
    SkyModel const model(3, 0.2, 40 * kDeg);
    Color const zenith = model.radiance(0, 50 * kDeg), low = model.radiance(88 * kDeg, 100 * kDeg);
    EXPECT_GT(zenith.b / zenith.r, 2.5f);
    EXPECT_GT(zenith.b / zenith.r, low.b / low.r);
    EXPECT_GT(luminance(zenith) * kDaylightEfficacy, 1500); // cd/m^2
    EXPECT_LT(luminance(zenith) * kDaylightEfficacy, 6000);
    Color const noon_sun = sun_irradiance(3, 80 * kDeg), evening = sun_irradiance(3, 5 * kDeg);
    EXPECT_GT(evening.r / evening.b, 3 * noon_sun.r / noon_sun.b);
    EXPECT_EQ(sun_irradiance(3, -0.01), Color(0));
}

TEST(Sky, the_table_is_the_model) {
    SkyTable const table = make_sky_table(parameters(35, 3), 768, 384);
    SkyModel const model(3, 1, 35 * kDeg);
    for (Vec3 const& to : {Vec3(0.2f, 1, 0.3f), Vec3(-1, 0.2f, 0.1f), Vec3(0, 1, 1e-3f)}) {
        Vec3 const d = normalize(to);
        double const gamma = std::acos(double(dot(d, parameters(35, 3).sun)));
        Color const expected = model.radiance(std::acos(double(d.y)), gamma);
        Color const found = table.at(direction_to_uv(d));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 5e-3);
    }
    EXPECT_EQ(table.at(direction_to_uv({0.3f, -1, 0.2f})), table.texels.back());
}

// Reda and Andreas 2004, "Solar Position Algorithm for Solar Radiation Applications", appendix A.5:
// the elevation before refraction, and the azimuth.
TEST(SolarPosition, is_as_published) {
    auto const p =
        solar_position(2003, 10, 17, 12 + 30.5 / 60, -7, 39.742476 * kDeg, -105.1786 * kDeg);
    EXPECT_NEAR(p.elevation / kDeg, 39.872046, 0.01);
    EXPECT_NEAR(p.azimuth / kDeg, 194.34024, 0.01);
}

} // namespace
} // namespace weft::lights
