// One sample traced again, event by event: for the pixel that is too bright, or not a number.
#pragma once

#include <string>

#include "film/path_log.h"
#include "lights/stage.h"
#include "scene/job.h"

namespace weft::session {

struct ReplayOptions {
    Vec2i pixel{0, 0}; ///< of the whole picture
    uint32_t sample = 0, seed = 0;
    int spp = 0; ///< of the render in question, where textures are filtered by it; 0: the scene's
};

struct Replay {
    Color value; ///< as the render had it
    film::PathLog events;
};

/// Traces one sample again. Throws InputError for a pixel outside of the picture and for an
/// integrator that follows no light.
Replay replay(lights::Stage const& stage, scene::RenderJob const& job,
              ReplayOptions const& options);

/// Returns a text for a terminal: each vertex with its object and material, how the path went on,
/// and what light it gained there.
std::string replay_text(lights::Stage const& stage, Replay const& replay);

} // namespace weft::session
