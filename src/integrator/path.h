// The path tracer: unidirectional, with next-event estimation and multiple importance sampling
// (Kajiya 1986; Veach 1997, chapters 8 to 10).
#pragma once

#include "integrator/tracer.h"

namespace weft::integrator {

/// Follows one path from the camera, which is within `media`, and hands all the light that it finds
/// to the tracer's sink.
void trace_path(Tracer const& t, world::Ray const& camera_ray, media::MediumStack const& media);

} // namespace weft::integrator
