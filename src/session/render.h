// Renders one job: the only place that owns threads. The picture is cut into tiles and the
// samples into passes; neither changes a pixel's value.
//
// A pixel has its first samples, however many: no sample is left out or made twice. So a render can
// stop and go on (`resume`), be made by several machines (`part`), or give pixels different numbers
// of samples (`noise`, session/adaptive.h), and each sample is what it would have been anyway.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/profiler.h"
#include "film/film.h"
#include "image/image.h"
#include "lights/stage.h"
#include "scene/job.h"
#include "session/tiles.h"

namespace weft::session {

struct Progress {
    double fraction = 0;           ///< in [0, 1]
    double samples_per_second = 0; ///< pixel samples
    double seconds = 0;            ///< since the start
    double seconds_left = 0;       ///< estimate; not a number while there is none
    uint32_t samples_done = 0;     ///< per pixel, in whole passes
    std::optional<double> noise{}; ///< reached, where it is looked at: the worst block's error
};

/// Which samples the pass at hand makes.
struct PassState {
    uint32_t to = 0;             ///< pixels get the samples before this one
    std::vector<uint8_t> active; ///< a byte per block of session/adaptive.h; empty: all
    friend bool operator==(PassState const&, PassState const&) = default;
};

struct RenderState;

/// Looks at the render now and then, from a thread of its own, while tiles are rendered on.
struct Watcher {
    double interval = 60; ///< seconds
    std::function<void(RenderState const&)> look;
};

struct RenderOptions {
    int spp = 0;                      ///< samples per pixel; 0: what the scene says
    std::optional<film::Region> crop; ///< pixels of the whole picture
    int threads = 0;                  ///< 0: one per processor
    uint32_t seed = 0;
    int tile_size = 32;          ///< pixels
    std::vector<film::Aov> aovs; ///< beside those that the scene asks for
    bool half_sums = false;      ///< the film keeps the sums that error estimates need
    Part part;                   ///< of the picture; a part has a film of the whole's size
    double noise = 0;   ///< > 0: until the estimated relative error is below this (then `spp`, or
                        ///< else a large number, is where a pixel stops at the latest)
    double seconds = 0; ///< > 0: whole passes until the time is up (`spp` as for `noise`)
    std::string version, kernel; ///< of the program, of the ray kernel where pinned: for `identify`
    RenderState const* resume = nullptr; ///< goes on from here; its identity and part are the same
    std::vector<Watcher> watchers;
    std::function<void(Progress const&)>
        on_progress;      ///< called a few times a second, by one thread at a time
    bool profile = false; ///< tell processor time by feature
    std::atomic<bool> const* cancel = nullptr; ///< set to stop within a row of a tile
};

/// A sample whose value was not finite, or negative light; it counts as black.
struct BadSample {
    Vec2i pixel;
    uint32_t sample;
    Color value;
};

/// Why a render ended.
enum class StoppedBy { samples, noise, time, user };

struct RenderResult {
    image::Image image; ///< the beauty: linear RGB of the region
    film::Film film;    ///< all channels
    PassState pass;     ///< the last one, which may not be whole
    film::SceneTags tags;
    film::Region region;
    uint32_t samples = 0;       ///< per pixel that were wanted
    uint32_t least_samples = 0; ///< that every pixel has; 0: some pixels are black for want of any
    double seconds = 0;         ///< of this and the renders that it resumed
    double pixel_samples = 0;   ///< in the film
    double samples_per_second = 0;
    bool cancelled = false;
    StoppedBy stopped_by = StoppedBy::samples;
    std::optional<double> noise; ///< reached, where it was asked for
    Profile profile;             ///< of this render's passes, where it was asked for
    uint64_t bad_samples = 0;
    std::vector<BadSample> first_bad_samples; ///< in pixel order, at most 4
};

/// Samples per pixel that a job asks for.
int sample_count(scene::Sampler const& sampler);

/// The AOVs that a job asks for.
std::span<film::Aov const> wanted_aovs(scene::Integrator const& integrator);

/// The pixels that are rendered. Throws InputError where the crop lies outside of the picture.
film::Region region_of(world::World const& world, RenderOptions const& options);

/// The channels that the film will have. Throws InputError where AOVs are asked of an integrator
/// that follows no light.
film::Layout make_layout(lights::Stage const& stage, scene::RenderJob const& job,
                         RenderOptions const& options);

/// The samples per pixel that the render makes at most.
uint32_t sample_limit(scene::RenderJob const& job, RenderOptions const& options);

/// The samples per pixel that texture footprints are made for.
int footprint_samples(scene::RenderJob const& job, RenderOptions const& options);

/// Everything about a result that a state file keeps, its film moved out.
RenderState to_state(RenderResult&& result, lights::Stage const& stage, scene::RenderJob const& job,
                     RenderOptions const& options);

/// Throws InputError where the crop lies outside of the picture, memory cannot hold it, or AOVs are
/// asked of an integrator that follows no light.
RenderResult render(lights::Stage const& stage, scene::RenderJob const& job,
                    RenderOptions const& options);

} // namespace weft::session
