#include "lights/area_light.h"

#include "world/world.h"

namespace weft::lights {

std::vector<Vec3> AreaLight::places() const {
    std::vector<Vec3> points;
    match(emitter, [&](auto const& e) {
        Vec3 const from = e.box().high + (e.box().high - e.box().low);
        for (uint32_t i = 0; i < 4; ++i) {
            EmitterSample const s =
                e.sample(from, {0.2f + 0.2f * float(i), 0.4f}, e.primitives() / 4 * i);
            if (s.pdf > 0) points.push_back(s.p + s.n * (1e-4f * extent));
        }
    });
    return points;
}

LightSample AreaLight::sample(LightContext const& context, Vec3 const& ref, Vec2 u,
                              uint32_t part) const {
    EmitterSample const s = match(emitter, [&](auto const& e) {
        if constexpr (requires { e.at_uv(ref, u); })
            if (texture) return texture->sample(e, ref, u);
        return e.sample(ref, u, part);
    });
    if (!(s.pdf > 0) || dot(s.n, s.wi) >= 0) return {}; // nothing, or its back
    float const towards = spread.factor(s.n, -s.wi);
    if (towards == 0) return {};
    shading::Textures const& textures = context.world.textures();
    auto const radiance_at = [&](auto const& place) {
        return textures.radiance(emission, place) * textures.opacity(opacity, place);
    };
    Color const radiance =
        uv_alone ? radiance_at(s.uv)
                 : radiance_at(context.world.point_near(object, s.primitive, s.p, -s.wi));
    // As far off the light as a ray that leaves it would start. Along a flat ray that is further.
    Vec3 const reach = abs(s.p) + Vec3(extent);
    return {.wi = s.wi,
            .distance = s.distance,
            .radiance = radiance * towards,
            .pdf = s.pdf,
            .p_error = world::kRounding * dot(abs(s.n), reach) / std::max(-dot(s.n, s.wi), 1e-4f),
            .object = int32_t(object)};
}

float AreaLight::pdf(Vec3 const& ref, shading::SurfacePoint const& point, uint32_t part) const {
    return match(emitter, [&](auto const& e) {
        if constexpr (requires { e.at_uv(ref, point.uv); })
            if (texture) return texture->pdf(e, ref, point.p, point.ng, point.uv);
        return e.pdf(ref, point.p, point.ng, part);
    });
}

} // namespace weft::lights
