// Renders one job: the only place that owns threads. The picture is cut into tiles and the samples
// into passes; neither changes a pixel's value.
//
// However many samples a pixel has, they are its first ones: none is left out or made twice. So a
// render can stop between any two samples and go on (`resume`), be made by several machines
// (`part`), or give pixels different numbers of samples (`noise`, session/adaptive.h), and each
// sample is what it would have been anyway.
//
// Whoever wants something of a render that goes on is answered before the next sample of each
// thread, whatever the pass: `cancel`, the end of the time, and a watcher that wants a copy.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/profiler.h"
#include "image/image.h"
#include "session/plan.h"

namespace weft::session {

/// Which samples the pass at hand makes.
struct PassState {
    uint32_t to = 0;             ///< pixels get the samples before this one
    std::vector<uint8_t> active; ///< a byte per block of session/adaptive.h; empty: all
    friend bool operator==(PassState const&, PassState const&) = default;
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
    image::Image image;         ///< the beauty: linear RGB of the region
    film::Film film;            ///< all channels
    PassState pass;             ///< the last one, which may not be whole
    uint32_t least_samples = 0; ///< that every pixel has; 0: some pixels are black for want of any
    double seconds = 0;         ///< of this and the renders that it resumed
    double pixel_samples = 0;   ///< in the film
    double samples_per_second = 0;
    bool cancelled = false; ///< the user stopped it before it had all that was wanted
    StoppedBy stopped_by = StoppedBy::samples;
    std::optional<double> noise; ///< reached, where it was asked for
    Profile profile;             ///< of this render's passes, where it was asked for
    uint64_t bad_samples = 0;
    std::vector<BadSample> first_bad_samples; ///< in pixel order, at most 4
    /// Of this render alone: whose paths were in more objects at once than media::MediumStack
    /// holds.
    uint64_t lost_samples = 0;
};

/// `options` are those that the plan was made with; observers, identity and a state to resume may
/// have joined them since. Throws InputError where memory cannot hold the picture.
RenderResult render(Plan const& plan, RenderOptions const& options);

/// Plans and renders. Throws InputError where either does.
RenderResult render(lights::Stage const& stage, scene::RenderJob const& job,
                    RenderOptions const& options);

} // namespace weft::session
