// What a ray's cone covers of a surface's uv square.
#include "world/world.h"

namespace weft::world {

namespace {

/// How u and v grow with position, in world space; perpendicular to the normal.
struct UvGradients {
    Vec3 u{0, 0, 0}, v{0, 0, 0};
};

/// The gradients of barycentric coordinates are perpendicular to the opposite edge; u and v are
/// sums of them.
UvGradients triangle_gradients(Vec3 const& e1, Vec3 const& e2, Vec2 d1, Vec2 d2) {
    Vec3 const n = cross(e1, e2);
    float const area = length_squared(n);
    if (!(area > 0)) return {};
    Vec3 const b1 = cross(e2, n) * (1 / area), b2 = cross(n, e1) * (1 / area);
    return {b1 * d1.x + b2 * d2.x, b1 * d1.y + b2 * d2.y};
}

/// Of lat-long coordinates (base/lat_long.h) on the unit sphere.
UvGradients sphere_gradients(Vec3 const& p) {
    constexpr float nearest_to_pole = 1e-4f;
    float const r2 = std::max(p.x * p.x + p.z * p.z, square(nearest_to_pole)), r = std::sqrt(r2);
    return {Vec3(p.z, 0, -p.x) * (0.5f * kInvPi / r2),
            Vec3(p.x * p.y / r, -r, p.z * p.y / r) * kInvPi};
}

} // namespace

shading::UvFootprint World::uv_footprint(Object const& object, RayCone const& cone,
                                         shading::SurfacePoint const& point) const {
    float const width = cone.width_at(point.t);
    if (!(width > 0)) return {};
    UvGradients g;
    bool local = true;
    if (object.kind == ObjectKind::Sphere) {
        g = sphere_gradients(normalize(object.to_object.point(point.p)));
    } else if (object.kind == ObjectKind::Disk) {
        g = {Vec3(0.5f, 0, 0), Vec3(0, 0.5f, 0)};
    } else {
        TriangleData const& data = triangles_[size_t(object.triangles)];
        auto const& v = data.source->triangles[point.primitive].v;
        Vertex const &a = data.vertices[v[0]], &b = data.vertices[v[1]], &c = data.vertices[v[2]];
        bool const mapped = data.has_uvs; // or else the uvs are barycentric coordinates
        g = triangle_gradients(b.p - a.p, c.p - a.p,
                               mapped ? Vec2(b.u - a.u, b.v - a.v) : Vec2(1, 0),
                               mapped ? Vec2(c.u - a.u, c.v - a.v) : Vec2(0, 1));
        local = object.instanced;
    }
    if (local) g = {object.to_object.transposed(g.u), object.to_object.transposed(g.v)};
    // The cone cuts the tangent plane in an ellipse: as wide as the cone across the ray, and
    // 1 / cos times that along it.
    Vec3 const& d = point.wo;
    float const cosine = std::max(std::abs(dot(d, point.ng)), 1e-3f);
    Vec3 along = d - point.ng * dot(d, point.ng);
    float const sine = length(along);
    along = sine > 1e-4f ? along * (1 / sine) : Frame(point.ng).s;
    Vec3 const across = cross(point.ng, along) * width;
    along *= width / cosine;
    return {{dot(g.u, along), dot(g.v, along)}, {dot(g.u, across), dot(g.v, across)}};
}

} // namespace weft::world
