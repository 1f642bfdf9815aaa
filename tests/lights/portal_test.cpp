#include <gtest/gtest.h>

#include <numbers>

#include "base/frame.h"
#include "base/hash.h"
#include "base/warp.h"
#include "lights/portal.h"
#include "tests/support/statistics.h"

namespace weft::lights {
namespace {

double const kAlpha = 0.01;

float bright(Vec3 const& d) {
    return 0.2f + 3 * square(std::max(dot(d, normalize(Vec3(0.3f, 0.4f, 1))), 0.f)) +
           (d.x > 0.3f && d.y < -0.1f ? 2.f : 0.f);
}

Portal portal_at(Vec3 const& centre, Vec3 const& outward, float width, float height) {
    Frame const frame(normalize(outward), Vec3(1, 0.2f, 0));
    return {centre, frame.s, frame.t, frame.n, width / 2, height / 2};
}

PortalSampler sampler_of(std::vector<Portal> const& portals) {
    std::vector<PortalMap> maps;
    for (Portal const& p : portals) maps.emplace_back(p, 64, 2, 0.01f, bright);
    return PortalSampler(std::move(maps));
}

bool passes(Portal const& p, Vec3 const& ref, Vec3 const& d) {
    float const z = dot(d, p.outward), t = dot(p.centre - ref, p.outward) / z;
    Vec3 const hit = ref + d * t - p.centre;
    return z > 0 && t > 0 && std::abs(dot(hit, p.s)) <= p.half_width &&
           std::abs(dot(hit, p.t)) <= p.half_height;
}

struct Case {
    char const* name;
    std::vector<Portal> portals;
    Vec3 ref;
};

std::vector<Case> cases() {
    Portal const window = portal_at({0, 0, 2}, {0, 0, 1}, 2, 1);
    Portal const side = portal_at({2, 0.5f, 0}, {1, 0.1f, 0.2f}, 1, 1.5f);
    Portal const over = portal_at({0.3f, 0.2f, 1.9f}, {0, 0, 1}, 1, 1.4f);
    return {
        {"before a window", {window}, {0.1f, -0.2f, 0}},
        {"under a window, near its wall", {window}, {0.4f, -1.5f, 1.97f}},
        {"far from a small window",
         {portal_at({5, 4, 5}, {0.5f, 0.4f, 0.8f}, 0.3f, 0.4f)},
         {0, 0, 0}},
        {"two windows", {window, side}, {-0.3f, 0, 0.2f}},
        {"windows that overlap", {window, over}, {0, 0, 0}},
        {"one window seen from behind", {window, side}, {0.5f, 0, 3}},
    };
}

TEST(Portals, directions_follow_the_density) {
    auto const all = cases();
    double const level = testing::sidak(kAlpha, 2 * int(all.size()));
    int const rings = 40, sectors = 60, samples = 200'000, grid = 16;
    for (Case const& c : all) {
        SCOPED_TRACE(c.name);
        PortalSampler const sampler = sampler_of(c.portals);
        double const light = sampler.light_at(c.ref);
        ASSERT_GT(light, 0);
        std::vector<double> observed(size_t(rings * sectors)), expected(observed.size());
        double const tau = 2 * std::numbers::pi;
        Rng rng(51);
        for (int i = 0; i < samples; ++i) {
            auto const s = sampler.sample(c.ref, light, rng.next2());
            ASSERT_NEAR(length(s.direction), 1, 1e-5);
            ASSERT_GE(s.pdf, 0);
            double const phi = std::atan2(double(s.direction.y), double(s.direction.x)) / tau;
            int const ring = std::clamp(int((1 - double(s.direction.z)) / 2 * rings), 0, rings - 1);
            ++observed[size_t(ring * sectors + std::min(int((phi + 0.5) * sectors), sectors - 1))];
        }
        double lit = 0, integral = 0, variance = 0;
        for (double count : observed) lit += count > 0;
        int const fine = int(std::sqrt(3e6 / lit)); // the edges of a small window cut few bins
        for (size_t b = 0; b < expected.size(); ++b) {
            int const n = observed[b] > 0 ? fine : grid;
            double sum = 0, squares = 0;
            for (int k = 0; k < n * n; ++k) {
                double const h = (double(b / sectors) + (k / n + double(rng.next())) / n) / rings;
                double const a = (double(b % sectors) + (k % n + double(rng.next())) / n) / sectors;
                double const z = 1 - 2 * h, r = std::sqrt(std::max(1 - z * z, 0.0));
                double const phi = (a - 0.5) * tau;
                double const p = double(sampler.pdf(
                    c.ref, light, Vec3(Vec3d(r * std::cos(phi), r * std::sin(phi), z))));
                sum += p;
                squares += p * p;
            }
            double const weight = 2 * tau / (rings * sectors) / (n * n);
            expected[b] = sum * weight * samples + 1e-6; // a corner may be missed
            integral += sum * weight;
            variance += (squares - sum * sum / (n * n)) * weight * weight;
        }
        double const z = (integral - 1) / (std::sqrt(variance) + 1e-6);
        EXPECT_GT(testing::normal_tail(z), level) << "integral " << integral;
        auto const result = testing::chi_square(observed, expected);
        EXPECT_GT(result.p_value, level) << result.problem << " chi2 " << result.statistic;
    }
}

TEST(Portals, samples_agree_with_densities_and_pass) {
    for (Case const& c : cases()) {
        SCOPED_TRACE(c.name);
        PortalSampler const sampler = sampler_of(c.portals);
        double const light = sampler.light_at(c.ref);
        Rng rng(52);
        int disagree = 0, astray = 0;
        for (int i = 0; i < 20'000; ++i) {
            auto const s = sampler.sample(c.ref, light, rng.next2());
            disagree += std::abs(sampler.pdf(c.ref, light, s.direction) / s.pdf - 1) > 1e-3f;
            bool through = false;
            for (Portal const& p : c.portals) through |= passes(p, c.ref, s.direction);
            astray += !through;
        }
        EXPECT_LE(disagree, 40); // rounded over the edge of a cell
        EXPECT_LE(astray, 40);   // or of the portal
    }
}

TEST(Portals, what_shines_in_is_the_integral) {
    Case const c = cases()[0];
    PortalSampler const sampler = sampler_of(c.portals);
    Rng rng(53);
    std::vector<double> values;
    for (int i = 0; i < 400'000; ++i) {
        Vec3 const d = square_to_sphere(rng.next2());
        values.push_back(passes(c.portals[0], c.ref, d) ? double((bright(d) + 0.01f) / kSpherePdf)
                                                        : 0);
    }
    auto const e = testing::estimate(values);
    // Two percent for the cells that the table is constant over.
    EXPECT_NEAR(sampler.light_at(c.ref), e.mean, 4 * std::sqrt(e.variance) + 0.02 * e.mean);
}

TEST(Portals, are_not_seen_from_outside) {
    PortalSampler const sampler = sampler_of({cases()[0].portals});
    EXPECT_EQ(sampler.light_at({0, 0, 2}), 0);
    EXPECT_EQ(sampler.light_at({0, 0, 5}), 0);
    EXPECT_EQ(PortalSampler().light_at({0, 0, 0}), 0);
}

} // namespace
} // namespace weft::lights
