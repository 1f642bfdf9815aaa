// The emitters and reference points over which the emitter tests run. Rectangles thinner or more
// grazing than the bins resolve are held to exact solid angles in closed_forms_test.cpp.
#pragma once

#include "base/match.h"
#include "lights/area_sampling.h"
#include "tests/lights/emitter_checks.h"

namespace weft::lights::testing {

inline Affine rotation(Vec3 axis, float angle) {
    axis = normalize(axis);
    float const c = std::cos(angle), s = std::sin(angle);
    auto const turn = [&](Vec3 v) {
        return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
    };
    return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1}), Vec3(0)};
}
inline Affine scaling(float x, float y, float z) {
    return {{x, 0, 0}, {0, y, 0}, {0, 0, z}, {0, 0, 0}};
}
inline Affine at(Vec3 const& p, Affine a) {
    a.origin = p;
    return a;
}

/// The six faces of the cube [-1, 1]^3, triangles counter-clockwise from outside, transformed.
inline void cube(Affine const& m, std::vector<Vec3>& positions,
                 std::vector<MeshEmitter::Triangle>& triangles) {
    for (int i = 0; i < 8; ++i)
        positions.push_back(m.point({i & 1 ? 1.f : -1.f, i & 2 ? 1.f : -1.f, i & 4 ? 1.f : -1.f}));
    triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
}

