// How straight lines pass through null boundaries and media.
#pragma once

#include "media/medium_stack.h"
#include "world/world.h"

namespace weft::integrator {

/// A straight line through more surfaces than these is taken for lost: only broken geometry has so
/// many.
inline constexpr uint32_t kMaxCrossings = 1000;

/// Returns the part of light that the media along a ray let through, and brings `stack` to the
/// ray's end. Surfaces that cannot be seen only change the medium; any other passable one takes all
/// light. Only for rays along which `World::visibility` is not 0. `alpha_seed` decides whether
/// surfaces of partial opacity are there.
Color media_transmittance(world::World const& world, world::Ray ray, media::MediumStack& stack,
                          uint32_t alpha_seed);

} // namespace weft::integrator
