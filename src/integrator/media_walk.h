// How straight lines pass through null boundaries and media.
#pragma once

#include "integrator/path_state.h"

namespace weft::integrator {

/// Updates `stack` for a ray that crosses the surface at `point` towards `direction`.
void cross_boundary(world::World const& world, shading::SurfacePoint const& point,
                    Vec3 const& direction, media::MediumStack& stack);

/// The part of light that the media along a ray let through, where no opaque surface is in the way:
/// the boundaries that are met only change the medium.
Color media_transmittance(world::World const& world, world::Ray ray, media::MediumStack stack);

/// What surrounds the point `p`: the closed objects that it lies in, found by a ray from it.
media::MediumStack media_at(world::World const& world, Vec3 const& p);

} // namespace weft::integrator
