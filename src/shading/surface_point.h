// A point on a surface, as materials see it.
#pragma once

#include <optional>

#include "base/affine.h"
#include "base/frame.h"
#include "scene/mesh.h"
#include "shading/footprint.h"

namespace weft::shading {

/// Properties of a mesh's vertices, by the numbers that the graph compiler gave their names.
struct VertexAttributes {
    struct Column {
        float const* values = nullptr; ///< of vertex 0; null where the mesh has none
        int components = 0;
    };
    scene::Mesh const* mesh = nullptr;
    std::vector<Column> columns;
};

struct SurfacePoint {
    Vec3 p{0, 0, 0};       ///< world space
    Vec3 p_error{0, 0, 0}; ///< how far each coordinate of p may lie from the true surface
    Vec3 ng{0, 0, 1};      ///< unit geometric normal of the front
    Vec3 ns{0, 0, 1};      ///< unit shading normal of the front
    /// From p to the smooth surface that the mesh stands for, on wo's side. 0 where that is not
    /// seen from the front, is no further out, or where nothing looks at it.
    Vec3 lift{0, 0, 0};
    Vec3 smooth_normal{0, 0, 1}; ///< of that surface, unit, of the front: `ns` before normal maps
    Vec3 wo{0, 0, 1};            ///< unit, to where the point is seen from
    Vec3 dpdu{0, 0, 0}; ///< change of p with u; 0 where there are no uvs or nothing looks at it
    Vec3 dpdv{0, 0, 0}; ///< change of p with v, likewise
    Vec2 uv{0, 0};
    UvFootprint footprint;  ///< of the ray that met it; 0 where no texture asks for it
    float t = 0;            ///< distance from the ray's origin in units of its direction
    uint32_t object = 0;    ///< which object of the world
    uint32_t primitive = 0; ///< which triangle of it
    Vec2 barycentric{0, 0}; ///< of the triangle's vertices 1 and 2
    float time = 0;         ///< in [0, 1] of the shutter interval
    /// Of the object; none: the same as the world's, or nothing looks at it.
    std::optional<ObjectSpace> space;
    VertexAttributes const* attributes = nullptr;
};

inline Vec3 object_position(SurfacePoint const& s) {
    return s.space ? s.space->to_object.point(s.p) : s.p;
}

/// Tangents around `normal`, as normal maps mean them: s along growing u, t on the side to which v
/// grows. Mirrored uvs and transforms make it left-handed.
inline Frame tangent_frame(SurfacePoint const& s, Vec3 const& normal) {
    Frame frame(normal, s.dpdu);
    if (dot(frame.t, s.dpdv) < 0) frame.t = -frame.t;
    return frame;
}

/// The round fibre that a surface stands for, whose strip or curve has u along it and v across.
struct Fibre {
    Vec3 tangent{1, 0, 0}; ///< unit, along the fibre to its tip
    float offset = 0;      ///< from edge to edge of its width, in (-1, 1); 0 in the middle
};

/// Returns the fibre at a point whose tangents are known.
inline Fibre fibre_at(SurfacePoint const& s) {
    float const v = s.uv.y - std::floor(s.uv.y);
    return {Frame(s.ns, s.dpdu).s, std::clamp(2 * v - 1, -0.999f, 0.999f)};
}

/// Returns a ray origin just off the surface, on the front or behind it: far enough that the ray
/// cannot meet the surface again by rounding (Pharr, Jakob and Humphreys 2016, 3.9.5). The distance
/// follows from the coordinates' own size, so no scene is too large or too small.
inline Vec3 offset_origin(SurfacePoint const& s, bool front) {
    float const distance = dot(abs(s.ng), s.p_error);
    return s.p + s.ng * (front ? distance : -distance);
}
/// The same, on the side that `direction` points to.
inline Vec3 offset_origin(SurfacePoint const& s, Vec3 const& direction) {
    return offset_origin(s, !(dot(direction, s.ng) < 0));
}

/// Returns a ray origin for `direction`, which leaves the smooth surface on wo's side. Directions
/// close to the triangle's plane, and those below it, start on the smooth surface, so that the
/// triangles do not cast their own shape's shadows on each other (Hanika 2021, "Hacking the shadow
/// terminator"); others start on the triangle.
inline Vec3 lifted_origin(SurfacePoint const& s, Vec3 const& direction) {
    constexpr float least_unlifted = 0.1f; // cosine; Cycles' default
    bool const front = dot(s.ng, s.wo) > 0;
    float const cosine = front ? dot(s.ng, direction) : -dot(s.ng, direction);
    float const amount = std::clamp(1 - cosine / least_unlifted, 0.f, 1.f);
    return offset_origin(s, front) + amount * s.lift;
}

} // namespace weft::shading
