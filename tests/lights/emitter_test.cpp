// Sampling of every emitter against its density, over whole directions.
#include <gtest/gtest.h>

#include "tests/lights/emitter_cases.h"

namespace weft::lights::testing {
namespace {

double const kAlpha = 0.01; // over each test's set of cases

Vec3d towards(EmitterSample const& s, Vec3 const& ref) { return Vec3d(s.p) - Vec3d(ref); }

struct BinIntegral {
    double value, variance;
};

/// The density over a bin by two jittered points in each of grid^2 cells, whose differences tell
/// the variance.
BinIntegral integrate(Case const& c, ConeBins const& bins, int b, int grid, Rng& rng) {
    std::vector<Hit> hits;
    double sum = 0, squares = 0;
    int const n = grid * grid;
    for (int k = 0; k < n; ++k) {
        double density[2]{};
        for (double& d : density) {
            double const x = (k / grid + double(rng.next())) / grid;
            double const y = (k % grid + double(rng.next())) / grid;
            Vec3d const w = bins.direction((b / ConeBins::kSectors + x) / ConeBins::kRings,
                                           (b % ConeBins::kSectors + y) / ConeBins::kSectors);
            hits.clear();
            c.intersect(Vec3d(c.ref), w, hits);
            for (Hit const& h : hits) d += double(pdf(c.emitter, c.ref, h));
        }
        sum += 0.5 * (density[0] + density[1]);
        squares += 0.25 * square(density[0] - density[1]);
    }
    double const weight = bins.solid_angle() / ConeBins::kCount / n;
    return {sum * weight, squares * weight * weight};
}

TEST(Emitter, directions_follow_the_density) {
    auto const cases = emitter_cases();
    double const level = weft::testing::sidak(kAlpha, int(cases.size()));
    int const samples = 200'000;
    double const evaluations = 1.5e6;
    for (Case const& c : cases) {
        SCOPED_TRACE(c.name);
        ConeBins const bins(c);
        std::vector<double> observed(ConeBins::kCount + 1), expected(ConeBins::kCount + 1);
        Rng rng(1);
        for (int i = 0; i < samples; ++i) {
            EmitterSample const s = sample(c.emitter, c.ref, rng.next2());
            int const bin = s.pdf > 0 ? bins.find(towards(s, c.ref)) : -1;
            ++observed[size_t(bin < 0 ? ConeBins::kCount : bin)];
        }
        // Where the density may be positive, as many evaluations as the time allows.
        std::vector<int> active;
        for (int b = 0; b < ConeBins::kCount; ++b)
            if (observed[size_t(b)] > 0 || integrate(c, bins, b, 12, rng).value > 0)
                active.push_back(b);
        int const grid = int(std::sqrt(evaluations / 2 / double(active.size())));
        double integral = 0, variance = 0;
        for (int b : active) {
            BinIntegral const bin = integrate(c, bins, b, grid, rng);
            double const count = bin.value * samples, unsure = bin.variance * samples * samples;
            expected[size_t(b)] = count;
            // What the expectation is unsure of adds to what the count may differ by.
            observed[size_t(b)] = count + (observed[size_t(b)] - count) *
                                              std::sqrt(count / std::max(count + unsure, 1e-300));
            integral += bin.value;
            variance += bin.variance;
        }
        double const z = (integral - 1) / std::sqrt(variance + 1e-12);
        EXPECT_GT(weft::testing::normal_tail(z), level) << "integral " << integral;
        auto const result = weft::testing::chi_square(observed, expected);
        EXPECT_GT(result.p_value, level)
            << result.problem << " chi2 " << result.statistic << " dof " << result.dof;
    }
}

TEST(Emitter, sample_and_pdf_agree) {
    for (Case const& c : emitter_cases()) {
        SCOPED_TRACE(c.name);
        Rng rng(2);
        double worst = 0;
        for (int i = 0; i < 20'000; ++i) {
            EmitterSample const s = sample(c.emitter, c.ref, rng.next2());
            ASSERT_GT(s.pdf, 0);
            float const p = pdf(c.emitter, c.ref, {Vec3d(s.p), Vec3d(s.n), s.primitive});
            worst = std::max(worst, std::abs(double(p) / double(s.pdf) - 1));
        }
        EXPECT_LT(worst, 1e-5);
    }
}

TEST(Emitter, samples_lie_on_the_surface_with_its_front_normal) {
    for (Case const& c : emitter_cases()) {
        SCOPED_TRACE(c.name);
        Rng rng(3);
        std::vector<Hit> hits;
        double worst_p = 0, worst_n = 0, worst_wi = 0, worst_distance = 0;
        int missed = 0;
        int const n = 20'000;
        for (int i = 0; i < n; ++i) {
            EmitterSample const s = sample(c.emitter, c.ref, rng.next2());
            Vec3d const d = towards(s, c.ref);
            worst_wi = std::max(worst_wi, length(Vec3d(s.wi) - normalize(d)));
            worst_distance = std::max(worst_distance, std::abs(double(s.distance) / length(d) - 1));
            // Along the normal, so that grazing directions do not magnify the rounding of p.
            hits.clear();
            c.intersect(Vec3d(s.p) + Vec3d(s.n) * 0.01, -Vec3d(s.n), hits);
            Hit const* hit = nullptr;
            for (Hit const& h : hits)
                if (h.primitive == s.primitive) hit = &h;
            if (!hit) {
                ++missed; // rounding moved it over an edge
                continue;
            }
            worst_p = std::max(worst_p, length(hit->p - Vec3d(s.p)));
            worst_n = std::max(worst_n, length(hit->n - Vec3d(s.n)));
        }
        EXPECT_LT(missed, n / 1000);
        EXPECT_LT(worst_p, 2e-6);
        EXPECT_LT(worst_n, 1e-5);
        EXPECT_LT(worst_wi, 5e-7);
        EXPECT_LT(worst_distance, 5e-7);
    }
}

TEST(Emitter, mirrored_transforms_keep_the_front) {
    // The transformed +z normal is A^-T z, whichever way A turns.
    Affine const mirrors[] = {scaling(-1, 1, 1), scaling(1, 1, -1), scaling(-1, -1, -1),
                              scaling(1, -1, 1)};
    Affine const turn = rotation({1, 2, -1}, 0.8f);
    for (Affine const& m : mirrors) {
        Affine const a = turn * m;
        Vec3 const front = normalize(a.inverse().transposed({0, 0, 1}));
        EXPECT_NEAR(dot(RectangleEmitter(a).normal(), front), 1, 1e-6);
        // The mesh: one triangle of the same square, whose flip says that A mirrors.
        MeshEmitter const mesh({a.point({-1, -1, 0}), a.point({1, -1, 0}), a.point({1, 1, 0})},
                               {{0, 1, 2}}, {}, a.determinant() < 0);
        EXPECT_NEAR(dot(mesh.sample({0, 0, 5}, {0.3f, 0.4f}, 0).n, front), 1, 1e-6);
        EXPECT_NEAR(dot(mesh.normal(0), front), 1, 1e-6);
        EXPECT_NEAR(dot(DiskEmitter(a).normal(), front), 1, 1e-6);
        // The sphere: outwards.
        EmitterSample const s = SphereEmitter(a).sample({3, 4, 5}, {0.3f, 0.4f});
        EXPECT_NEAR(dot(s.n, normalize(s.p)), 1, 1e-6);
    }
}

TEST(Emitter, texture_coordinates) {
    Affine const a = at({1, 2, 3}, rotation({1, 2, -1}, 0.8f)) * scaling(2, 0.5f, 1);
    Affined const inverse = Affined(a).inverse();
    Rng rng(4);
    for (int i = 0; i < 1000; ++i) {
        Vec2 const u = rng.next2();
        EmitterSample const r = RectangleEmitter(a).sample({4, -2, 5}, u);
        Vec3d const on_square = inverse.point(Vec3d(r.p));
        EXPECT_NEAR(on_square.x, 2 * r.uv.x - 1, 2e-6);
        EXPECT_NEAR(on_square.y, 2 * r.uv.y - 1, 2e-6);
        EmitterSample const d = DiskEmitter(a).sample({4, -2, 5}, u);
        Vec3d const on_disk = inverse.point(Vec3d(d.p));
        EXPECT_NEAR(on_disk.x, 2 * d.uv.x - 1, 2e-6);
        EXPECT_NEAR(on_disk.y, 2 * d.uv.y - 1, 2e-6);
        EmitterSample const s = SphereEmitter(a).sample({4, -2, 5}, u);
        Vec3d const on_sphere = inverse.point(Vec3d(s.p));
        EXPECT_NEAR(on_sphere.y, std::cos(double(s.uv.y) * kTau / 2), 2e-6);
        double const phi = (0.5 - double(s.uv.x)) * kTau;
        double const around = std::hypot(on_sphere.x, on_sphere.z);
        EXPECT_NEAR(on_sphere.x, around * std::cos(phi), 4e-6);
        EXPECT_NEAR(on_sphere.z, around * std::sin(phi), 4e-6);
    }
    // A mesh interpolates what it is given.
    MeshEmitter const mesh({{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}, {{0, 1, 2}},
                           {{0.5f, 0.1f}, {0.9f, 0.1f}, {0.5f, 0.7f}});
    EmitterSample const s = mesh.sample({0, 0, 1}, {0.6f, 0.3f}, 0);
    EXPECT_NEAR(s.uv.x, 0.5f + 0.4f * s.p.x / 2, 1e-6);
    EXPECT_NEAR(s.uv.y, 0.1f + 0.6f * s.p.y / 3, 1e-6);
}

TEST(Emitter, degenerate_shapes_are_never_sampled) {
    Vec3 const ref{1, 2, 3};
    for (Affine const& flat : {scaling(0, 1, 1), scaling(1, 0, 1), scaling(0, 0, 0)}) {
        EXPECT_EQ(RectangleEmitter(flat).sample(ref, {0.3f, 0.6f}).pdf, 0);
        EXPECT_EQ(RectangleEmitter(flat).area(), 0);
        EXPECT_EQ(DiskEmitter(flat).sample(ref, {0.3f, 0.6f}).pdf, 0);
        EXPECT_EQ(DiskEmitter(flat).pdf(ref, {0, 0, 0}, {0, 0, 1}), 0);
        EXPECT_EQ(SphereEmitter(flat).sample(ref, {0.3f, 0.6f}).pdf, 0);
        EXPECT_EQ(SphereEmitter(flat).pdf(ref, {0, 0, 0}, {0, 0, 1}), 0);
    }
    // A rectangle needs no depth, and keeps the side of +z.
    RectangleEmitter const paper(scaling(1, 1, 0));
    EXPECT_GT(paper.sample(ref, {0.3f, 0.6f}).pdf, 0);
    EXPECT_EQ(paper.normal(), Vec3(0, 0, 1));
    DiskEmitter const plate(scaling(1, 1, 0));
    EXPECT_GT(plate.sample(ref, {0.3f, 0.6f}).pdf, 0);
    EXPECT_EQ(plate.normal(), Vec3(0, 0, 1));
    EXPECT_EQ(plate.sample({3, 1, 0}, {0.3f, 0.6f}).pdf, 0);
    // Edge-on there is no solid angle.
    EXPECT_EQ(paper.sample({3, 1, 0}, {0.3f, 0.6f}).pdf, 0);
    MeshEmitter const mesh({{1, 1, 1}, {2, 2, 2}}, {{0, 1, 1}});
    EXPECT_EQ(mesh.sample(ref, {0.3f, 0.6f}, 0).pdf, 0);
    EXPECT_EQ(mesh.pdf(ref, {1, 1, 1}, {0, 0, 1}, 0), 0);
    EXPECT_EQ(MeshEmitter({}, {}).area(), 0);
}

TEST(Emitter, corners_of_the_unit_square_are_safe) {
    float const ends[] = {0, 0x1p-24f, 0.5f, kOneMinusEpsilon};
    for (Case const& c : emitter_cases()) {
        SCOPED_TRACE(c.name);
        for (float x : ends)
            for (float y : ends) {
                EmitterSample const s = sample(c.emitter, c.ref, {x, y});
                EXPECT_TRUE(std::isfinite(s.pdf) && s.pdf > 0);
                EXPECT_TRUE(is_finite(s.p) && is_finite(s.n) && is_finite(s.wi));
                EXPECT_TRUE(s.uv.x >= 0 && s.uv.x <= 1 && s.uv.y >= 0 && s.uv.y <= 1);
                EXPECT_NEAR(length(s.n), 1, 1e-6);
            }
    }
}

} // namespace
} // namespace weft::lights::testing
