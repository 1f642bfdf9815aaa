// Where paths heed the controls of lights and objects: which objects a ray meets, and what part of
// the light that arrives counts. With `PathSettings::controls` off, all of it.
#pragma once

#include "integrator/path_state.h"

namespace weft::integrator {

/// The objects that a ray meets which came about like that.
inline world::RayMask ray_mask(PathSettings const& settings, world::RayKind kind) {
    return settings.controls ? world::mask_of(kind) : world::kUnruledMask;
}

/// Whether the camera sees something else in the object's place.
inline bool is_matte(PathSettings const& settings, PathState const& path,
                     world::Object const& object) {
    return (object.holdout || object.shadow_catcher) && settings.controls &&
           path.signature.length() == 0;
}

/// How far rays see that leave this object.
inline float reach_of(PathSettings const& settings, world::Object const& object) {
    return settings.controls && object.trace_distance > 0 ? object.trace_distance : kInfinity;
}

/// What a light's controls say, null where no light has any.
inline lights::LightRules const* rules_of(lights::LightTable const& lights,
                                          PathSettings const& settings, int32_t light) {
    return settings.controls && lights.has_controls() && light >= 0 ? &lights[light].rules
                                                                    : nullptr;
}

/// The objects that block a light whose controls are `rules`; 0: none.
inline world::RayMask shadow_mask(PathSettings const& settings, lights::LightRules const* rules) {
    if (!settings.controls) return world::kUnruledMask;
    return rules ? rules->shadow_mask : world::kShadowMask;
}

/// The part of a light, `distance` away, that counts where the ray of `path` found it by itself.
inline float found_factor(lights::LightTable const& lights, PathSettings const& settings,
                          PathState const& path, int32_t light, float distance) {
    if (path.caustic && !settings.caustics) return 0;
    lights::LightRules const* rules = rules_of(lights, settings, light);
    if (!rules) return 1;
    uint32_t const bounces = path.signature.length();
    if (bounces > 0 && rules->sampling_alone && (path.pdf > 0 || !rules->shown)) return 0;
    return rules->factor({path.at.p, path.sets, bounces, path.kind, distance});
}

/// Hands light to the film, no more of it than a contribution over several bounces may have.
inline void add_clamped(PathSettings const& settings, film::Contribution c,
                        film::SampleSink& sink) {
    float const most = max_component(c.value);
    if (most > settings.indirect_clamp && c.bounces() > 1)
        c.value *= settings.indirect_clamp / most;
    sink.add(c);
}

} // namespace weft::integrator
