// From the kernel's answer to a surface point.
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

} // namespace

shading::SurfacePoint World::surface(Ray const& ray, Hit const& hit) const {
    Object const& object = objects_[hit.object];
    shading::SurfacePoint point;
    point.t = hit.t;
    point.object = hit.object;
    point.primitive = hit.primitive;
    if (object.kind == ObjectKind::Sphere)
        sphere_point(object, ray, hit, point);
    else
        mesh_point(object, hit, point);
    if (object.normal_map) apply_normal_map(object, point);
    return point;
}

Vec2 World::mesh_uv(Object const& object, Hit const& hit) const {
    scene::Mesh const& mesh = *triangles_[size_t(object.triangles)].source;
    if (mesh.uvs.empty()) return {hit.u, hit.v};
    auto const& v = mesh.triangles[hit.primitive].v;
    return mesh.uvs[v[0]] * (1 - hit.u - hit.v) + mesh.uvs[v[1]] * hit.u + mesh.uvs[v[2]] * hit.v;
}

void World::mesh_point(Object const& object, Hit const& hit, shading::SurfacePoint& point) const {
    TriangleData const& data = triangles_[size_t(object.triangles)];
    auto const& v = data.source->triangles[hit.primitive].v;
    Vec3 const &a = data.positions[v[0]], &b = data.positions[v[1]], &c = data.positions[v[2]];
    Vec3 const e1 = b - a, e2 = c - a;
    float const w = 1 - hit.u - hit.v;
    point.p = a * w + b * hit.u + c * hit.v;
    point.p_error = max_abs(max_abs(a, b), c);
    Vec3 normal = cross(e1, e2);
    if (data.mirrored) normal = -normal;
    if (!data.normals.empty())
        point.ns = data.normals[v[0]] * w + data.normals[v[1]] * hit.u + data.normals[v[2]] * hit.v;
    point.uv = mesh_uv(object, hit);
    if (auto const& uvs = data.source->uvs; !uvs.empty()) {
        Vec2 const d1 = uvs[v[1]] - uvs[v[0]], d2 = uvs[v[2]] - uvs[v[0]];
        float const determinant = d1.x * d2.y - d1.y * d2.x;
        if (determinant != 0) {
            point.dpdu = (e1 * d2.y - e2 * d1.y) * (1 / determinant);
            point.dpdv = (e2 * d1.x - e1 * d2.x) * (1 / determinant);
        }
    }
    if (object.instanced) {
        normal = object.to_object.transposed(normal);
        if (!data.normals.empty()) point.ns = object.to_object.transposed(point.ns);
        point.dpdu = object.to_world.vector(point.dpdu);
        point.dpdv = object.to_world.vector(point.dpdv);
        point.p = object.to_world.point(point.p);
        point.p_error =
            absolute_vector(object.to_world, point.p_error) + abs(object.to_world.origin);
    }
    point.p_error *= kRounding;
    point.ng = normalize(normal);
    if (data.normals.empty()) {
        point.ns = point.ng;
    } else {
        point.ns = normalize(point.ns);
        // The vertex normals say which side is the front, whatever the winding.
        if (dot(point.ng, point.ns) < 0) point.ng = -point.ng;
    }
}

void World::sphere_point(Object const& object, Ray const& ray, Hit const& hit,
                         shading::SurfacePoint& point) const {
    // Back onto the unit sphere: what t has lost does not matter then.
    Vec3 const local = normalize(object.to_object.point(ray.origin + ray.direction * hit.t));
    point.p = object.to_world.point(local);
    point.ng = point.ns = normalize(object.to_object.transposed(local));
    point.uv = lights::direction_to_uv(local);
    point.dpdu = object.to_world.vector(Vec3(local.z, 0, -local.x));
    // Times the sine of the angle to the pole, so that it stays finite there.
    point.dpdv =
        object.to_world.vector(Vec3(local.x * local.y, local.y * local.y - 1, local.z * local.y));
    point.p_error =
        (absolute_vector(object.to_world, Vec3(1)) + abs(object.to_world.origin)) * kRounding;
}

void World::apply_normal_map(Object const& object, shading::SurfacePoint& point) const {
    Color const c = textures_.at(object.normal_map, point.uv);
    Vec3 const n(2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1);
    if (!(length_squared(n) > 0)) return;
    Frame frame(point.ns, point.dpdu);
    // Red goes along u and green along v, also where uvs or the transform mirror.
    if (dot(frame.t, point.dpdv) < 0) frame.t = -frame.t;
    Vec3 const mapped = normalize(frame.to_world(n));
    if (dot(mapped, point.ng) > 0) point.ns = mapped;
}

float World::opacity(Hit const& hit, Vec3 const& ng) const {
    Object const& o = objects_[hit.object];
    if (!o.alpha.texture) return o.alpha.value;
    if (o.kind == ObjectKind::Mesh) return textures_.at(o.alpha, mesh_uv(o, hit));
    // A sphere's normal says where on it the hit is; that of an instance is local already.
    return textures_.at(o.alpha,
                        lights::direction_to_uv(o.instanced ? ng : o.to_object.vector(ng)));
}

Color World::emission(shading::SurfacePoint const& point, Vec3 const& wo) const {
    Object const& o = objects_[point.object];
    if (!o.emission || dot(point.ng, wo) <= 0) return Color(0);
    return textures_.at(scene_->emissions[size_t(o.emission.index)].emission, point.uv);
}

shading::Shading World::shade(shading::SurfacePoint const& point, Vec3 const& wo,
                              media::MediumStack const& stack) const {
    Object const& o = objects_[point.object];
    bool const entering = dot(point.ng, wo) > 0;
    Vec3 const ng = entering ? point.ng : -point.ng;
    shading::Shading shading(lobes::Bsdf(shading::shading_frame(point, wo, ng), ng));
    shading.emission = emission(point, wo);
    if (o.material) {
        shading::Boundary const boundary{entering, stack.current_without(point.object).ior};
        shading.ior = shading::add_lobes(scene_->materials[size_t(o.material.index)], textures_,
                                         point, wo, boundary, shading.bsdf);
    }
    return shading;
}

media::Interior World::interior(uint32_t object, Vec2 uv) const {
    Object const& o = objects_[object];
    float const ior =
        o.material
            ? shading::interior_ior(scene_->materials[size_t(o.material.index)], textures_, uv)
            : 1;
    return {object, o.rank, ior, o.medium};
}

} // namespace weft::world
