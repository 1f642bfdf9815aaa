#include "lights/lamp.h"

namespace weft::lights {

Color Lamp::passed(LightContext const& context, Vec3 const& d) const {
    if (!gobo) return Color(1);
    auto const& [projection, texture] = *gobo;
    if (!(dot(projection.frame.n, d) > 0)) return Color(0);
    return context.textures.radiance(texture, projection.uv(d));
}

Color Lamp::radiance(LightContext const& context, Vec3 const& d) const {
    return luminaire.radiance(d) * passed(context, d);
}

LightSample Lamp::sample(LightContext const& context, Vec3 const& ref, Vec2 u, uint32_t) const {
    if (!luminaire.ball) {
        LightSample s =
            match(luminaire.source, [&](auto const& source) { return source.sample(ref); });
        if (gobo && s.pdf > 0) s.radiance *= passed(context, -s.wi);
        return s;
    }
    EmitterSample const s = luminaire.ball->sample(ref, u);
    if (!(s.pdf > 0)) return {};
    return {.wi = s.wi, .distance = s.distance, .radiance = radiance(context, -s.wi), .pdf = s.pdf};
}

} // namespace weft::lights
