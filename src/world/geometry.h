// The kinds of geometry that a world is made of.
//
// Every kind states, with no default,
//
//   kernel_tells_place   whether the kernel's u and v say where a hit is; else `nearest` does
//   needs_local          whether `point_on` and `uv_at` ask for the place in the kind's own space
//   made_of()            what tells it from others of its kind; null: nothing
//
// All else that depends on the kind is a function with an overload per kind, declared at the end of
// this file. The functions of one kind stand in one source: triangle_mesh.cpp, sphere.cpp,
// disk.cpp. Who has a `Geometry` calls them through `match`, so a new kind does not compile before
// it has all of them. How a kind becomes a light is the affair of lights/build_area_lights.cpp.
//
// A geometry lies in its own space: the unit sphere, the unit disk, a mesh as its file has it. The
// vertices of a mesh that stands in one place alone are stored in world space instead, and its own
// space is the world's.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "scene/shape.h"
#include "shading/surface_point.h"
#include "world/edge_hits.h"
#include "world/embree.h"
#include "world/ray.h"

namespace weft::world {

/// Half a cache line: a hit reads three of these from anywhere in memory.
struct alignas(32) Vertex {
    Vec3 p{0, 0, 0};
    float u = 0;
    Vec3 n{0, 0, 0}; ///< of any length, to be interpolated
    float v = 0;
};

/// What a triangle mesh keeps in memory. Several geometries may share it.
struct MeshData {
    std::vector<Vertex> vertices;
    std::shared_ptr<scene::Mesh const> source; ///< has the triangles
    shading::VertexAttributes attributes;      ///< what nodes ask for
    bool smooth = false;                       ///< has normals
    bool has_uvs = false;                      ///< else the uvs are barycentric coordinates
    bool mirrored = false;                     ///< counter-clockwise is the back
    bool is_rectangle = false;                 ///< two triangles that lights know as one
};

/// A triangle mesh. What every hit asks for is at hand; the rest is in `data`.
struct TriangleMesh {
    static constexpr bool kernel_tells_place = true, needs_local = false;
    void const* made_of() const { return data; }

    Vertex const* vertices;
    scene::Mesh::Triangle const* triangles;
    MeshData const* data;

    explicit TriangleMesh(MeshData const& d)
        : vertices(d.vertices.data()), triangles(d.source->triangles.data()), data(&d) {}
    friend bool operator==(TriangleMesh const& a, TriangleMesh const& b) {
        return a.data == b.data;
    }
};
/// The sphere of radius 1 around the origin.
struct Sphere {
    static constexpr bool kernel_tells_place = true, needs_local = true;
    static constexpr void const* made_of() { return nullptr; }

    friend bool operator==(Sphere, Sphere) = default;
};
/// The disk of radius 1 around the origin in the plane z = 0.
struct Disk {
    static constexpr bool kernel_tells_place = false, needs_local = false;
    static constexpr void const* made_of() { return nullptr; }

    friend bool operator==(Disk, Disk) = default;
};

using Geometry = std::variant<TriangleMesh, Sphere, Disk>;

/// Where a geometry was met.
struct Contact {
    Hit hit;
    Vec3 local{0, 0, 0}; ///< the place in the geometry's own space, for kinds that need it
    /// Of the object; none: the geometry's own space is the world's.
    std::optional<ObjectSpace> space;
    bool tangents = false; ///< whether something looks at dpdu and dpdv
    bool lifts = false;    ///< whether something looks at the smooth surface of a mesh
};

/// How u and v grow with position, in world space; perpendicular to the normal.
struct UvGradients {
    Vec3 u{0, 0, 0}, v{0, 0, 0};
};

/// What a boundary encloses, in world space.
struct Enclosure {
    Vec3d low{double(kInfinity)}, high{-double(kInfinity)};
    double volume = 0;
    bool closed = true;

    void grow(Vec3d const& p) {
        low = min(low, p);
        high = max(high, p);
    }
};

// The functions of every kind.
//
//   geometry_of(shape)               returns the geometry of a shape of the scene that is one
//   point_on(g, contact, point)      fills in what the surface is at a contact: position and its
//                                    error, normals, uv, tangents. `contact.local` is of any length
//                                    on a sphere.
//   uv_at(g, hit, local)             returns the uv alone; `local` as in a contact
//   uv_gradients(g, contact, point)  returns those at a point that `point_on` has filled in
//   nearest(g, local, hit)           moves a hit to where `local`, a place on or near the geometry,
//                                    is; a mesh starts from the triangle `hit.primitive`
//   corners_at(g, hit)               returns the corners that neighbouring primitives may share
//   enclosure(g, to_world)           returns what it encloses
//   keeps_kind(g, to_world)          returns whether the kernel can hold it in world space
//   make_kernel_geometry(g, device, to_world)
//                                    returns it for the kernel, put to where it stands; not yet
//                                    committed. A mesh that lies in world space ignores `to_world`.

inline Sphere geometry_of(scene::Sphere const&) { return {}; }
inline Disk geometry_of(scene::Disk const&) { return {}; }

void point_on(TriangleMesh const&, Contact const&, shading::SurfacePoint&);
void point_on(Sphere const&, Contact const&, shading::SurfacePoint&);
void point_on(Disk const&, Contact const&, shading::SurfacePoint&);

Vec2 uv_at(TriangleMesh const&, Hit const&, Vec3 const& local);
Vec2 uv_at(Sphere const&, Hit const&, Vec3 const& local);
Vec2 uv_at(Disk const&, Hit const&, Vec3 const& local);

UvGradients uv_gradients(TriangleMesh const&, Contact const&, shading::SurfacePoint const&);
UvGradients uv_gradients(Sphere const&, Contact const&, shading::SurfacePoint const&);
UvGradients uv_gradients(Disk const&, Contact const&, shading::SurfacePoint const&);

void nearest(TriangleMesh const&, Vec3 const& local, Hit& hit);
inline void nearest(Sphere const&, Vec3 const&, Hit&) {}
inline void nearest(Disk const&, Vec3 const& local, Hit& hit) {
    hit.u = local.x;
    hit.v = local.y;
}

inline Corners corners_at(TriangleMesh const&, Hit const& hit) { return triangle_corners(hit); }
inline Corners corners_at(Sphere const&, Hit const&) { return kAllCorners; }
inline Corners corners_at(Disk const&, Hit const&) { return kAllCorners; }

Enclosure enclosure(TriangleMesh const&, Affined const& to_world);
Enclosure enclosure(Sphere const&, Affined const& to_world);
Enclosure enclosure(Disk const&, Affined const& to_world);

bool keeps_kind(TriangleMesh const&, Affined const& to_world);
bool keeps_kind(Sphere const&, Affined const& to_world);
bool keeps_kind(Disk const&, Affined const& to_world);

RTCGeometry make_kernel_geometry(TriangleMesh const&, RTCDevice device, Affine const& to_world);
RTCGeometry make_kernel_geometry(Sphere const&, RTCDevice device, Affine const& to_world);
RTCGeometry make_kernel_geometry(Disk const&, RTCDevice device, Affine const& to_world);

/// Returns whether those corners (bits) of triangle `a` are also corners of triangle `b`.
bool has_corners(TriangleMesh const&, uint32_t a, Corners corners, uint32_t b);

/// |M| v for a vector v of absolute values: how far an error may reach.
inline Vec3 absolute_vector(Affine const& m, Vec3 const& v) {
    return abs(m.x) * v.x + abs(m.y) * v.y + abs(m.z) * v.z;
}

} // namespace weft::world
