// Solid angles and densities against closed forms.
#include <gtest/gtest.h>

#include "base/warp.h"
#include "tests/lights/emitter_cases.h"

namespace weft::lights::testing {
namespace {

double const kAlpha = 0.01;

/// Solid angle of [xa, xb] x [ya, yb] at distance z from the origin: the sum over its corners of
/// atan(x y / (z r)), in long double so that what cancels is not missed.
double exact_solid_angle(long double xa, long double xb, long double ya, long double yb,
                         long double z) {
    auto const corner = [z](long double x, long double y) {
        return std::atan2(x * y, z * std::sqrt(x * x + y * y + z * z));
    };
    return double(corner(xb, yb) - corner(xa, yb) - corner(xb, ya) + corner(xa, ya));
}

struct Seen { // the rectangle [-1, 1] x [-height, height] from ref
    char const* name;
    float height;
    Vec3 ref;
};

Seen const kSeen[] = {
    {"above", 1, {0.2f, -0.3f, 1}},
    {"below", 0.5f, {0.2f, -0.3f, -2}},
    {"near", 1, {0.2f, -0.3f, 1e-3f}},
    {"very near", 1, {0.9f, 0.9f, 1e-5f}},
    {"near an edge", 1, {0.9999f, 0.2f, 1e-3f}},
    {"over a corner", 1, {1, 1, 0.5f}},
    {"beside", 1, {5, 0.3f, 0.7f}},
    {"grazing", 1, {1.5f, 0.2f, 1e-4f}},
    {"grazing along y", 0.3f, {0.2f, 1.5f, 1e-4f}},
    {"far", 1, {30, -60, 80}},
    {"far on the axis", 0.1f, {0, 0, 400}},
    {"far and grazing", 1, {100, -20, 0.3f}},
    {"thin", 1e-3f, {0.4f, 0.2f, 0.8f}},
    {"thin and far", 1e-3f, {14, 12, 18}},
    {"very thin", 1e-5f, {0.4f, 0.02f, 0.08f}},
};

TEST(Rectangle, solid_angle_is_exact) {
    double worst = 0;
    for (Seen const& s : kSeen) {
        SCOPED_TRACE(s.name);
        double const exact =
            exact_solid_angle(-1.L - s.ref.x, 1.L - s.ref.x, -(long double)s.height - s.ref.y,
                              (long double)s.height - s.ref.y, std::abs(s.ref.z));
        float const omega = RectangleEmitter(scaling(1, s.height, 1)).solid_angle(s.ref);
        double const error = std::abs(double(omega) / exact - 1);
        worst = std::max(worst, error);
        EXPECT_LT(error, 1e-6) << omega << " for " << exact;
    }
    RecordProperty("worst_relative_error", std::to_string(worst));
    // A plane seen from its surface fills a hemisphere; a cube's face a sixth of the sphere.
    EXPECT_NEAR(RectangleEmitter(scaling(1e4f, 1e4f, 1)).solid_angle({0, 0, 0.01f}), kTau, 1e-5);
    EXPECT_NEAR(RectangleEmitter(Affine()).solid_angle({0, 0, 1}), kTau / 3, 1e-6);
    EXPECT_EQ(RectangleEmitter(Affine()).solid_angle({3, 0, 0}), 0);
}

TEST(Rectangle, solid_angle_by_counting_directions) {
    Affine const a = at({0.2f, 0.1f, 0.9f}, rotation({1, 2, 3}, 0.7f)) * scaling(1.2f, 0.8f, 1);
    Vec3 const ref{0.3f, -0.2f, -0.4f};
    Intersect const intersect = rectangle_hits(a);
    Rng rng(1);
    int const n = 1'000'000;
    int count = 0;
    std::vector<Hit> hits;
    for (int i = 0; i < n; ++i) {
        double const z = 1 - 2 * double(rng.next()), phi = kTau * double(rng.next());
        double const r = std::sqrt(1 - z * z);
        hits.clear();
        intersect(Vec3d(ref), {r * std::cos(phi), r * std::sin(phi), z}, hits);
        count += int(hits.size());
    }
    double const p = double(RectangleEmitter(a).solid_angle(ref)) / (2 * kTau);
    double const z = (count - n * p) / std::sqrt(n * p * (1 - p));
    EXPECT_GT(weft::testing::normal_tail(z), kAlpha) << z;
}

/// Near rectangles by solid angle, far ones by area.
TEST(Rectangle, parts_are_hit_in_proportion_to_their_size) {
    int const parts = 10, samples = 1'000'000;
    double const level = weft::testing::sidak(kAlpha, int(std::size(kSeen)));
    for (Seen const& s : kSeen) {
        SCOPED_TRACE(s.name);
        // The parts are not all of one size: most are small and crowd around the point below ref.
        auto const cut = [&](int i, double around, double half) {
            double const t = 2.0 * i / parts - 1;
            double const c = std::clamp(around, -half, half);
            return t < 0 ? c + (half + c) * t * t * t : c + (half - c) * t * t * t;
        };
        std::vector<double> xs, ys;
        for (int i = 0; i <= parts; ++i) {
            xs.push_back(cut(i, double(s.ref.x), 1));
            ys.push_back(cut(i, double(s.ref.y), double(s.height)));
        }
        RectangleEmitter const light(scaling(1, s.height, 1));
        bool const far = is_far(1 + square(double(s.height)), length_squared(Vec3d(s.ref)));
        auto const size = [&](double x0, double x1, double y0, double y1) {
            if (far) return (x1 - x0) * (y1 - y0);
            return exact_solid_angle(x0 - (long double)s.ref.x, x1 - (long double)s.ref.x,
                                     y0 - (long double)s.ref.y, y1 - (long double)s.ref.y,
                                     std::abs(s.ref.z));
        };
        double const whole = size(xs[0], xs.back(), ys[0], ys.back());
        std::vector<double> observed(parts * parts), expected(parts * parts);
        for (int i = 0; i < parts * parts; ++i) {
            auto const x = size_t(i % parts), y = size_t(i / parts);
            expected[size_t(i)] = samples / whole * size(xs[x], xs[x + 1], ys[y], ys[y + 1]);
        }
        auto const find = [](std::vector<double> const& edges, double v) {
            auto const it = std::upper_bound(edges.begin() + 1, edges.end() - 1, v);
            return size_t(it - edges.begin() - 1);
        };
        Rng rng(5);
        for (int i = 0; i < samples; ++i) {
            Vec3 const p = light.sample(s.ref, rng.next2()).p;
            // Parts without width lie on the border: a point there counts for the one inside.
            double const inward = 1 - 1e-7;
            ++observed[find(ys, p.y * inward) * parts + find(xs, p.x * inward)];
        }
        auto const result = weft::testing::chi_square(observed, expected);
        EXPECT_GT(result.p_value, level)
            << result.problem << " chi2 " << result.statistic << " dof " << result.dof;
        EXPECT_GE(result.dof, 20);
    }
}

TEST(Rectangle, density_from_afar_is_one_over_the_solid_angle) {
    // Also where the solid angle is below what is sampled as such from nearby.
    RectangleEmitter const light{Affine()};
    for (float z : {1500.f, 1990.f, 2010.f, 1e4f, 1e6f}) {
        EmitterSample const s = light.sample({0, 0, z}, {0.7f, 0.2f});
        double const exact = exact_solid_angle(-1, 1, -1, 1, z);
        EXPECT_NEAR(double(s.pdf) * exact, 1, 1e-5) << z;
    }
}

TEST(Sphere, density_is_one_over_the_solid_angle) {
    for (float radius : {1e-3f, 1.f, 50.f})
        for (double beyond : {1e-4, 1e-3, 0.1, 1.0, 30.0, 1e5, 1e7}) {
            SphereEmitter const light(scaling(radius, radius, radius));
            // From the floats that are given, as the rounding of ref is no error of the sampler.
            float const d = float(double(radius) * (1 + beyond));
            double const s2 = square(radius) / (double(d) * d);
            double const exact =
                kTau * s2 / (1 + std::sqrt(1 - double(radius) * radius / (double(d) * d)));
            EmitterSample const s = light.sample({0, -d, 0}, {0.3f, 0.2f});
            EXPECT_NEAR(double(s.pdf) * exact, 1, 2e-6) << radius << ' ' << beyond;
        }
    SphereEmitter const around(scaling(3, 3, 3));
    EXPECT_NEAR(around.sample({1, 0.5f, -2}, {0.3f, 0.6f}).pdf, 1 / (2 * kTau), 1e-7);
}

TEST(Sphere, far_side_is_not_sampled_from_outside) {
    SphereEmitter const light{Affine()};
    EXPECT_GT(light.pdf({0, 0, 3}, {0, 0, 1}, {0, 0, 1}), 0);
    EXPECT_EQ(light.pdf({0, 0, 3}, {0, 0, -1}, {0, 0, -1}), 0);
    EXPECT_GT(light.pdf({0, 0, 0.3f}, {0, 0, -1}, {0, 0, -1}), 0);
}

TEST(Emitter, areas) {
    Affine const a({1, 0.2f, 0}, {0.7f, 0.9f, 0.1f}, {0.2f, -0.3f, 1.1f}, {0.1f, 0.2f, 0.3f});
    EXPECT_NEAR(RectangleEmitter(a).area(), 4 * length(cross(a.x, a.y)), 1e-5);
    EXPECT_NEAR(SphereEmitter(rotation({1, 2, 3}, 1) * scaling(2, 2, 2)).area(), 8 * kTau, 1e-4);
    // A spheroid of semi-axes 1, 1, c: prolate for 2, oblate for 1/2.
    double const e = std::sqrt(0.75);
    EXPECT_NEAR(SphereEmitter(scaling(1, 2, 1)).area(), kTau * (1 + 2 / e * std::asin(e)), 2e-3);
    EXPECT_NEAR(SphereEmitter(scaling(1, 1, 0.5f)).area(), kTau * (1 + 0.25 / e * std::atanh(e)),
                1e-3);
    std::vector<Vec3> p;
    std::vector<MeshEmitter::Triangle> t;
    cube(scaling(0.5f, 1, 1.5f), p, t);
    MeshEmitter const mesh(p, t);
    EXPECT_NEAR(mesh.area(), 22, 1e-5);
    EXPECT_NEAR(length(mesh.centre()), 0, 1e-6);
}

TEST(Disk, density_is_nearly_constant) {
    // From afar by area: the cube of the distances to the ends of a sphere around it.
    double const reach = std::sqrt(kFarRadius2);
    double const far_bound = std::pow((1 + reach) / (1 - reach), 3.0) * (1 + 1e-5);
    double const bound = (1 + std::sqrt(2.0)) / 2 * (1 + 1e-5);
    Rng rng(5);
    for (int k = 0; k < 3000; ++k) {
        Affine const a({1, 0, 0}, {rng.next() * 2 - 1, std::exp(-8 * rng.next()), 0}, {0, 0, 1},
                       {0, 0, 0});
        DiskEmitter const disk(a);
        Vec2 const beside = square_to_disk(rng.next2()) * std::exp(6 * rng.next() - 3);
        Vec3 const ref = a.point({beside.x, beside.y, 0}) + Vec3(0, 0, std::exp(-9 * rng.next()));
        double low = std::numeric_limits<double>::infinity(), high = 0;
        for (int i = 0; i < 200; ++i) {
            double const pdf = double(disk.sample(ref, rng.next2()).pdf);
            low = std::min(low, pdf);
            high = std::max(high, pdf);
        }
        double const middle = 0.5 * double(1 + length_squared(a.y));
        double const largest2 =
            middle + std::sqrt(square(1 - middle) + square(double(dot(a.x, a.y))));
        bool const far = is_far(largest2, length_squared(Vec3d(ref))), edge_on = high > 0.9e6;
        EXPECT_TRUE(edge_on || high / low < (far ? far_bound : bound)) << high / low << a.y << ref;
    }
}

TEST(Disk, of_a_circular_cone_is_uniform) {
    for (float height : {0.01f, 0.3f, 1.f, 2.5f}) {
        double const exact = kTau * (1 - height / std::hypot(1.0, double(height)));
        for (Vec2 u : {Vec2(0, 0), Vec2(0.3f, 0.8f), Vec2(0.999f, 0.4f)})
            EXPECT_NEAR(DiskEmitter(Affine()).sample({0, 0, height}, u).pdf * exact, 1, 2e-5)
                << height;
    }
}

TEST(Disk, from_afar_is_sampled_by_area) {
    for (float height : {2.6f, 10.f, 30.f})
        for (Vec2 u : {Vec2(0, 0), Vec2(0.3f, 0.8f), Vec2(0.999f, 0.4f)}) {
            EmitterSample const s = DiskEmitter(Affine()).sample({0, 0, height}, u);
            double const d2 = length_squared(Vec3d(s.p) - Vec3d(0, 0, double(height)));
            double const exact = d2 * std::sqrt(d2) / (0.5 * kTau * double(height));
            EXPECT_NEAR(s.pdf / exact, 1, 1e-6) << height;
        }
}

} // namespace
} // namespace weft::lights::testing
