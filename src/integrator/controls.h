// Where paths heed the controls of lights, of objects and of the integrator: which objects a ray
// meets, how a material is looked at, and what part of the light that arrives counts. With
// `PathSettings::controls` off, all of it counts.
#pragma once

#include "integrator/path_state.h"

namespace weft::integrator {

/// Returns the objects that a ray of that kind meets.
inline world::RayMask ray_mask(PathSettings const& settings, RayKind kind) {
    return settings.controls ? world::mask_of(kind) : world::kUnruledMask;
}

/// Returns how materials are looked at after smooth scattering, the last of which may have been
/// diffuse.
inline shading::Look look_after(PathSettings const& settings, bool diffused) {
    return {.secondary = !settings.full_materials,
            .least_roughness = settings.secondary_roughness,
            .diffuse_only = diffused && !settings.secondary_specular,
            .fold = settings.fold_normals};
}

/// Returns how many lights to sample at once where the path, as it got there, scatters next.
inline uint32_t light_choices(PathSettings const& settings, PathState const& path) {
    return path.scattered ? 1 : settings.light_samples;
}

/// Returns whether the path comes from the camera and shows something else in the object's place.
inline bool is_matte(PathSettings const& settings, PathState const& path,
                     world::Model const& model) {
    return (model.traits.holdout || model.traits.shadow_catcher) && settings.controls &&
           path.bounces() == 0;
}

/// Returns how far rays see that leave the object.
inline float reach_of(PathSettings const& settings, world::Model const& model) {
    return settings.controls && model.traits.trace_distance > 0 ? model.traits.trace_distance
                                                                : kInfinity;
}

/// Returns the controls of a light; null where no light has any, and for -1, which is no light.
inline lights::LightRules const* rules_of(Tracer const& t, int32_t light) {
    return t.settings.controls && t.lights.has_controls() && light >= 0 ? &t.lights.rules(light)
                                                                        : nullptr;
}

/// Returns the objects that block a light with these controls; 0: none.
inline world::RayMask shadow_mask(PathSettings const& settings, lights::LightRules const* rules) {
    if (!settings.controls) return world::kUnruledMask;
    return rules ? rules->shadow_mask : world::kShadowMask;
}

/// Returns the part of a light that counts where the path's ray met it, `distance` away from the
/// last scattering.
inline float found_factor(Tracer const& t, PathState const& path, int32_t light, float distance) {
    if (path.caustic && !t.settings.caustics) return 0;
    lights::LightRules const* const rules = rules_of(t, light);
    if (!rules) return 1;
    uint32_t const bounces = path.bounces();
    LastScattering const& last = path.last;
    if (bounces > 0 && rules->sampling_alone && (last.pdf > 0 || !rules->shown)) return 0;
    return rules->factor({last.at.p, last.sets, bounces, last.kind, distance});
}

/// Hands light to the film, no more of it than `indirect_clamp` allows after several bounces.
inline void add_clamped(Tracer const& t, film::Contribution c) {
    float const most = max_component(c.value);
    if (most > t.settings.indirect_clamp && c.bounces() > 1)
        c.value *= t.settings.indirect_clamp / most;
    t.sink.add(c);
}

} // namespace weft::integrator
