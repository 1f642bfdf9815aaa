#include <gtest/gtest.h>

#include <numbers>

#include "base/hash.h"
#include "lights/environment.h"
#include "tests/support/statistics.h"

namespace weft::lights {
namespace {

double const kAlpha = 0.01;
double const kTau = 2 * std::numbers::pi;

TEST(LatLong, is_as_documented) {
    auto const expect = [](Vec3 const& d, float u, float v) {
        Vec2 const uv = direction_to_uv(d);
        EXPECT_NEAR(uv.x, u, 1e-6);
        EXPECT_NEAR(uv.y, v, 1e-6);
        EXPECT_LT(length(uv_to_direction(uv) - normalize(d)), 1e-6);
    };
    expect({1, 0, 0}, 0.5f, 0.5f);
    expect({0, 0, 1}, 0.25f, 0.5f);
    expect({0, 0, -2}, 0.75f, 0.5f);
    expect({-1, 0, 1e-9f}, 0, 0.5f);
    expect({-1, 0, -1e-9f}, 1, 0.5f);
    expect({1, 1, 0}, 0.5f, 0.25f);
    expect({1, -1, 0}, 0.5f, 0.75f);
    EXPECT_EQ(direction_to_uv({0, 1, 0}).y, 0);
    EXPECT_NEAR(direction_to_uv({0, -1, 0}).y, 1, 1e-7);
    // Digits near the pole, where an arc cosine would give 0.
    EXPECT_NEAR(direction_to_uv({1e-5f, 1, 0}).y / (1e-5f * kInvPi), 1, 1e-6);
}

TEST(LatLong, round_trips) {
    Rng rng(31);
    double worst = 0;
    for (int i = 0; i < 100'000; ++i) {
        Vec2 const uv = rng.next2();
        Vec2 const back = direction_to_uv(uv_to_direction(uv));
        // At the pole u has as few digits as the direction has.
        double const r = std::sin(double(uv.y) * kTau / 2);
        worst =
            std::max({worst, std::abs(double(back.x - uv.x)) * r, std::abs(double(back.y - uv.y))});
    }
    EXPECT_LT(worst, 3e-7);
}

struct Map {
    char const* name;
    uint32_t width, height;
    std::vector<float> luminance;
    EnvironmentGrid::Filter filter = EnvironmentGrid::Filter::nearest;
    bool compensated = false;

