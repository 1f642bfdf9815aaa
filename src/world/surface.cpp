// From the kernel's answer to a surface point, and what the surface is there.
#include "base/feature.h"
#include "base/match.h"
#include "world/world.h"

namespace weft::world {

Contact World::contact(Hit const& hit) const {
    Model const& m = model(hit.object);
    Contact contact{hit};
    contact.tangents = m.needs_tangents;
    // Where light goes inside, its rays must start at the surface that tells inside from outside.
    contact.lifts = m.softens_bent_light && !m.has_interior;
    if (!m.in_world_space) contact.space.emplace(transform(hit.object));
    return contact;
}

Vec3 World::local_place(Hit const& hit, Vec3 const& ng) const {
    Model const& m = model(hit.object);
    return match(m.geometry, [&]<class G>(G const&) {
        if constexpr (G::needs_local)
            return m.instanced ? ng : space_of(hit.object).to_object.vector(ng);
        else
            return Vec3(0);
    });
}

shading::SurfacePoint World::surface(Ray const& ray, Hit const& hit) const {
    Contact contact = this->contact(hit);
    match(model(hit.object).geometry, [&]<class G>(G const&) {
        if constexpr (G::needs_local)
            contact.local = contact.space->to_object.point(ray.origin + ray.direction * hit.t);
    });
    return point_at(contact, -ray.direction, ray.cone);
}

shading::SurfacePoint World::point_near(uint32_t object, uint32_t primitive, Vec3 const& p,
                                        Vec3 const& wo) const {
    Contact contact = this->contact({.t = 0, .object = object, .primitive = primitive});
    contact.local = contact.space ? contact.space->to_object.point(p) : p;
    match(model(object).geometry, [&](auto const& g) { nearest(g, contact.local, contact.hit); });
    return point_at(contact, wo);
}

shading::SurfacePoint World::filtered_point(Hit const& hit, Vec3 const& ng,
                                            Vec3 const& direction) const {
    Contact contact = this->contact(hit);
    contact.local = local_place(hit, ng);
    bool const is_local = model(hit.object).instanced;
    Vec3 const d = is_local ? contact.space->to_world.vector(direction) : direction;
    return point_at(contact, normalize(-d));
}

shading::SurfacePoint World::point_at(Contact const& contact, Vec3 const& wo,
                                      RayCone const& cone) const {
    FeatureScope const scope(Feature::Surfaces);
    Model const& m = model(contact.hit.object);
    shading::SurfacePoint point;
    point.t = contact.hit.t;
    point.time = contact.hit.time;
    point.wo = wo;
    point.object = contact.hit.object;
    point.primitive = contact.hit.primitive;
    match(m.geometry, [&](auto const& g) { point_on(g, contact, point); });
    point.smooth_normal = point.ns;
    if (m.needs_object_space)
        point.space = contact.space ? *contact.space : space_of(contact.hit.object);
    // Shadow rays, which have no cone, are to see the same holes.
    if (use_footprints_ && !m.is_see_through) point.footprint = uv_footprint(contact, cone, point);
    if (m.traits.normal) apply_normal_map(m.traits.normal, point);
    return point;
}

/// Returns what a ray's cone covers of a surface's uv square. The cone cuts the tangent plane in an
/// ellipse: as wide as the cone across the ray, and 1 / cos times that along it.
shading::UvFootprint World::uv_footprint(Contact const& contact, RayCone const& cone,
                                         shading::SurfacePoint const& point) const {
    float const width = cone.width_at(point.t);
    if (!(width > 0)) return {};
    UvGradients const g = match(model(point.object).geometry, [&](auto const& geometry) {
        return uv_gradients(geometry, contact, point);
    });
    Vec3 const& d = point.wo;
    float const cosine = std::max(std::abs(dot(d, point.ng)), 1e-3f);
    Vec3 along = d - point.ng * dot(d, point.ng);
    float const sine = length(along);
    along = sine > 1e-4f ? along * (1 / sine) : Frame(point.ng).s;
    Vec3 const across = cross(point.ng, along) * width;
    along *= width / cosine;
    return {{dot(g.u, along), dot(g.v, along)}, {dot(g.u, across), dot(g.v, across)}};
}

void World::apply_normal_map(scene::TextureId map, shading::SurfacePoint& point) const {
    Vec3 const c = textures_.at(map, point);
    Vec3 const n(2 * c.x - 1, 2 * c.y - 1, 2 * c.z - 1);
    if (!(length_squared(n) > 0)) return;
    point.ns = normalize(tangent_frame(point, point.ns).to_world(n));
}

float World::opacity(Hit const& hit, Vec3 const& ng, Vec3 const& direction) const {
    Model const& m = model(hit.object);
    if (!within(textures_.needs(m.opacity), shading::Needs::uv))
        return textures_.opacity(m.opacity, filtered_point(hit, ng, direction));
    return textures_.opacity(m.opacity, match(m.geometry, [&](auto const& g) {
                                 return uv_at(g, hit, local_place(hit, ng));
                             }));
}

Color World::transmittance(Hit const& hit, Vec3 const& ng, Vec3 const& direction,
                           shading::Look const& look) const {
    Model const& m = model(hit.object);
    float const there = m.has_alpha ? opacity(hit, ng, direction) : 1;
    if (!m.is_see_through || there == 0) return Color(1 - there);
    FeatureScope const scope(Feature::Shading);
    shading::SurfacePoint const point = filtered_point(hit, ng, direction);
    return Color(1 - there) +
           there * materials_.straight(m.traits.bsdf, point, view_of(point, point.wo, 1, look));
}

Color World::emission(shading::SurfacePoint const& point, Vec3 const& wo) const {
    Model const& m = model(point.object);
    if (!m.emission || dot(point.ng, wo) <= 0) return Color(0);
    float const towards = m.spread.factor(point.ng, wo);
    if (towards == 0) return Color(0);
    if (!use_footprints_) return textures_.radiance(m.emission, point) * towards;
    // As light sampling sees it, which has no ray.
    shading::SurfacePoint sharp = point;
    sharp.footprint = {};
    return textures_.radiance(m.emission, sharp) * towards;
}

shading::View World::view_of(shading::SurfacePoint const& point, Vec3 const& wo, float ior_outside,
                             shading::Look const& look) const {
    using lobes::BentNormals;
    BentNormals const bent = look.fold                                ? BentNormals::Folded
                             : model(point.object).softens_bent_light ? BentNormals::Softened
                                                                      : BentNormals::Dropped;
    return {wo,  shading::surface_normal(point, bent), bent, dot(point.ng, wo) > 0, ior_outside,
            look};
}

shading::Shading World::shade(shading::SurfacePoint const& point, Vec3 const& wo, float ior_outside,
                              shading::Look const& look) const {
    FeatureScope const scope(Feature::Shading);
    Model const& m = model(point.object);
    shading::View const view = view_of(point, wo, ior_outside, look);
    shading::Shading shading(empty_bsdf(point, view));
    shading.emission = emission(point, wo);
    if (m.traits.bsdf) materials_.shade(m.traits.bsdf, point, view, shading);
    return shading;
}

media::Interior World::interior(shading::SurfacePoint const& point) const {
    Model const& m = model(point.object);
    return {point.object, objects_[point.object].rank, textures_.at(m.ior, point), m.medium};
}

} // namespace weft::world
