// A triangle mesh as plain data, what every mesh reader produces and the world commits.
//
// Vertices are unified: one index addresses position, normal, uv and colour alike, so a seam in
// the uvs or a hard edge in the normals is a repeated position. Left out on purpose: per-face
// data, several uv sets, and polygons, which readers hand to `triangulate`.
#pragma once

#include "base/color.h"
#include "base/error.h"
#include "base/vec.h"

#include <span>
#include <string>
#include <vector>

namespace weft::scene {

/// A property of the vertices, by name: `components` numbers for each.
struct VertexAttribute {
    std::string name;
    int components = 1;
    std::vector<float> values;
};

struct Mesh {
    struct Triangle {
        uint32_t v[3]; ///< indices of vertices, counter-clockwise seen from the front
        friend bool operator==(Triangle const&, Triangle const&) = default;
    };
    std::vector<Vec3> positions; ///< scene units
    std::vector<Vec3> normals;   ///< empty, or one of length 1 per vertex
    std::vector<Vec2> uvs;       ///< empty, or one per vertex
    std::vector<Color> colors;   ///< empty, or one per vertex; as the file holds them, 0 to 1
    std::vector<VertexAttribute> attributes; ///< what else the file says of its vertices
    std::vector<Triangle> triangles;
};

/// Throws InputError at `where` for an index out of range, a position, normal, uv or colour that
/// is not finite, a normal that is not of length 1 (to 1e-3), or an array whose length is neither
/// 0 nor the number of vertices. Triangles without area are legal: they are never hit.
void validate(Mesh const& mesh, SourceLocation const& where);

/// The largest concave polygon `triangulate` takes; its time grows with the square.
inline constexpr size_t kMaxConcaveCorners = 10000;

/// Appends the n - 2 triangles of a polygon of n >= 3 corners (indices into `positions`, already
/// checked). A quad is cut at its reflex corner or along its shorter diagonal, a convex polygon
/// is fanned, any other has its ears clipped (Meisters 1975, "Polygons have ears") in the
/// axis-aligned plane that Newell's normal favours. Self-intersecting and flat polygons give
/// n - 2 triangles too, but which ones is not specified. False, with nothing appended, for a
/// concave polygon of more than kMaxConcaveCorners corners.
[[nodiscard]] bool triangulate(std::span<Vec3 const> positions, std::span<uint32_t const> polygon,
                               std::vector<Mesh::Triangle>& triangles);

/// Scales every normal to length 1. One of length 0 becomes the geometric normal of the first
/// triangle at its vertex that has an area, or +z where there is none. Normals must be finite.
void unify_normals(Mesh& mesh);

} // namespace weft::scene
