// Renders one job: the only place that owns threads. The picture is cut into tiles and the
// samples into passes; neither changes a pixel's value.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "film/film.h"
#include "image/image.h"
#include "io/scene_file.h"
#include "world/world.h"

namespace weft::session {

struct Progress {
    double fraction = 0;           ///< in [0, 1]
    double samples_per_second = 0; ///< pixel samples
    double seconds = 0;            ///< since the start
    double seconds_left = 0;       ///< estimate
    uint32_t samples_done = 0;     ///< per pixel, in whole passes
};

struct RenderOptions {
    int spp = 0;                      ///< samples per pixel; 0: what the scene says
    std::optional<film::Region> crop; ///< pixels of the whole picture
    int threads = 0;                  ///< 0: one per processor
    uint32_t seed = 0;
    int tile_size = 32;          ///< pixels
    std::vector<film::Aov> aovs; ///< beside those that the scene asks for
    bool half_sums = false;      ///< the film keeps the sums that error estimates need
    std::function<void(Progress const&)>
        on_progress; ///< called a few times a second, by one thread at a time
    std::atomic<bool> const* cancel = nullptr; ///< set to stop within a row of a tile
};

/// A sample whose value was not finite, or negative light; it counts as black.
struct BadSample {
    Vec2i pixel;
    uint32_t sample;
    Color value;
};

struct RenderResult {
    image::Image image; ///< the beauty: linear RGB of the region
    film::Film film;    ///< all channels
    film::SceneTags tags;
    film::Region region;
    uint32_t samples = 0;       ///< per pixel that were wanted
    uint32_t least_samples = 0; ///< that every pixel has; 0: some pixels are black for want of any
    double seconds = 0;
    double pixel_samples = 0; ///< that were made
    bool cancelled = false;
    uint64_t bad_samples = 0;
    std::vector<BadSample> first_bad_samples; ///< in pixel order, at most 4
};

/// Samples per pixel that a job asks for.
int sample_count(scene::Sampler const& sampler);

/// The AOVs that a job asks for.
std::span<film::Aov const> wanted_aovs(scene::Integrator const& integrator);

/// Throws InputError where the crop lies outside of the picture, memory cannot hold it, or AOVs are
/// asked of an integrator that follows no light.
RenderResult render(world::World const& world, io::RenderJob const& job,
                    RenderOptions const& options);

} // namespace weft::session
