// How straight lines pass through null boundaries and media.
#pragma once

#include "integrator/path_state.h"

namespace weft::integrator {

/// A straight line through more surfaces than this is taken as lost: only broken geometry has so
/// many.
inline constexpr uint32_t kMaxCrossings = 1000;

/// Updates `stack` for a ray that crosses the surface at `point` towards `direction`.
void cross_boundary(world::World const& world, shading::SurfacePoint const& point,
                    Vec3 const& direction, media::MediumStack& stack);

/// The part of light that the media along a ray let through, where `World::visibility` is not 0:
/// boundaries of nothing and hidden ones only change the medium, any other that is met takes all
/// light. `stack` is brought to the ray's end. Partial opacity is decided by `alpha_seed`.
Color media_transmittance(world::World const& world, world::Ray ray, media::MediumStack& stack,
                          uint32_t alpha_seed);

/// What surrounds the point `p`: the closed objects that it lies in, found by a ray from it.
media::MediumStack media_at(world::World const& world, Vec3 const& p);

} // namespace weft::integrator
