// What a path carries from vertex to vertex.
#pragma once

#include "film/path_signature.h"
#include "integrator/tracer.h"
#include "media/medium_stack.h"

namespace weft::integrator {

/// The last vertex where the path was scattered. What its ray finds is weighed by it against what
/// light sampling finds there.
struct LastScattering {
    lights::LitPoint at; ///< where; the camera's place before the first scattering
    /// Density of the ray's direction per solid angle. 0 where no other strategy finds what the ray
    /// finds: behind the camera, mirrors and clear glass.
    float pdf = 0;
    RayKind kind = RayKind::camera; ///< of the ray
    uint64_t sets = 0;              ///< of instances that the vertex belongs to, as bits
};

struct PathState {
    world::Ray ray;           ///< towards the next vertex
    media::MediumStack media; ///< what the ray is in
    Color throughput{1};      ///< part of the light from the ray's end that the camera sees
    float eta_scale = 1;      ///< times `throughput`: without the radiance scaling of refraction
    LastScattering last;
    film::PathSignature signature; ///< how the path was scattered so far
    shading::Look look;            ///< how it looks at the materials ahead
    /// Straight pieces so far, the current one included: the number of the random numbers' vertex.
    uint32_t step = 0;
    float held_out = 0;     ///< part of what the camera sees that holdouts took
    bool scattered = false; ///< by something else than mirrors and clear glass
    bool diffused = false;  ///< diffusely, by a surface or a medium
    bool caustic = false;   ///< and after that by a mirror, glass or gloss last

    /// A path that is to follow a camera ray, from within `inside`.
    PathState(PathSettings const& settings, world::Ray const& camera_ray,
              media::MediumStack const& inside);

    /// Returns how often the path was scattered.
    uint32_t bounces() const { return signature.length(); }
};

} // namespace weft::integrator
