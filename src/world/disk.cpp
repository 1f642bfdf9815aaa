// All that is special about disks.
#include "world/geometry.h"

namespace weft::world {

void point_on(Disk const&, Contact const& contact, shading::SurfacePoint& point) {
    auto const& [to_world, to_object] = *contact.space;
    point.p = to_world.point({contact.hit.u, contact.hit.v, 0});
    point.ng = point.ns = normalize(to_object.transposed({0, 0, 1}));
    point.uv = uv_at(Disk{}, contact.hit, contact.local);
    if (contact.tangents) {
        point.dpdu = to_world.x * 2.f;
        point.dpdv = to_world.y * 2.f;
    }
    // As exact as the kernel's intersection, which does not know z = 0.
    point.p_error = (absolute_vector(to_world, Vec3(1, 1, 0)) + abs(to_world.origin)) * kRounding;
}

Vec2 uv_at(Disk const&, Hit const& hit, Vec3 const&) {
    return {0.5f * (hit.u + 1), 0.5f * (hit.v + 1)};
}

UvGradients uv_gradients(Disk const&, Contact const& contact, shading::SurfacePoint const&) {
    Affine const& to_object = contact.space->to_object;
    return {to_object.transposed(Vec3(0.5f, 0, 0)), to_object.transposed(Vec3(0, 0.5f, 0))};
}

Enclosure enclosure(Disk const&, Affined const& m) {
    Enclosure e;
    for (double x : {-1.0, 1.0})
        for (double y : {-1.0, 1.0}) e.grow(m.point({x, y, 0}));
    e.closed = false;
    return e;
}

/// Only where the map leaves circles in its plane round.
bool keeps_kind(Disk const&, Affined const& m) {
    double const a = length(m.x), b = length(m.y), least = 1e-6 * a;
    return std::abs(a - b) < least && std::abs(dot(m.x, m.y)) < least * a;
}

RTCGeometry make_kernel_geometry(Disk const&, RTCDevice device, Affine const& to_world) {
    RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* data = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, 1));
    auto* normal = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 12, 1));
    Vec3 const n = normalize(Vec3(cross(Vec3d(to_world.x), Vec3d(to_world.y)))) *
                   (to_world.determinant() < 0 ? -1.f : 1.f);
    for (int i = 0; i < 3; ++i) {
        data[i] = to_world.origin[i];
        normal[i] = n[i];
    }
    data[3] = length(to_world.x);
    return geometry;
}

} // namespace weft::world
