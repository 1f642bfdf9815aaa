// The path tracer: unidirectional, with next-event estimation and multiple importance sampling
// (Kajiya 1986; Veach 1997, chapters 8 to 10).
#pragma once

#include "film/contribution.h"
#include "integrator/path_state.h"

namespace weft::integrator {

/// Follows one path from the camera and hands every contribution to `sink`. `media`: what the
/// camera is in.
void trace_path(lights::Stage const& stage, PathSettings const& settings, world::Ray const& ray,
                media::MediumStack const& media, sampling::SampleStream const& u,
                film::SampleSink& sink);

} // namespace weft::integrator
