// Irradiance on a surface, estimated with the emitters' samples, against closed forms: what the
// density is for. One false constant anywhere shows here.
#include <gtest/gtest.h>

#include "tests/lights/emitter_cases.h"

namespace weft::lights::testing {
namespace {

double const kAlpha = 0.01;

/// Estimates of the irradiance at ref on the plane with normal `up` from radiance 1 on the front.
weft::testing::Estimate irradiance(Emitter const& e, Vec3 const& ref, Vec3 const& up, int n) {
    std::vector<double> values;
    Rng rng(11);
    for (int i = 0; i < n; ++i) {
        EmitterSample const s = sample(e, ref, rng.next2());
        bool const lit = s.pdf > 0 && dot(s.n, s.wi) < 0;
        values.push_back(lit ? std::max(0.0, double(dot(up, s.wi))) / double(s.pdf) : 0);
    }
    return weft::testing::estimate(values);
}

/// Lambert 1760: 1/2 sum of (angle of an edge) x (cosine of its plane's normal), for a polygon
/// above the horizon whose vertices turn counter-clockwise as seen from ref.
double polygon_irradiance(std::vector<Vec3d> const& vertices, Vec3 const& ref, Vec3 const& up) {
    double sum = 0;
    for (size_t i = 0; i < vertices.size(); ++i) {
        Vec3d const a = normalize(vertices[i] - Vec3d(ref));
        Vec3d const b = normalize(vertices[(i + 1) % vertices.size()] - Vec3d(ref));
        Vec3d const c = cross(a, b);
        double const s = length(c);
        sum += std::atan2(s, dot(a, b)) / s * dot(c, Vec3d(up));
    }
    return std::abs(sum) / 2;
}

TEST(Irradiance, of_parallelograms) {
    struct {
        char const* name;
        Affine to_world;
    } const lights[] = {
        {"facing", {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0.3f, 0.2f, 1}}},
        {"small", {{0.01f, 0, 0}, {0, -0.02f, 0}, {0, 0, -1}, {1, 0.2f, 1}}},
        {"low wall", {{0, 1, 0}, {0, 0, 0.5f}, {1, 0, 0}, {-1.5f, 0.2f, 0.51f}}},
        {"mirrored wall", {{0, -1, 0}, {0, 0, 0.5f}, {1, 0, 0}, {-1.5f, 0.2f, 0.51f}}},
        {"close", {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1e-2f}}},
        {"sheared", {{1, 0.2f, 0.1f}, {0.6f, -0.8f, 0.1f}, {0, 0.1f, -1}, {0.3f, 0.2f, 0.7f}}},
        {"far", {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {3e3f, 2e3f, 5e3f}}},
    };
    double const level = weft::testing::sidak(kAlpha, int(std::size(lights)));
    Vec3 const ref{0, 0, 0}, up{0, 0, 1};
    for (auto const& light : lights) {
        SCOPED_TRACE(light.name);
        std::vector<Vec3d> corners;
        for (auto [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            corners.push_back(Affined(light.to_world).point(Vec3d(x, y, 0)));
        double const exact = polygon_irradiance(corners, ref, up);
        auto const e = irradiance(RectangleEmitter(light.to_world), ref, up, 400'000);
        // 1e-6 for the floats: where all samples have one value they have no noise.
        double const sigma = std::sqrt(e.variance) + 1e-6 * exact;
        EXPECT_GT(weft::testing::normal_tail((e.mean - exact) / sigma), level)
            << e.mean << " for " << exact;
        // The back is dark.
        Affine const turned = light.to_world * rotation({1, 0, 0}, kPi);
        EXPECT_EQ(irradiance(RectangleEmitter(turned), ref, up, 1000).mean, 0);
        // The same square as a mesh.
        std::vector<Vec3> positions;
        for (Vec3d const& c : corners) positions.push_back(Vec3(c));
        MeshEmitter const mesh(positions, {{0, 1, 2}, {0, 2, 3}}, {},
                               light.to_world.determinant() < 0);
        auto const m = irradiance(mesh, ref, up, 400'000);
        double const mesh_sigma = std::sqrt(m.variance) + 1e-6 * exact;
        EXPECT_GT(weft::testing::normal_tail((m.mean - exact) / mesh_sigma), level / 2)
            << m.mean << " for " << exact;
    }
}

TEST(Irradiance, of_spheres) {
    // pi (r / d)^2 cos for a sphere wholly above the horizon.
    struct {
        float radius;
        Vec3 position;
    } const lights[] = {{1, {0, 0, 2}},       {1, {3, 2, 1.5f}},      {0.5f, {0, 0, 0.5005f}},
                        {2, {1, 0.5f, 2.1f}}, {1e-3f, {10, -20, 30}}, {1, {3e4f, 4e4f, 8e4f}}};
    double const level = weft::testing::sidak(kAlpha, int(std::size(lights)));
    for (auto const& light : lights) {
        SCOPED_TRACE(light.position);
        Affine const a = at(light.position, rotation({1, 2, 3}, 1) *
                                                scaling(light.radius, light.radius, light.radius));
        double const d2 = length_squared(Vec3d(light.position));
        double const exact =
            kTau / 2 * square(light.radius) / d2 * (double(light.position.z) / std::sqrt(d2));
        auto const e = irradiance(SphereEmitter(a), {0, 0, 0}, {0, 0, 1}, 400'000);
        double const sigma = std::sqrt(e.variance) + 2e-6 * exact;
        EXPECT_GT(weft::testing::normal_tail((e.mean - exact) / sigma), level)
            << e.mean << " for " << exact;
    }
}

TEST(Irradiance, of_disks) {
    // On a surface parallel to the disk, beside its axis (Howell, A Catalog of Radiation Heat
    // Transfer Configuration Factors, B-12): pi / 2 (1 - (d^2 - r^2) / root).
    struct {
        float radius, height, beside;
    } const lights[] = {{1, 1, 0}, {1, 0.2f, 0.9f}, {0.5f, 2, 3}, {1, 0.01f, 0.5f}, {1, 40, 30}};
    double const level = weft::testing::sidak(kAlpha, int(std::size(lights)));
    for (auto const& light : lights) {
        SCOPED_TRACE(light.height);
        double const r2 = square(light.radius), h2 = square(light.height),
                     a2 = square(light.beside), sum = a2 + h2 + r2;
        double const exact = kTau / 4 * (1 - (a2 + h2 - r2) / std::sqrt(sum * sum - 4 * a2 * r2));
        Affine const down({light.radius, 0, 0}, {0, -light.radius, 0}, {0, 0, -1},
                          {0.6f * light.beside, 0.8f * light.beside, light.height});
        auto const e = irradiance(DiskEmitter(down), {0, 0, 0}, {0, 0, 1}, 400'000);
        double const sigma = std::sqrt(e.variance) + 2e-6 * exact;
        EXPECT_GT(weft::testing::normal_tail((e.mean - exact) / sigma), level)
            << e.mean << " for " << exact;
    }
}

TEST(Irradiance, of_ellipsoids_and_meshes_by_rays) {
    double const level = weft::testing::sidak(kAlpha, int(emitter_cases().size()));
    int const n = 400'000;
    for (Case const& c : emitter_cases()) {
        SCOPED_TRACE(c.name);
        Vec3 const up = normalize(Vec3(0.3f, -0.2f, 0.9f));
        ConeBins const cone(c);
        std::vector<double> values;
        std::vector<Hit> hits;
        Rng rng(12);
        for (int i = 0; i < n; ++i) {
            Vec3d const d = cone.direction(double(rng.next()), double(rng.next()));
            hits.clear();
            c.intersect(Vec3d(c.ref), d, hits);
            double lit = 0; // as the estimator, which sees through what is in front
            for (Hit const& h : hits) lit += dot(h.n, d) < 0;
            values.push_back(lit * std::max(0.0, dot(Vec3d(up), d)) * cone.solid_angle());
        }
        auto const by_rays = weft::testing::estimate(values);
        auto const by_samples = irradiance(c.emitter, c.ref, up, n);
        if (by_rays.mean == 0 && by_samples.mean == 0) continue;
        double const z =
            (by_rays.mean - by_samples.mean) / std::sqrt(by_rays.variance + by_samples.variance);
        EXPECT_GT(weft::testing::normal_tail(z), level)
            << by_samples.mean << " for " << by_rays.mean;
    }
}

} // namespace
} // namespace weft::lights::testing
