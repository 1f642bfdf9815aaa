// Light that a path's ray finds by itself, weighed against what light sampling finds of it.
#pragma once

#include "integrator/vertex.h"

namespace weft::integrator {

/// Adds the emission of a surface that the ray met.
void add_emission(Tracer const& t, PathState const& path, SurfaceVertex const& surface);

/// Adds the light of lamps of some size that the ray meets before `limit`, seen through the medium
/// that it is in.
void add_lamps(Tracer const& t, PathState const& path, float limit);

/// Adds the light from infinitely far away along a ray that met nothing.
void add_background(Tracer const& t, PathState const& path);

} // namespace weft::integrator