inline std::vector<Case> emitter_cases() {
    std::vector<Case> cases;
    auto const extent = [](Affine const& a) { // of the image of [-1, 1]^3
        return double(length(a.x) + length(a.y) + length(a.z));
    };
    auto const rectangle = [&](char const* name, Affine const& a, Vec3 const& ref) {
        double const r = double(length(a.x) + length(a.y));
        cases.push_back({name, RectangleEmitter(a), rectangle_hits(a), ref, r});
    };
    auto const sphere = [&](char const* name, Affine const& a, Vec3 const& ref, double r) {
        cases.push_back({name, SphereEmitter(a), sphere_hits(a), ref, r});
    };
    auto const box = [&](char const* name, Affine const& a, Vec3 const& ref) {
        std::vector<Vec3> p;
        std::vector<MeshEmitter::Triangle> t;
        cube(a, p, t);
        bool const flip = a.determinant() < 0;
        cases.push_back({name, MeshEmitter(p, t, {}, flip), mesh_hits(p, t, flip), ref, extent(a)});
    };
    auto const disk = [&](char const* name, Affine const& a, Vec3 const& ref) {
        double const r = double(length(a.x) + length(a.y));
        cases.push_back({name, DiskEmitter(a), disk_hits(a), ref, r});
    };
    auto const triangle = [&](char const* name, Affine const& a, Vec3 const& ref) {
        std::vector<Vec3> const p{a.point({-1, -1, 0}), a.point({1, -1, 0}), a.point({0, 1, 0})};
        std::vector<MeshEmitter::Triangle> const t{{0, 1, 2}};
        bool const flip = a.determinant() < 0;
        double const r = double(length(a.x) + length(a.y));
        cases.push_back({name, MeshEmitter(p, t, {}, flip), mesh_hits(p, t, flip), ref, r});
    };
    Affine const turned = at({0.3f, -0.2f, 0.5f}, rotation({1, 2, 3}, 1.1f));
    Affine const slab = turned * scaling(1.5f, 0.4f, 2);
    Affine const mirror = turned * scaling(-1, 0.7f, 1);
    Affine const shear({1, 0.2f, 0}, {0.7f, 0.9f, 0.1f}, {0.2f, -0.3f, 1.1f}, {0.1f, 0.2f, 0.3f});
    Affine const mirror_shear = shear * scaling(1, 1, -1);
    Vec3 const side{1.2f, -0.8f, 2.1f};

    rectangle("rectangle", Affine(), {0.3f, 0.2f, 1.5f});
    rectangle("rectangle behind", Affine(), {0.3f, 0.2f, -1.5f});
    rectangle("rectangle turned", slab, side);
    rectangle("rectangle mirrored", mirror, side);
    rectangle("rectangle near", slab, slab.point({0.2f, -0.6f, 5e-4f}));
    rectangle("rectangle grazing", slab, slab.point({2.5f, 0.3f, 0.05f}));
    rectangle("rectangle far", slab, side * 200.f);
    rectangle("rectangle very far", slab, side * 1e5f);
    rectangle("tube light", scaling(1, 0.02f, 1), {0.5f, 0.4f, 0.8f});
    rectangle("parallelogram", shear, side);
    rectangle("parallelogram mirrored", mirror_shear, {-1, 0.6f, -1.4f});
    rectangle("parallelogram near", shear, shear.point({0.4f, 0.1f, 0.05f}));
    rectangle("parallelogram grazing", shear, shear.point({2.5f, 0.1f, 0.05f}));
    rectangle("parallelogram very near", shear, shear.point({-0.9f, 0.95f, 1e-3f}));
    rectangle("parallelogram far", shear, side * 1e5f);

    // Either side of the distance from which emitters are sampled by area.
    auto const border = [](double radius2, double part) {
        return Vec3(normalize(Vec3d(0.5, 0.4, 0.6)) * (part * std::sqrt(radius2 / kFarRadius2)));
    };
    rectangle("rectangle, just near", Affine(), border(2, 0.99));
    rectangle("rectangle, just far", Affine(), border(2, 1.01));
    rectangle("rectangle grazing, just far", Affine(), Vec3(0.8f, 0.6f, 0.05f) * 3.7f);
    disk("disk, just near", Affine(), border(1, 0.99));
    disk("disk, just far", Affine(), border(1, 1.01));
    disk("disk grazing, just far", Affine(), Vec3(0.8f, 0.6f, 0.05f) * 2.65f);
    triangle("triangle, just near", Affine(), {0, 0, 3.1f});
    triangle("triangle, just far", Affine(), {0, 0, 3.4f});

    disk("disk", Affine(), {0.3f, 0.2f, 1.5f});
    disk("disk on its axis", Affine(), {0, 0, 0.8f});
    disk("disk behind", Affine(), {0.3f, 0.2f, -1.5f});
    disk("disk near", turned, turned.point({0.2f, -0.6f, 5e-4f}));
    disk("disk near its edge", turned, turned.point({0.6f * 0.999f, 0.8f * 0.999f, 2e-3f}));
    disk("disk beyond its edge", turned, turned.point({0.6f * 1.01f, 0.8f * 1.01f, 5e-3f}));
    disk("disk grazing", turned, turned.point({2.5f, 0.3f, 0.05f}));
    disk("disk far", turned, side * 20.f);
    disk("disk very far", turned, side * 1e5f);
    disk("ellipse", slab, side);
    disk("ellipse mirrored", mirror, side);
    disk("ellipse near", slab, slab.point({0.2f, -0.6f, 5e-4f}));
    disk("ellipse grazing", slab, slab.point({0.5f, 2.4f, 0.05f}));
    disk("ellipse sheared", shear, side);
    disk("ellipse sheared and mirrored", mirror_shear, {-1, 0.6f, -1.4f});
    disk("ellipse sheared, near", shear, shear.point({0.4f, 0.1f, 0.02f}));
    disk("ellipse sheared, grazing", shear, shear.point({2.5f, 0.1f, 0.05f}));
    disk("ellipse sheared, far", mirror_shear, side * 1e3f);

    triangle("triangle", turned, side);
    triangle("triangle mirrored", mirror_shear, side);
    triangle("triangle near", shear, shear.point({0.1f, 0.2f, 1e-3f}));
    triangle("triangle near a corner", shear, shear.point({-0.999f, -0.999f, 2e-3f}));
    triangle("triangle grazing", slab, slab.point({2.5f, 0.3f, 0.05f}));
    triangle("triangle at the border of far", turned, side * 6.f);
    triangle("triangle far", mirror, side * 1e4f);

    sphere("sphere", Affine(), side, 1);
    sphere("sphere turned", turned * scaling(0.5f, 0.5f, 0.5f), side, 0.5);
    sphere("sphere far", Affine(), {200, -300, 100}, 1);
    sphere("sphere very far", Affine(), {6e4f, -8e4f, 1e3f}, 1);
    sphere("sphere near", Affine(), {0, 0.6f * 1.001f, -0.8f * 1.001f}, 1);
    sphere("sphere touching", Affine(), {0, 0, 1.00001f}, 1);
    sphere("sphere inside", Affine(), {0.3f, -0.2f, 0.5f}, 1);
    sphere("sphere just inside", Affine(), {0.6f * 0.999f, 0, 0.8f * 0.999f}, 1);
    sphere("sphere at centre", scaling(2, 2, 2), {0, 0, 0}, 2);
    sphere("ellipsoid", slab, {2.5f, -0.8f, 2.1f}, 2);
    sphere("ellipsoid near", slab, slab.point({0.6f * 1.01f, 0.8f * 1.01f, 0}), 2);
    sphere("ellipsoid inside", slab, slab.point({0.4f, -0.1f, 0.6f}), 2);
    sphere("ellipsoid sheared", shear, {2, -1.5f, 2.1f}, 2);
    sphere("ellipsoid mirrored", mirror_shear, {-2, 1.5f, 1.1f}, 2);
    sphere("ellipsoid far", mirror_shear, {-2e4f, 1.5e4f, 1e3f}, 2);

    box("mesh", slab, {3.1f, -2.8f, 2.1f});
    box("mesh mirrored", mirror, {2.1f, -1.8f, 2.1f});
    box("mesh sheared", mirror_shear, {-2.5f, 1.9f, 1.1f});
    box("mesh inside", slab, slab.point({0.2f, -0.3f, 0.4f}));
    box("mesh far", slab, {3e4f, -2e4f, 2e4f});
    return cases;
}

} // namespace weft::lights::testing
