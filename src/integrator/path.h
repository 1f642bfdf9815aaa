// The path tracer: unidirectional, with next-event estimation and multiple importance sampling
// (Kajiya 1986; Veach 1997, chapters 8 to 10).
#pragma once

#include "film/contribution.h"
#include "integrator/path_state.h"
#include "scene/render_settings.h"

namespace weft::integrator {

struct PathSettings {
    scene::Strategy strategy = scene::Strategy::mis;
    uint32_t depth = 16;         ///< vertices seen along a path; the first hit is 1
    uint32_t roulette_depth = 3; ///< vertices that Russian roulette leaves alone
    float footprint_scale = 1;   ///< see world::footprint_scale
    bool full_materials = false; ///< without stand-ins for secondary rays
};

/// Follows one path from the camera and hands every contribution to `sink`. `media`: what the
/// camera is in.
void trace_path(world::World const& world, PathSettings const& settings, world::Ray const& ray,
                media::MediumStack const& media, sampling::SampleStream const& u,
                film::SampleSink& sink);

} // namespace weft::integrator
