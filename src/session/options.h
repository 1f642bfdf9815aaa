// What a render is told: what picture to make, when to end, and who watches.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "film/film.h"
#include "session/tiles.h"

namespace weft::session {

/// All that decides which value a sample has, in words: {"seed", "0"}, ... Renders whose identities
/// are equal make the same samples.
using Identity = std::vector<std::pair<std::string, std::string>>;

struct Progress {
    double fraction = 0;           ///< in [0, 1]
    double samples_per_second = 0; ///< pixel samples
    double seconds = 0;            ///< since the start
    double seconds_left = 0;       ///< estimate; not a number while there is none
    uint32_t samples_done = 0;     ///< per pixel, in whole passes
    std::optional<double> noise{}; ///< reached, where it is looked at: the worst block's error
};

struct RenderState;

/// Is called with the render's state again and again, from a thread of its own. The threads of the
/// render stand still only while the state is copied.
struct Watcher {
    double interval = 60; ///< seconds between calls
    std::function<void(RenderState const&)> look;
};

/// Decides which samples the picture is made of.
struct PictureOptions {
    std::optional<film::Region> crop; ///< pixels of the whole picture; none: all
    uint32_t seed = 0;
    std::vector<film::Aov> aovs; ///< beside those that the scene asks for
    bool half_sums = false;      ///< the film keeps the sums that error estimates need
    Part part;                   ///< of the picture; a part has a film of the whole's size
    std::string version, kernel; ///< of the program, of the ray kernel where pinned: for `identify`
};

/// Decides when the render ends: at the limit that is reached first. 0 is no limit.
struct Limits {
    int spp = 0;      ///< samples per pixel; 0: what the scene says, or a large number where there
                      ///< is another limit
    double noise = 0; ///< the render ends when the estimated relative error is below this
    double seconds = 0; ///< of wall time; the render ends after them, but not before every pixel
                        ///< has a sample
    std::atomic<bool> const* cancel = nullptr; ///< set to stop before the next sample
};

inline bool is_cancelled(Limits const& limits) {
    return limits.cancel && limits.cancel->load(std::memory_order_relaxed);
}

/// Who watches the render. Nobody changes a pixel.
struct Observers {
    std::vector<Watcher> watchers;
    /// Called a few times a second, by one thread at a time.
    std::function<void(Progress const&)> on_progress;
    bool profile = false; ///< tell processor time by feature
};

struct RenderOptions {
    PictureOptions picture;
    Limits limits;
    Observers observers;
    int threads = 0;                     ///< 0: one per processor
    int tile_size = 32;                  ///< pixels
    Identity identity;                   ///< that the states seen by watchers carry; may be empty
    RenderState const* resume = nullptr; ///< goes on from here; its identity and part are the same
};

} // namespace weft::session