    EnvironmentSampler sampler() const {
        return EnvironmentSampler({filter, width, height, luminance}, compensated);
    }
};

std::vector<Map> maps() {
    std::vector<Map> result;
    auto const add = [&](char const* name, uint32_t w, uint32_t h, auto const& f) {
        Map m{name, w, h, {}};
        for (uint32_t y = 0; y < h; ++y)
            for (uint32_t x = 0; x < w; ++x) m.luminance.push_back(f(x, y));
        result.push_back(m);
    };
    using U = uint32_t;
    add("one cell", 1, 1, [](U, U) { return 2.f; });
    add("uniform", 16, 8, [](U, U) { return 1.f; });
    add("odd rows", 10, 5, [](U x, U y) { return float(1 + x + 3 * y); });
    add("two rows", 3, 2, [](U x, U y) { return float(x + y); });
    add("noise", 32, 16, [](U x, U y) { return square(to_unit_float(hash_combine(x, y))); });
    add("a sun in a sky", 64, 32, [](U x, U y) { return x == 20 && y == 9 ? 1e4f : 0.1f; });
    add("a single pixel", 32, 16, [](U x, U y) { return x == 31 && y == 4 ? 1.f : 0.f; });
    add("a pixel at +y", 32, 16, [](U x, U y) { return x == 7 && y == 0 ? 1.f : 0.f; });
    add("a pixel at -y", 32, 16, [](U x, U y) { return x == 0 && y == 15 ? 1.f : 0.f; });
    add("the poles", 16, 9, [](U, U y) { return y == 0 || y == 8 ? 5.f : 0.01f; });
    add("black", 8, 4, [](U, U) { return 0.f; });
    add("broken values", 8, 4, [](U x, U y) {
        return x == 1 ? -3.f : x == 2 ? kInfinity : x == 3 ? std::nanf("") : float(1 + y);
    });
    return result;
}

/// The same as the texels of bilinear maps, whose last row is there twice as at a clamped border,
/// and both kinds compensated.
std::vector<Map> all_maps() {
    std::vector<Map> result = maps();
    for (Map const& m : maps()) {
        Map smooth = m;
        smooth.filter = EnvironmentGrid::Filter::bilinear;
        auto& v = smooth.luminance;
        std::vector<float> const first(v.begin(), v.begin() + m.width);
        std::vector<float> const last(v.end() - m.width, v.end());
        v.insert(v.begin(), first.begin(), first.end());
        v.insert(v.end(), last.begin(), last.end());
        result.push_back(smooth);
    }
    for (size_t i : {size_t(4), size_t(5), maps().size() + 4, maps().size() + 5}) {
        result.push_back(result[i]);
        result.back().compensated = true;
    }
    return result;
}

/// Bins of equal solid angle around an axis that is not the map's.
struct TiltedBins {
    static constexpr int kRings = 24, kSectors = 32, kCount = kRings * kSectors;
    Vec3d n = normalize(Vec3d(0.3, 0.8, -0.4));
    Vec3d s = normalize(cross(n, Vec3d(1, 0, 0))), t = cross(n, s);

