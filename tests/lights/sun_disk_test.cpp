#include <gtest/gtest.h>

#include <numbers>

#include "base/hash.h"
#include "lights/sun_disk.h"
#include "tests/support/statistics.h"

namespace weft::lights {
namespace {

double const kAlpha = 0.01;

struct Case {
    char const* name;
    SunDisk sun;
};

std::vector<Case> cases() {
    Vec3 const up(0, 1, 0), tilted = normalize(Vec3(0.3f, 0.5f, -0.7f));
    float const small = radians(0.5f * kSunDiameter);
    return {
        {"a uniform disk", make_sun_disk(tilted, small, Color(1))},
        {"the sun", make_sun_disk(tilted, small, Color(5, 4, 3), kSunLimb)},
        {"the sun ten times as large", make_sun_disk(up, 10 * small, Color(1), kSunLimb)},
        {"a hemisphere", make_sun_disk(up, kPi / 2, Color(1))},
        {"a dark limb", make_sun_disk(-tilted, radians(30.f), Color(1), Color(2, 3, 4))},
        {"a fifth of the sun", make_sun_disk(tilted, radians(0.05f), Color(1), kSunLimb)},
    };
}

TEST(SunDisk, directions_follow_the_density) {
    // Rings and sectors around the axis; the density integrated over each by midpoints in x.
    int const rings = 16, sectors = 8, samples = 400'000;
    auto const all = cases();
    double const level = testing::sidak(kAlpha, int(all.size()));
    for (Case const& c : all) {
        SCOPED_TRACE(c.name);
        Frame const frame(c.sun.direction);
        std::vector<double> observed(rings * sectors), expected(rings * sectors);
        Rng rng(41);
        for (int i = 0; i < samples; ++i) {
            Vec3d const d(c.sun.sample(rng.next2()).wi);
            Vec3d const local(dot(d, Vec3d(frame.s)), dot(d, Vec3d(frame.t)),
                              dot(d, Vec3d(frame.n)));
            double const h = 0.5 * length_squared(d - Vec3d(c.sun.direction));
            double const phi = std::atan2(local.y, local.x) / (2 * std::numbers::pi) + 0.5;
            int const ring = std::min(int(h / double(c.sun.one_minus_cos) * rings), rings - 1);
            ++observed[size_t(ring * sectors + std::min(int(phi * sectors), sectors - 1))];
        }
        int const steps = 400;
        double integral = 0;
        for (int r = 0; r < rings; ++r) {
            double sum = 0;
            for (int k = 0; k < steps; ++k) {
                double const h = double(c.sun.one_minus_cos) * (r + (k + 0.5) / steps) / rings;
                float const sine = float(std::sqrt(h * (2 - h)));
                sum += double(c.sun.pdf(normalize(frame.to_world({sine, 0, float(1 - h)}))));
            }
            double const ring_measure =
                2 * std::numbers::pi * double(c.sun.one_minus_cos) / rings / steps;
            integral += sum * ring_measure;
            for (int s = 0; s < sectors; ++s)
                expected[size_t(r * sectors + s)] = sum * ring_measure * samples / sectors;
        }
        EXPECT_NEAR(integral, 1, 3e-3); // midpoints before an edge of infinite slope
        auto const result = testing::chi_square(observed, expected);
        EXPECT_GT(result.p_value, level) << result.problem << " chi2 " << result.statistic;
    }
}

TEST(SunDisk, samples_agree_with_what_rays_find) {
    for (Case const& c : cases()) {
        SCOPED_TRACE(c.name);
        Rng rng(42);
        int disagree = 0;
        for (int i = 0; i < 20'000; ++i) {
            auto const s = c.sun.sample(rng.next2());
            ASSERT_GT(s.pdf, 0);
            ASSERT_NEAR(length(s.wi), 1, 1e-6);
            Color const seen = c.sun.radiance(s.wi);
            disagree += std::abs(c.sun.pdf(s.wi) / s.pdf - 1) > 2e-3f ||
                        std::abs(seen.g / s.radiance.g - 1) > 2e-3f;
        }
        // Where rounding moves a direction at the rim, whose radiance falls with infinite slope.
        EXPECT_LE(disagree, 20'000 / 500);
    }
}

TEST(SunDisk, irradiance_is_what_was_asked_for) {
    for (Case const& c : cases()) {
        SCOPED_TRACE(c.name);
        Rng rng(43);
        std::vector<double> red, blue;
        for (int i = 0; i < 100'000; ++i) {
            auto const s = c.sun.sample(rng.next2());
            double const cosine = double(dot(s.wi, c.sun.direction) / s.pdf);
            red.push_back(double(s.radiance.r) * cosine);
            blue.push_back(double(s.radiance.b) * cosine);
        }
        Color const asked = c.sun.irradiance();
        for (auto const& [values, expected] : {std::pair(&red, asked.r), {&blue, asked.b}}) {
            auto const e = testing::estimate(*values);
            EXPECT_NEAR(e.mean, double(expected), 4.5 * std::sqrt(e.variance) + 1e-5 * e.mean);
        }
    }
    Color const asked(5, 4, 3);
    Color const found = make_sun_disk({0, 0, 1}, radians(1.f), asked, kSunLimb).irradiance();
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], asked[k], 1e-5f);
    // A uniform disk: pi sin^2.
    SunDisk const hemisphere = make_sun_disk({0, 0, 1}, kPi / 2, Color(kPi));
    EXPECT_NEAR(hemisphere.centre.r, 1, 1e-5);
}

// Cox 2000, Allen's Astrophysical Quantities, 14.7: 1 - u (1 - mu) - v (1 - mu^2) at 550 nm.
TEST(SunDisk, the_limb_darkens_as_measured) {
    SunDisk const sun = make_sun_disk({0, 0, 1}, radians(0.5f * kSunDiameter), Color(1), kSunLimb);
    for (double mu : {1.0, 0.8, 0.6, 0.4, 0.3}) {
        double const h = (1 - mu * mu) * double(sun.one_minus_cos);
        Vec3 const d(float(std::sqrt(h * (2 - h))), 0, float(1 - h));
        double const measured = 1 - 0.93 * (1 - mu) + 0.23 * (1 - mu * mu);
        EXPECT_NEAR(double(sun.radiance(d).g / sun.centre.g), measured, 0.02) << "mu " << mu;
    }
    EXPECT_EQ(sun.radiance({0, 0, -1}), Color(0));
    EXPECT_EQ(sun.radiance(normalize(Vec3(0, 0.00466f, 1))), Color(0));
    EXPECT_GT(sun.radiance(normalize(Vec3(0, 0.00464f, 1))).g, 0);
}

} // namespace
} // namespace weft::lights
