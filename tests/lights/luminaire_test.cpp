// Lamps: falloffs, measured lamps, balls, and images in front of spots.
#include "lights/luminaire.h"

#include <gtest/gtest.h>

#include "base/hash.h"
#include "base/warp.h"
#include "lights/light_bounds.h"
#include "tests/support/statistics.h"

namespace weft::lights {
namespace {

using scene::Photometry;

TEST(SpotLight, smooth_falloff_is_a_smoothstep_in_the_cosine) {
    SpotLight const light{{0, 0, 0}, {0, 0, 1}, Color(1), radians(40), radians(30), true};
    double const inner = std::cos(20 * M_PI / 180), outer = std::cos(35 * M_PI / 180);
    for (float angle : {0.f, 10.f, 20.f, 20.1f, 24.f, 27.5f, 31.f, 34.9f, 35.1f, 90.f, 180.f}) {
        double const a = double(radians(angle));
        double const t = std::clamp((std::cos(a) - outer) / (inner - outer), 0.0, 1.0);
        Vec3 const d(float(3 * std::sin(a)), 0, float(3 * std::cos(a)));
        EXPECT_NEAR(light.attenuation(d), t * t * (3 - 2 * t), 2e-6) << angle;
    }
    // A beam of a hundredth of a degree has no step in its edge.
    SpotLight const narrow{{0, 0, 0}, {0, 0, 1}, Color(1), 0, radians(0.01f), true};
    float before = 1;
    for (int i = 1; i < 1000; ++i) {
        float const now = narrow.attenuation({radians(0.005f) * float(i) / 1000, 0, 1});
        EXPECT_LE(now, before);
        EXPECT_GT(now, before - 0.0025f);
        before = now;
    }
}

TEST(SpotLight, power_of_both_shapes_is_the_integral) {
    for (bool smooth : {false, true})
        for (auto const& [angle, falloff] : std::vector<std::pair<float, float>>{{40, 20},
                                                                                 {10, 0},
                                                                                 {0, 60},
                                                                                 {120, 180},
                                                                                 {180, 180},
                                                                                 {200, 320},
                                                                                 {0, 400},
                                                                                 {1, 1}}) {
            SpotLight const light{{0, 0, 0},      {0, 0, 1},        Color(3),
                                  radians(angle), radians(falloff), smooth};
            constexpr int n = 1'000'000;
            double sum = 0;
            for (int i = 0; i < n; ++i) {
                double const theta = (i + 0.5) * M_PI / n;
                sum +=
                    std::sin(theta) *
                    double(light.attenuation({float(std::sin(theta)), 0, float(std::cos(theta))}));
            }
            double const power = 3 * 2 * M_PI * sum * M_PI / n;
            EXPECT_NEAR(light.power().r / power, 1, 5e-4)
                << angle << " " << falloff << " " << smooth;
        }
}

/// A lamp whose candela are random, over random angles.
Photometry random_lamp(Rng& rng) {
    Photometry lamp;
    auto angles = [&](float from, float to, int n) {
        std::vector<float> list{from};
        for (int i = 1; i < n; ++i)
            list.push_back(from + (to - from) * (float(i) + 0.8f * (rng.next() - 0.5f)) / float(n));
        list.push_back(to);
        return list;
    };
    float const low = rng.next() < 0.5f ? 0.f : 90.f;
    lamp.vertical = angles(low, low == 0 && rng.next() < 0.5f ? 90.f : 180.f, 7);
    lamp.horizontal = rng.next() < 0.3f ? std::vector<float>{0} : angles(0, 360, 9);
    for (size_t i = 0; i < lamp.vertical.size() * lamp.horizontal.size(); ++i)
        lamp.candela.push_back(rng.next() < 0.2f ? 0 : 1000 * rng.next());
    if (lamp.horizontal.size() > 1)
        for (size_t v = 0; v < lamp.vertical.size(); ++v)
            lamp.candela[(lamp.horizontal.size() - 1) * lamp.vertical.size() + v] = lamp.at(0, v);
    return lamp;
}

TEST(PhotometricLight, is_bilinear_between_its_angles) {
    Photometry lamp;
    lamp.vertical = {0, 60, 90};
    lamp.horizontal = {0, 90, 360};
    lamp.candela = {10, 20, 40, 10, 60, 80, 10, 20, 40};
    EXPECT_FLOAT_EQ(candela(lamp, 0, 17), 10);
    EXPECT_FLOAT_EQ(candela(lamp, 60, 0), 20);
    EXPECT_FLOAT_EQ(candela(lamp, 60, 90), 60);
    EXPECT_FLOAT_EQ(candela(lamp, 60, 45), 40);
    EXPECT_FLOAT_EQ(candela(lamp, 75, 45), 50);
    EXPECT_FLOAT_EQ(candela(lamp, 90, 360), 40);
    EXPECT_FLOAT_EQ(candela(lamp, 90, 225), 60);
    EXPECT_EQ(candela(lamp, 90.001f, 225), 0);
    lamp.vertical = {90, 120, 180};
    EXPECT_EQ(candela(lamp, 89.9f, 0), 0);
    EXPECT_FLOAT_EQ(candela(lamp, 120, 90), 60);
}

TEST(PhotometricLight, angles_turn_counter_clockwise_from_above) {
    auto lamp = std::make_shared<Photometry>();
    lamp->vertical = {0, 90, 180};
    lamp->horizontal = {0, 90, 180, 270, 360};
    for (int h : {0, 1, 2, 3, 0})
        for (float share : {1.f, 2.f, 3.f}) lamp->candela.push_back(share + 10 * float(h));
    // Shines down in a world whose z is up, with horizontal angle 0 to the east, x.
    PhotometricLight const light{{0, 0, 5}, lamp_frame({0, 0, -1}, {1, 0, 0}), Color(1), lamp};
    EXPECT_NEAR(light.attenuation({2, 0, 0}), 2, 1e-4);
    EXPECT_NEAR(light.attenuation({0, 2, 0}), 12, 1e-4); // north
    EXPECT_NEAR(light.attenuation({-2, 0, 0}), 22, 1e-4);
    EXPECT_NEAR(light.attenuation({0, -2, 0}), 32, 1e-4);
    EXPECT_NEAR(light.attenuation({1e-6f, 0, -1}), 1, 1e-3);
    EXPECT_NEAR(light.attenuation({1e-6f, 0, 1}), 3, 1e-3);
    EXPECT_NEAR(light.attenuation({1, 0, -1}), 1.5f, 1e-4);
    LightSample const s = light.sample({0, 2, 5});
    EXPECT_NEAR(s.radiance.r, 3, 1e-4); // 12 at distance 2
}

TEST(PhotometricLight, flux_is_the_integral_of_the_candela) {
    Rng rng(3);
    for (int i = 0; i < 40; ++i) {
        Photometry const lamp = random_lamp(rng);
        // Midpoints of a fine grid: candela are linear in the angles, the sine is smooth.
        constexpr int n = 1440;
        double sum = 0;
        for (int v = 0; v < n; ++v) {
            float const vertical = 180 * (float(v) + 0.5f) / n;
            double ring = 0;
            for (int h = 0; h < 360; ++h) ring += double(candela(lamp, vertical, float(h) + 0.5f));
            sum += ring / 360 * std::sin(double(radians(vertical)));
        }
        sum *= 2 * M_PI * M_PI / n;
        EXPECT_NEAR(luminous_flux(lamp) / sum, 1, 2e-3);
    }
    // Of a flat diffuse surface, I cos: pi I lumens.
    Photometry flat;
    flat.horizontal = {0};
    for (int v = 0; v <= 90; ++v) {
        flat.vertical.push_back(float(v));
        flat.candela.push_back(100 * std::max(0.f, std::cos(radians(float(v)))));
    }
    EXPECT_NEAR(luminous_flux(flat), 100 * M_PI, 0.03);
}

TEST(PhotometricLight, is_dark_outside_of_its_bounds) {
    Rng rng(11);
    int outside = 0;
    for (int i = 0; i < 200; ++i) {
        auto const lamp = std::make_shared<Photometry const>(random_lamp(rng));
        PhotometricLight const light{
            {0, 0, 0}, lamp_frame(square_to_sphere(rng.next2()), {1, 0, 0}), Color(1), lamp};
        LightBounds const b = bounds_of(light);
        for (int k = 0; k < 200; ++k) {
            Vec3 const d = square_to_sphere(rng.next2());
            float const theta = std::atan2(length(cross(b.axis, d)), dot(b.axis, d));
            if (theta <= b.theta_o + b.theta_e + 1e-4f) continue;
            ++outside;
            EXPECT_EQ(light.attenuation(d), 0);
        }
    }
    EXPECT_GT(outside, 1000);
}

TEST(Luminaire, a_ball_has_the_intensity_and_the_irradiance_of_its_centre) {
    SpotLight const spot{{1, 2, 3}, {0, -1, 0}, Color(5, 4, 3), radians(300), radians(60), true};
    LuminaireSource const sources[] = {PointLight{{1, 2, 3}, {5, 4, 3}}, spot};
    double const level = testing::sidak(0.01, 6);
    for (auto const& source : sources) {
        Luminaire const lamp = make_luminaire(source, 0.7f);
        Vec3 const d(0.3f, -0.8f, 0.1f);
        Color const i =
            match(source, [&](auto const& s) { return s.intensity * s.attenuation(d); });
        EXPECT_NEAR(lamp.radiance(d).g * kPi * 0.49f, i.g, 1e-5);
        EXPECT_EQ(lamp.power(), match(source, [](auto const& s) { return s.power(); }));
    }
    // Of an isotropic ball: I cos / d^2 wherever all of it is above the surface.
    Luminaire const lamp = make_luminaire(sources[0], 0.7f);
    for (Vec3 const& ref : {Vec3(1, 2, 1), Vec3(1.5f, 1, 3.5f), Vec3(1, 2, 2.25f), Vec3(9, 2, 3),
                            Vec3(-200, 30, 3), Vec3(1, 1.2f, 3)}) {
        Vec3 const to = lamp.position() - ref;
        Vec3 const n = normalize(normalize(to) + Vec3(0.1f, 0.05f, 0.1f));
        if (dot(to, n) < 0.7f) continue; // a part would be below
        std::vector<double> values;
        Rng rng(5);
        for (int k = 0; k < 100'000; ++k) {
            EmitterSample const s = lamp.ball->sample(ref, rng.next2());
            ASSERT_GT(s.pdf, 0);
            values.push_back(double(lamp.radiance(-s.wi).r * std::max(dot(n, s.wi), 0.f) / s.pdf));
        }
        auto const e = testing::estimate(values);
        double const exact = double(5 * dot(n, normalize(to)) / length_squared(to));
        EXPECT_GT(
            testing::normal_tail((e.mean - exact) / std::sqrt(e.variance + 1e-12 * exact * exact)),
            level)
            << e.mean << " for " << exact;
    }
    EXPECT_FALSE(make_luminaire(sources[0], 0).ball);
    EXPECT_FALSE(make_luminaire(sources[0], 1e-20f).ball);
}

TEST(Luminaire, rays_meet_the_ball_that_light_sampling_samples) {
    Rng rng(8);
    int met = 0;
    for (int i = 0; i < 20'000; ++i) {
        float const radius = std::exp(6 * rng.next() - 4), far = std::exp(9 * rng.next() - 4);
        Vec3 const centre = square_to_sphere(rng.next2()) * 5.f;
        Luminaire const lamp = make_luminaire(PointLight{centre, Color(1)}, radius);
        Vec3 const ref = centre + square_to_sphere(rng.next2()) * far;
        EmitterSample const s = lamp.ball->sample(ref, rng.next2());
        ASSERT_GT(s.pdf, 0);
        Vec3 n;
        double const t = distance_to_ball(centre, radius, ref, s.wi, ref, n);
        if (t < 0) { // the silhouette, by rounding
            EXPECT_LT(std::abs(dot(s.n, s.wi)), 0.02f);
            continue;
        }
        ++met;
        double const rounding = 2e-6 * double(far + radius + 5);
        EXPECT_NEAR(t, double(s.distance),
                    rounding / std::max(1e-2, std::abs(double(dot(n, s.wi)))));
        Vec3 const p = ref + s.wi * float(t);
        EXPECT_NEAR(lamp.ball->pdf(ref, p, n) / s.pdf, 1, 1e-5);
        EXPECT_EQ(dot(n, s.wi) > 0, far < radius);
        // A ray that misses the cone misses the ball.
        Vec3 const away = normalize(ref - centre);
        EXPECT_TRUE(far < radius || distance_to_ball(centre, radius, ref, away, ref, n) < 0);
    }
    EXPECT_GT(met, 19'000);
}

TEST(GoboProjection, stands_upright_around_the_outer_cone) {
    // Along -z with y up, x is to the right.
    GoboProjection const gobo({0, 0, -1}, {0, 1, 0}, radians(90));
    EXPECT_LT(length(Vec3(gobo.uv({0, 0, -1}).x - 0.5f, gobo.uv({0, 0, -1}).y - 0.5f, 0)), 1e-6f);
    EXPECT_NEAR(gobo.uv({1, 0, -1}).x, 1, 1e-6);
    EXPECT_NEAR(gobo.uv({-1, 0, -1}).x, 0, 1e-6);
    EXPECT_NEAR(gobo.uv({0, 2, -2}).y, 1, 1e-6);
    EXPECT_NEAR(gobo.uv({0, -2, -2}).y, 0, 1e-6);
    Rng rng(4);
    GoboProjection const turned(normalize(Vec3(1, -2, 0.5f)), {0.2f, 1, 0.1f}, radians(50));
    for (int i = 0; i < 100; ++i) {
        Vec2 const uv = rng.next2();
        Vec2 const back = turned.uv(turned.direction(uv) * 3.f);
        EXPECT_NEAR(back.x, uv.x, 1e-5);
        EXPECT_NEAR(back.y, uv.y, 1e-5);
        EXPECT_GT(dot(turned.direction({0.5f, 0.9f}), Vec3(0.2f, 1, 0.1f)),
                  dot(turned.direction({0.5f, 0.1f}), Vec3(0.2f, 1, 0.1f)));
    }
    // Straight down, the default up is along the axis: z is up then.
    GoboProjection const down({0, -1, 0}, {0, 1, 0}, radians(90));
    EXPECT_NEAR(down.uv({0, -1, 1}).y, 1, 1e-6);
}

} // namespace
} // namespace weft::lights