    int find(Vec3d const& d) const {
        double const h = (1 - dot(d, n)) / 2, phi = std::atan2(dot(d, t), dot(d, s)) / kTau;
        int const ring = std::clamp(int(h * kRings), 0, kRings - 1);
        return ring * kSectors + std::min(int((phi < 0 ? phi + 1 : phi) * kSectors), kSectors - 1);
    }
    /// The integral of the density over a bin by grid^2 jittered points, and a bound of its
    /// variance.
    std::pair<double, double> integrate(EnvironmentSampler const& e, int b, int grid,
                                        Rng& rng) const {
        double sum = 0, squares = 0;
        int const count = grid * grid;
        for (int k = 0; k < count; ++k) {
            double const h = (b / kSectors + (k / grid + double(rng.next())) / grid) / kRings;
            double const a = (b % kSectors + (k % grid + double(rng.next())) / grid) / kSectors;
            double const z = 1 - 2 * h, r = std::sqrt(1 - z * z);
            Vec3d const d = s * (r * std::cos(kTau * a)) + t * (r * std::sin(kTau * a)) + n * z;
            double const p = double(e.pdf(Vec3(d)));
            sum += p;
            squares += p * p;
        }
        double const weight = 2 * kTau / kCount / count;
        return {sum * weight, (squares - sum * sum / count) * weight * weight};
    }
};

TEST(Environment, directions_follow_the_density) {
    auto const all = all_maps();
    double const level = testing::sidak(kAlpha, 2 * int(all.size()));
    int const samples = 200'000;
    double const evaluations = 2e6;
    TiltedBins const bins;
    for (Map const& m : all) {
        SCOPED_TRACE(m.name);
        EnvironmentSampler const sampler = m.sampler();
        std::vector<double> observed(TiltedBins::kCount), expected(TiltedBins::kCount);
        Rng rng(32);
        for (int i = 0; i < samples; ++i)
            ++observed[size_t(bins.find(Vec3d(sampler.sample(rng.next2()).direction)))];
        // As many evaluations as the time allows, more where an error would weigh more; the light
        // of a bin may all be in a small corner of it.
        double share = 0, lit = 0;
        for (double count : observed) {
            share += std::sqrt(count + 1);
            lit += count > 0;
        }
        double integral = 0, variance = 0;
        for (int b = 0; b < TiltedBins::kCount; ++b) {
            double const part = 0.5 * std::sqrt(observed[size_t(b)] + 1) / share +
                                (observed[size_t(b)] > 0 ? 0.5 / lit : 0);
            int const grid = int(std::sqrt(evaluations * part));
            auto const [value, its_variance] = bins.integrate(sampler, b, grid, rng);
            expected[size_t(b)] = value * samples + 1e-6; // a corner may be missed
            integral += value;
            variance += its_variance;
        }
        // 1e-6: a constant density has no noise but that of its floats.
        double const z = (integral - 1) / (std::sqrt(std::max(variance, 0.0)) + 1e-6);
        EXPECT_GT(testing::normal_tail(z), level) << "integral " << integral;
        auto const result = testing::chi_square(observed, expected);
        EXPECT_GT(result.p_value, level)
            << result.problem << " chi2 " << result.statistic << " dof " << result.dof;
    }
}

TEST(Environment, cells_are_chosen_by_light_and_solid_angle) {
    // Exact expectations: luminance (cos theta_0 - cos theta_1) of each cell, found again by uv.
    auto const all = maps();
    double const level = testing::sidak(kAlpha, int(all.size()));
    int const samples = 500'000;
    for (Map const& m : all) {
        SCOPED_TRACE(m.name);
        if (m.width * m.height == 1) continue;
        EnvironmentSampler const sampler = m.sampler();
        std::vector<double> expected(m.luminance.size()), observed(m.luminance.size());
        double total = 0;
        for (uint32_t i = 0; i < expected.size(); ++i) {
            double const y = i / m.width, pi = kTau / 2;
            double const band = std::cos(pi * y / m.height) - std::cos(pi * (y + 1) / m.height);
            float const l = m.luminance[i];
            expected[i] = std::isfinite(l) && l > 0 ? double(l) * band * kTau / m.width : 0;
            total += expected[i];
        }
        EXPECT_NEAR(sampler.total(), total, 1e-6 * total);
        if (total == 0) continue; // black: only the density is promised
        for (double& e : expected) e *= samples / total;
        Rng rng(33);
        int strays = 0;
        for (int i = 0; i < samples; ++i) {
            auto const s = sampler.sample(rng.next2());
            auto const x = std::min(uint32_t(s.uv.x * float(m.width)), m.width - 1);
            auto const y = std::min(uint32_t(s.uv.y * float(m.height)), m.height - 1);
            if (expected[y * m.width + x] == 0)
                ++strays; // rounded over the edge of a cell
            else
                ++observed[y * m.width + x];
        }
        EXPECT_LE(strays, 5);
        auto const result = testing::chi_square(observed, expected);
        EXPECT_GT(result.p_value, level) << " chi2 " << result.statistic;
    }
}

TEST(Environment, sample_and_pdf_agree) {
    for (Map const& m : all_maps()) {
        SCOPED_TRACE(m.name);
        EnvironmentSampler const sampler = m.sampler();
        Rng rng(34);
        int disagree = 0, none = 0;
        int const n = 50'000;
        float peak = 0; // next to which the slopes of bilinear cells turn rounding into noise
        for (int i = 0; i < n; ++i) peak = std::max(peak, sampler.sample(rng.next2()).pdf);
        for (int i = 0; i < n; ++i) {
            auto const s = sampler.sample(rng.next2());
            ASSERT_TRUE(s.pdf >= 0 && std::isfinite(s.pdf));
            none += s.pdf == 0;
            EXPECT_NEAR(length(s.direction), 1, 1e-6);
            EXPECT_LT(length(uv_to_direction(s.uv) - s.direction), 2e-6);
            disagree += std::abs(sampler.pdf(s.direction) - s.pdf) > 1e-5f * (s.pdf + 2 * peak);
        }
        EXPECT_LE(none, 1); // a black corner
        // Only where rounding moves a direction over the edge of a cell.
        EXPECT_LE(disagree, n / 2000);
    }
}

TEST(Environment, a_uniform_map_is_sampled_uniformly) {
    EnvironmentSampler const sampler(EnvironmentGrid{EnvironmentGrid::Filter::nearest, 64, 33,
                                                     std::vector<float>(64 * 33, 1.f)});
    EXPECT_NEAR(sampler.total(), 2 * kTau, 1e-5);
    Rng rng(35);
    for (int i = 0; i < 1000; ++i)
        EXPECT_NEAR(sampler.sample(rng.next2()).pdf * float(2 * kTau), 1, 2e-5);
    for (Vec3 const& pole : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(-0.f, 1, -0.f)})
        EXPECT_NEAR(sampler.pdf(pole) * float(2 * kTau), 1, 2e-5);
    for (float x : {0.f, 0.5f, kOneMinusEpsilon})
        for (float y : {0.f, 0x1p-24f, kOneMinusEpsilon}) {
            auto const s = sampler.sample({x, y});
            EXPECT_NEAR(s.pdf * float(2 * kTau), 1, 2e-5);
            EXPECT_NEAR(length(s.direction), 1, 1e-6);
        }
}

TEST(Environment, a_compensated_map_is_sampled_where_it_is_brighter_than_its_mean) {
    for (Map const& m : all_maps()) {
        if (!m.compensated) continue;
        SCOPED_TRACE(m.name);
        EnvironmentSampler const sampler = m.sampler();
        Map full = m;
        full.compensated = false;
        EXPECT_EQ(sampler.total(), full.sampler().total());
        float const mean = sampler.total() / float(2 * kTau);
        Rng rng(36);
        for (int i = 0; i < 10'000; ++i) {
            Vec2 const uv = sampler.sample(rng.next2()).uv;
            if (m.filter != EnvironmentGrid::Filter::nearest) continue;
            auto const x = std::min(uint32_t(uv.x * float(m.width)), m.width - 1);
            auto const y = std::min(uint32_t(uv.y * float(m.height)), m.height - 1);
            ASSERT_GE(m.luminance[y * m.width + x], mean);
        }
    }
    // Of what is even, nothing would be left.
    std::vector<float> values(16 * 8, 1.f);
    values[37] = 1.0001f;
    EnvironmentSampler const even({EnvironmentGrid::Filter::nearest, 16, 8, values}, true);
    EXPECT_NEAR(even.pdf({0, 1, 0}) * float(2 * kTau), 1, 2e-4);
}

// What makes a small sun as good as a directional light: the ratio of a bilinear map to its density
// is as good as constant.
TEST(Environment, bilinear_suns_are_sampled_without_noise) {
    for (uint32_t row : {32u, 12u, 50u}) {
        EnvironmentGrid grid{EnvironmentGrid::Filter::bilinear, 128, 64, {}};
        grid.values.assign(128 * 66, 0.f);
        grid.values[size_t(row) * 128] = 1; // at the seam
        EnvironmentSampler const sampler(grid);
        Rng rng(37);
        std::vector<double> estimates;
        for (int i = 0; i < 20'000; ++i) {
            auto const s = sampler.sample(rng.next2());
            double const du = 1 - std::abs(std::remainder(double(s.uv.x) * 128 - 0.5, 128));
            double const dv = 1 - std::abs(double(s.uv.y) * 64 + 0.5 - row);
            ASSERT_GT(std::min(du, dv), -1e-4);
            estimates.push_back(std::max(du, 0.0) * std::max(dv, 0.0) / double(s.pdf));
        }
        auto const e = testing::estimate(estimates);
        // A twentieth of the radius of the sphere's row per texel, between cos theta and theta.
        EXPECT_LT(std::sqrt(e.variance * 20'000) / e.mean, 0.05) << row;
    }
}

} // namespace
} // namespace weft::lights
