// What a path is told, and what it carries from vertex to vertex.
#pragma once

#include "film/contribution.h"
#include "lights/stage.h"
#include "media/medium_stack.h"
#include "sampling/stream.h"
#include "scene/render_settings.h"

namespace weft::integrator {

/// What a scattering by lobes of these flags is called.
film::Bounce bounce_kind(lobes::LobeFlags flags);

struct PathSettings {
    scene::Strategy strategy = scene::Strategy::mis;
    uint32_t depth = 16;         ///< vertices seen along a path; the first hit is 1
    uint32_t roulette_depth = 3; ///< vertices that Russian roulette leaves alone
    float footprint_scale = 1;   ///< see world::footprint_scale
    bool full_materials = false; ///< without stand-ins for secondary rays
    bool controls = true;        ///< lights and objects heed theirs; else the rest is off, too
    bool by_part = false;        ///< these tell diffuse from glossy scattering
    uint32_t light_samples = 1;  ///< lights chosen at once where a path scatters first
    bool caustics = true, secondary_specular = true;
    float secondary_roughness = 0;
    float indirect_clamp = kInfinity;
};

struct PathState {
    world::Ray ray;
    Color throughput{1};
    media::MediumStack media;
    film::PathSignature signature;
    float held_out = 0;     ///< part of what the camera sees that holdouts took
    bool scattered = false; ///< by something else than mirrors and clear glass
    bool diffused = false;  ///< by a diffuse surface or a medium
    bool caustic = false;   ///< and then by a mirror, glass or gloss last

    // The last scattering, for weighing what the ray finds against what light sampling finds.
    float pdf = 0;       ///< of the ray's direction; 0: delta or camera, which nothing else finds
    lights::LitPoint at; ///< where it was; the camera where there was none
    uint64_t sets = 0;   ///< of instances that it belongs to
    world::RayKind kind = world::RayKind::camera;
    float eta_scale = 1; ///< undoes the radiance scaling of refraction for roulette
};

/// The kind of ray that leaves a surface, scattered diffusely or not, to the other side or not.
inline world::RayKind scattering_kind(lobes::LobeFlags flags, bool through) {
    if (through) return world::RayKind::transmission;
    if (any(flags, lobes::LobeFlags::Subsurface)) return world::RayKind::subsurface;
    return any(flags, lobes::LobeFlags::Diffuse) ? world::RayKind::diffuse : world::RayKind::glossy;
}

/// How many lights to choose at once where the path, as it got there, scatters next.
inline uint32_t light_choices(PathSettings const& settings, PathState const& path) {
    return path.scattered ? 1 : settings.light_samples;
}

/// A place where a path scatters: a surface with lobes, or a point in a medium with a phase
/// function. `direct` treats both alike.
struct ScatterPoint {
    lights::LitPoint at;
    Vec3 wo{0, 0, 1};
    lobes::Bsdf const* bsdf = nullptr; ///< of a surface
    shading::SurfacePoint const* surface = nullptr;
    float g = 0;             ///< of a medium
    uint64_t sets = 0;       ///< of instances that it belongs to
    float reach = kInfinity; ///< what is further away is not there

    lobes::LobeValue eval(Vec3 const& wi) const;
    /// Where a ray towards `wi` starts.
    Vec3 origin(Vec3 const& wi) const {
        return surface ? shading::offset_origin(*surface, wi) : at.p;
    }
};

} // namespace weft::integrator
