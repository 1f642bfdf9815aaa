// What a render is going to make: all that is known before its first sample, worked out once.
#pragma once

#include <span>

#include "film/sample_record.h"
#include "lights/stage.h"
#include "scene/job.h"
#include "session/options.h"

namespace weft::session {

/// Refers to the stage and the job, which outlive it.
struct Plan {
    lights::Stage const& stage;
    scene::RenderJob const& job;
    film::Region region;       ///< the pixels that are rendered
    film::SceneTags tags;      ///< the names that the film's channels are made of
    film::Layout layout;       ///< the film's channels
    uint32_t samples = 0;      ///< that a pixel gets at most
    int footprint_samples = 0; ///< per pixel, that footprints of textures are made for
};

/// Throws InputError where the crop lies outside of the picture, or AOVs are asked of an integrator
/// that follows no light.
Plan make_plan(lights::Stage const& stage, scene::RenderJob const& job,
               RenderOptions const& options);

/// Returns the samples per pixel that a job asks for.
int sample_count(scene::Sampler const& sampler);

/// Returns the AOVs that a job asks for.
std::span<film::Aov const> wanted_aovs(scene::Integrator const& integrator);

/// Returns the samples that a pixel gets at most.
uint32_t sample_limit(scene::RenderJob const& job, Limits const& limits);

/// Returns the identity of the render. `scene_hash` is that of the job's scene
/// (scene/scene_hash.h); `options.picture.kernel` counts as the user gave it.
Identity identify(Plan const& plan, RenderOptions const& options, uint64_t scene_hash);

/// Returns "seed is 1 here and 0 there; ...", or "" where the two are equal.
std::string difference(Identity const& here, Identity const& there);

} // namespace weft::session
