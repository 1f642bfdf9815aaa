// All that is special about spheres.
#include <numbers>

#include "base/lat_long.h"
#include "world/geometry.h"

namespace weft::world {

void point_on(Sphere const&, Contact const& contact, shading::SurfacePoint& point) {
    auto const& [to_world, to_object] = *contact.space;
    Vec3 const local = normalize(contact.local); // what the ray's length has lost does not matter
    point.p = to_world.point(local);
    point.ng = point.ns = normalize(to_object.transposed(local));
    point.uv = direction_to_uv(local);
    if (contact.tangents) {
        point.dpdu = to_world.vector(Vec3(local.z, 0, -local.x) * (2 * kPi));
        if (float const r = std::sqrt(square(local.x) + square(local.z)); r > 0)
            point.dpdv =
                to_world.vector(Vec3(local.x * local.y / r, -r, local.z * local.y / r) * kPi);
    }
    point.p_error = (absolute_vector(to_world, Vec3(1)) + abs(to_world.origin)) * kRounding;
}

Vec2 uv_at(Sphere const&, Hit const&, Vec3 const& local) { return direction_to_uv(local); }

/// Of lat-long coordinates (base/lat_long.h) on the unit sphere.
UvGradients uv_gradients(Sphere const&, Contact const& contact,
                         shading::SurfacePoint const& point) {
    Affine const& to_object = contact.space->to_object;
    Vec3 const p = normalize(to_object.point(point.p));
    constexpr float nearest_to_pole = 1e-4f;
    float const r2 = std::max(p.x * p.x + p.z * p.z, square(nearest_to_pole)), r = std::sqrt(r2);
    return {to_object.transposed(Vec3(p.z, 0, -p.x) * (0.5f * kInvPi / r2)),
            to_object.transposed(Vec3(p.x * p.y / r, -r, p.z * p.y / r) * kInvPi)};
}

Enclosure enclosure(Sphere const&, Affined const& m) {
    auto const reach = [](double x, double y, double z) {
        return std::sqrt(x * x + y * y + z * z);
    };
    Vec3d const extent(reach(m.x.x, m.y.x, m.z.x), reach(m.x.y, m.y.y, m.z.y),
                       reach(m.x.z, m.y.z, m.z.z));
    Enclosure e;
    e.grow(m.origin - extent);
    e.grow(m.origin + extent);
    e.volume = 4 * std::numbers::pi / 3 * std::abs(m.determinant());
    return e;
}

/// Only where the map leaves it round.
bool keeps_kind(Sphere const&, Affined const& m) {
    double const a = length(m.x), b = length(m.y), c = length(m.z), least = 1e-6 * a;
    return std::abs(a - b) < least && std::abs(a - c) < least &&
           std::abs(dot(m.x, m.y)) < least * a && std::abs(dot(m.y, m.z)) < least * a &&
           std::abs(dot(m.z, m.x)) < least * a;
}

RTCGeometry make_kernel_geometry(Sphere const&, RTCDevice device, Affine const& to_world) {
    RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* data = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, 1));
    for (int i = 0; i < 3; ++i) data[i] = to_world.origin[i];
    data[3] = length(to_world.x);
    return geometry;
}

} // namespace weft::world
