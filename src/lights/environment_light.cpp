#include "lights/environment_light.h"

#include "base/match.h"

namespace weft::lights {

namespace {

float cubed(float x) { return x * x * x; }

LightSample sample_from(Vec3 const& direction, Color const& radiance, float pdf) {
    return {.wi = direction, .distance = kInfinity, .radiance = radiance, .pdf = pdf};
}

} // namespace

Color NetworkMap::at(Vec2 uv) const {
    shading::SurfacePoint point;
    point.uv = uv;
    Vec3 const v = evaluate(program, point);
    return max(Color(v.x, v.y, v.z), 0) * tint;
}

Color EnvironmentLight::radiance(Vec2 uv) const {
    return match(map, [&](auto const& m) { return m.at(uv); });
}

Color EnvironmentLight::radiance(Vec3 const& d) const {
    return radiance(direction_to_uv(to_map.vector(d)));
}

LightSample EnvironmentLight::sample_whole(Vec2 u) const {
    auto const s = sampler.sample(u);
    Vec3 const d = to_world.vector(s.direction);
    float const stretch = length(d);
    return sample_from(d * (1 / stretch), radiance(s.uv), s.pdf * cubed(stretch));
}

LightSample EnvironmentLight::sample(LightContext const&, Vec3 const& ref, Vec2 u, uint32_t) const {
    double const light = portals.light_at(ref);
    if (!(light > 0)) return sample_whole(u);
    if (u.x < whole) {
        LightSample s = sample_whole({u.x / whole, u.y});
        s.pdf = whole * s.pdf + (1 - whole) * portals.pdf(ref, light, s.wi);
        return s;
    }
    auto const s = portals.sample(ref, light, {(u.x - whole) / (1 - whole), u.y});
    float pdf = (1 - whole) * s.pdf;
    if (whole > 0) {
        Vec3 const m = to_map.vector(s.direction);
        float const shrink = 1 / length(m);
        pdf += whole * sampler.pdf(m * shrink) * cubed(shrink);
    }
    return sample_from(s.direction, radiance(s.direction), pdf);
}

LightSeen EnvironmentLight::seen(LightContext const&, Vec3 const& ref, Vec3 const& d) const {
    Vec3 const m = to_map.vector(d);
    float const shrink = 1 / length(m);
    Vec3 const local = m * shrink;
    LightSeen s{radiance(direction_to_uv(local)), 0};
    double const light = portals.light_at(ref);
    float const part = light > 0 ? whole : 1;
    if (part > 0) s.pdf = part * sampler.pdf(local) * cubed(shrink);
    if (part < 1) s.pdf += (1 - part) * portals.pdf(ref, light, d);
    return s;
}

} // namespace weft::lights
