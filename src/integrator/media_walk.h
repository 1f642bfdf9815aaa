// How straight lines pass through null boundaries and media.
#pragma once

#include "media/medium_stack.h"
#include "world/world.h"

namespace weft::integrator {

/// A straight line through more surfaces than these is taken for lost: only broken geometry has so
/// many.
inline constexpr uint32_t kMaxCrossings = 1000;

/// Updates `stack` for a ray that crosses the surface at `point` towards `direction`.
void cross_boundary(world::World const& world, shading::SurfacePoint const& point,
                    Vec3 const& direction, media::MediumStack& stack);

/// Returns the part of light that the media along a ray let through, and brings `stack` to the
/// ray's end. Surfaces that cannot be seen only change the medium; any other passable one takes all
/// light. Only for rays along which `World::visibility` is not 0. `alpha_seed` decides whether
/// surfaces of partial opacity are there.
Color media_transmittance(world::World const& world, world::Ray ray, media::MediumStack& stack,
                          uint32_t alpha_seed);

/// Returns the closed objects that the point `p` lies in, found by a ray from it.
media::MediumStack media_at(world::World const& world, Vec3 const& p);

} // namespace weft::integrator
