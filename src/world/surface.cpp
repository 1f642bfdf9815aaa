// From the kernel's answer to a surface point.
#include "base/feature.h"
#include "base/lat_long.h"
#include "world/world.h"

namespace weft::world {

namespace {

Vec3 max_abs(Vec3 const& a, Vec3 const& b) {
    return {std::max(std::abs(a.x), std::abs(b.x)), std::max(std::abs(a.y), std::abs(b.y)),
            std::max(std::abs(a.z), std::abs(b.z))};
}

/// |M| v for a vector v of absolute values.
Vec3 absolute_vector(Affine const& m, Vec3 const& v) {
    return abs(m.x) * v.x + abs(m.y) * v.y + abs(m.z) * v.z;
}

Vec2 uv_at(Vertex const& a, Vertex const& b, Vertex const& c, Hit const& hit) {
    float const w = 1 - hit.u - hit.v;
    return {a.u * w + b.u * hit.u + c.u * hit.v, a.v * w + b.v * hit.u + c.v * hit.v};
}

Vec2 disk_uv(Hit const& hit) { return {0.5f * (hit.u + 1), 0.5f * (hit.v + 1)}; }

} // namespace

shading::SurfacePoint World::surface(Ray const& ray, Hit const& hit) const {
    Object const& object = objects_[hit.object];
    Vec3 const local = object.kind == ObjectKind::Sphere
                           ? object.to_object.point(ray.origin + ray.direction * hit.t)
                           : Vec3(0);
    return point_on(hit, local, -ray.direction, ray.cone);
}

shading::SurfacePoint World::point_on(Hit const& hit, Vec3 const& local, Vec3 const& wo,
                                      RayCone const& cone) const {
    FeatureScope const scope(Feature::Surfaces);
    Object const& object = objects_[hit.object];
    shading::SurfacePoint point;
    point.t = hit.t;
    point.wo = wo;
    point.object = hit.object;
    point.primitive = hit.primitive;
    point.to_world = &object.to_world;
    point.to_object = &object.to_object;
    if (object.kind == ObjectKind::Sphere)
        sphere_point(object, normalize(local), point); // what t has lost does not matter then
    else if (object.kind == ObjectKind::Disk)
        disk_point(object, hit, point);
    else
        mesh_point(object, hit, point);
    // Shadow rays, which have no cone, are to see the same holes.
    if (use_footprints_ && !object.is_see_through)
        point.footprint = uv_footprint(object, cone, point);
    if (object.normal_map) apply_normal_map(object, point);
    return point;
}

shading::SurfacePoint World::point_near(uint32_t object, uint32_t primitive, Vec3 const& p,
                                        Vec3 const& wo) const {
    Object const& o = objects_[object];
    Vec3 const local = o.instanced || o.kind != ObjectKind::Mesh ? o.to_object.point(p) : p;
    Hit hit{0, object, primitive, local.x, local.y};
    if (o.kind == ObjectKind::Disk) return point_on(hit, local, wo);
    if (o.kind == ObjectKind::Sphere) return point_on(hit, local, wo);
    TriangleData const& data = triangles_[size_t(o.triangles)];
    auto place = [&](uint32_t triangle) {
        auto const& v = data.source->triangles[triangle].v;
        Vec3 const &a = data.vertices[v[0]].p, e1 = data.vertices[v[1]].p - a,
                   e2 = data.vertices[v[2]].p - a, n = cross(e1, e2), d = local - a;
        float const scale = 1 / length_squared(n);
        hit.primitive = triangle;
        hit.u = dot(cross(d, e2), n) * scale;
        hit.v = dot(cross(e1, d), n) * scale;
    };
    place(primitive);
    if (o.is_rectangle && hit.u < 0) place(1);
    return point_on(hit, local, wo);
}

Vec2 World::mesh_uv(Object const& object, Hit const& hit) const {
    TriangleData const& data = triangles_[size_t(object.triangles)];
    if (!data.has_uvs) return {hit.u, hit.v};
    auto const& v = data.source->triangles[hit.primitive].v;
    return uv_at(data.vertices[v[0]], data.vertices[v[1]], data.vertices[v[2]], hit);
}

void World::mesh_point(Object const& object, Hit const& hit, shading::SurfacePoint& point) const {
    TriangleData const& data = triangles_[size_t(object.triangles)];
    auto const& v = data.source->triangles[hit.primitive].v;
    Vertex const &a = data.vertices[v[0]], &b = data.vertices[v[1]], &c = data.vertices[v[2]];
    Vec3 const e1 = b.p - a.p, e2 = c.p - a.p;
    float const w = 1 - hit.u - hit.v;
    point.p = a.p * w + b.p * hit.u + c.p * hit.v;
    point.p_error = max_abs(max_abs(a.p, b.p), c.p);
    Vec3 normal = cross(e1, e2);
    if (data.mirrored) normal = -normal;
    if (data.smooth) point.ns = a.n * w + b.n * hit.u + c.n * hit.v;
    point.uv = data.has_uvs ? uv_at(a, b, c, hit) : Vec2(hit.u, hit.v);
    point.barycentric = {hit.u, hit.v};
    point.attributes = &data.attributes;
    if (object.has_tangents && data.has_uvs) {
        Vec2 const d1(b.u - a.u, b.v - a.v), d2(c.u - a.u, c.v - a.v);
        float const determinant = d1.x * d2.y - d1.y * d2.x;
        if (determinant != 0) {
            point.dpdu = (e1 * d2.y - e2 * d1.y) * (1 / determinant);
            point.dpdv = (e2 * d1.x - e1 * d2.x) * (1 / determinant);
        }
    }
    if (object.instanced) {
        normal = object.to_object.transposed(normal);
        if (data.smooth) point.ns = object.to_object.transposed(point.ns);
        point.dpdu = object.to_world.vector(point.dpdu);
        point.dpdv = object.to_world.vector(point.dpdv);
        point.p = object.to_world.point(point.p);
        point.p_error =
            absolute_vector(object.to_world, point.p_error) + abs(object.to_world.origin);
    }
    point.p_error *= kRounding;
    point.ng = normalize(normal);
    if (!data.smooth) {
        point.ns = point.ng;
    } else {
        point.ns = normalize(point.ns);
        // The vertex normals say which side is the front, whatever the winding.
        if (dot(point.ng, point.ns) < 0) point.ng = -point.ng;
    }
}

void World::sphere_point(Object const& object, Vec3 const& local,
                         shading::SurfacePoint& point) const {
    point.p = object.to_world.point(local);
    point.ng = point.ns = normalize(object.to_object.transposed(local));
    point.uv = direction_to_uv(local);
    if (object.has_tangents) {
        point.dpdu = object.to_world.vector(Vec3(local.z, 0, -local.x) * (2 * kPi));
        if (float const r = std::sqrt(square(local.x) + square(local.z)); r > 0)
            point.dpdv = object.to_world.vector(
                Vec3(local.x * local.y / r, -r, local.z * local.y / r) * kPi);
    }
    point.p_error =
        (absolute_vector(object.to_world, Vec3(1)) + abs(object.to_world.origin)) * kRounding;
}

void World::disk_point(Object const& object, Hit const& hit, shading::SurfacePoint& point) const {
    point.p = object.to_world.point({hit.u, hit.v, 0});
    point.ng = point.ns = normalize(object.to_object.transposed({0, 0, 1}));
    point.uv = disk_uv(hit);
    if (object.has_tangents) {
        point.dpdu = object.to_world.x * 2.f;
        point.dpdv = object.to_world.y * 2.f;
    }
    // As exact as the kernel's intersection, which does not know z = 0.
    point.p_error =
        (absolute_vector(object.to_world, Vec3(1, 1, 0)) + abs(object.to_world.origin)) * kRounding;
}

void World::apply_normal_map(Object const& object, shading::SurfacePoint& point) const {
    Vec3 const c = textures_.at(object.normal_map, point);
    Vec3 const n(2 * c.x - 1, 2 * c.y - 1, 2 * c.z - 1);
    if (!(length_squared(n) > 0)) return;
    Vec3 const mapped = normalize(tangent_frame(point, point.ns).to_world(n));
    if (dot(mapped, point.ng) > 0) point.ns = mapped;
}

bool World::has_corners(uint32_t object, uint32_t a, uint8_t corners, uint32_t b) const {
    TriangleData const& data = triangles_[size_t(objects_[object].triangles)];
    auto const& of_a = data.source->triangles[a].v;
    auto const& of_b = data.source->triangles[b].v;
    auto is_of_b = [&](uint32_t v) {
        return std::any_of(std::begin(of_b), std::end(of_b), [&](uint32_t w) {
            return v == w || data.vertices[v].p == data.vertices[w].p;
        });
    };
    for (int k = 0; k < 3; ++k)
        if (corners & (1 << k) && !is_of_b(of_a[k])) return false;
    return true;
}

float World::opacity(Hit const& hit, Vec3 const& ng, Vec3 const& direction) const {
    Object const& o = objects_[hit.object];
    if (!within(textures_.needs(o.opacity), shading::Needs::uv))
        return textures_.opacity(o.opacity, filtered_point(hit, ng, direction));
    Vec2 const uv = o.kind == ObjectKind::Mesh   ? mesh_uv(o, hit)
                    : o.kind == ObjectKind::Disk ? disk_uv(hit)
                                                 : direction_to_uv(sphere_local(o, ng));
    return textures_.opacity(o.opacity, uv);
}

/// Where on a sphere a hit is: its normal says so, and that of an instance is local already.
Vec3 World::sphere_local(Object const& object, Vec3 const& ng) {
    return object.instanced ? ng : object.to_object.vector(ng);
}

shading::SurfacePoint World::filtered_point(Hit const& hit, Vec3 const& ng,
                                            Vec3 const& direction) const {
    Object const& o = objects_[hit.object];
    Vec3 const wo = -(o.instanced ? o.to_world.vector(direction) : direction);
    return point_on(hit, sphere_local(o, ng), normalize(wo));
}

Color World::transmittance(Hit const& hit, Vec3 const& ng, Vec3 const& direction,
                           shading::Look const& look) const {
    Object const& o = objects_[hit.object];
    float const there = o.has_alpha ? opacity(hit, ng, direction) : 1;
    if (!o.is_see_through || there == 0) return Color(1 - there);
    FeatureScope const scope(Feature::Shading);
    shading::SurfacePoint const point = filtered_point(hit, ng, direction);
    return Color(1 - there) +
           there * materials_.straight(o.material, point, view_of(point, point.wo, 1, look));
}

Color World::emission(shading::SurfacePoint const& point, Vec3 const& wo) const {
    Object const& o = objects_[point.object];
    if (!o.emission || dot(point.ng, wo) <= 0) return Color(0);
    float const towards = o.spread.factor(point.ng, wo);
    if (towards == 0) return Color(0);
    if (!use_footprints_) return textures_.radiance(o.emission, point) * towards;
    // As light sampling sees it, which has no ray.
    shading::SurfacePoint sharp = point;
    sharp.footprint = {};
    return textures_.radiance(o.emission, sharp) * towards;
}

shading::View World::view_of(shading::SurfacePoint const& point, Vec3 const& wo, float ior_outside,
                             shading::Look const& look) const {
    bool const entering = dot(point.ng, wo) > 0;
    return {wo, entering ? point.ng : -point.ng, entering, ior_outside, look};
}

shading::Shading World::shade(shading::SurfacePoint const& point, Vec3 const& wo,
                              media::MediumStack const& stack, shading::Look const& look) const {
    FeatureScope const scope(Feature::Shading);
    Object const& o = objects_[point.object];
    shading::View const view =
        view_of(point, wo, o.has_interior ? stack.current_without(point.object).ior : 1, look);
    shading::Shading shading(lobes::Bsdf(shading::shading_frame(point, point.ns, view), view.ng));
    shading.emission = emission(point, wo);
    if (o.material) materials_.shade(o.material, point, view, shading);
    return shading;
}

media::Interior World::interior(shading::SurfacePoint const& point) const {
    Object const& o = objects_[point.object];
    return {point.object, o.rank, textures_.at(o.ior, point), o.medium};
}

} // namespace weft::world
