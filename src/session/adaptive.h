// Where a picture still needs samples: decided at the end of a pass, by blocks of pixels, from the
// film alone, so that tiles, threads and the clock have no say.
//
// A pixel's error is estimated from the two halves of its samples, even and odd: the square of
// half their difference has the variance of the mean as its expectation (where strata run through
// both halves, less is true, and the estimate is on the safe side). It is relative: divided by the
// pixel's brightness b where that is above the picture's typical brightness t, and by sqrt(b t)
// where it is below. That is how a screen shows it, whose values go with about the square root of
// light: the same error is as easily seen in all that is darker than t. What is below a hundredth
// of t counts as if it had that, as sRGB is straight below 0.003 (t is to be shown as 0.18). Cycles
// divides by sqrt(b) everywhere, of light as it is. By b alone, pixels that are nearly black, such
// as those that the filter's tail reaches over an edge, would take up to a hundred times the
// samples for what nobody sees. b is that of the darker half: what a bright sample adds to the
// other is error, and would hide itself if it counted as brightness.
//
// A block's error is the root of the mean square of its pixels: a single pixel that a rare path
// found keeps its whole block alive, which the mean of the errors (Dammertz et al. 2010, "A
// hierarchical automatic stopping condition for Monte Carlo global illumination") would smooth
// away.
//
// Where light comes by rare paths, most blocks have found none of it yet and look calm. What the
// blocks around them have found says how often such paths are: the errors of blocks that few of
// their pixels make are shared out evenly over windows of blocks, and a block's error is no less
// than the share of any window around it. Few are pixels whose effective number (Kish 1965, "Survey
// Sampling": (sum x)^2 / sum x^2, x their squares) is below kFew of the block's; normal noise has a
// third or more. So noise of the common kind stays where it is. Light that no sample of a window
// has found remains unknown.
//
// A stop that looks at the samples favours those that happen to look calm, and a calm pixel is
// rather too dark than too bright. Three things keep that bias far below the noise: no decision
// before kLeastSamples, none by fewer pixels than those of a block and the eight around it, and
// passes that grow with the number of samples, so that there are few decisions.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "film/film.h"

namespace weft::session {

inline constexpr int kBlock = 8;              ///< pixels
inline constexpr uint32_t kLeastSamples = 32; ///< before anything is decided
inline constexpr double kDarkest = 0.01;      ///< of the typical brightness
inline constexpr double kFew = 0.1;           ///< of a block's pixels

/// One number per block of a region, row by row from its corner.
struct BlockGrid {
    explicit BlockGrid(film::Region const& r)
        : region(r), columns((r.width() + kBlock - 1) / kBlock),
          rows((r.height() + kBlock - 1) / kBlock) {}
    size_t size() const { return size_t(columns) * size_t(rows); }
    size_t index(int x, int y) const {
        return size_t((y - region.from.y) / kBlock) * size_t(columns) +
               size_t((x - region.from.x) / kBlock);
    }
    film::Region block(size_t index) const;

    film::Region region;
    int columns, rows;
};

/// Returns (mean of the square roots of the pixels' brightness)^2: what a picture's middling parts
/// have, whatever few very bright pixels there are. 0 where `stop`, asked once per row, said so.
double typical_brightness(
    film::Film const& film, std::function<bool()> const& stop = [] { return false; });

/// The estimated relative error of each block: its own, or the share of what few pixels make in the
/// windows of 3, 5 and 9 blocks a side around it. Needs a film with half sums. Large pictures take
/// a while: `stop` is asked once per row of pixels or blocks, and the result is empty where it said
/// so.
std::vector<float> block_errors(
    film::Film const& film, std::function<bool()> const& stop = [] { return false; });

/// Which blocks need more samples for a relative error of `noise`: those beyond it and the eight
/// around each, unless their pixels have `limit` samples.
std::vector<uint8_t> active_blocks(film::Film const& film, std::vector<float> const& errors,
                                   double noise, uint32_t limit);

/// Pixel samples that are likely to be needed yet, if errors go on to fall with the square root of
/// the samples.
double samples_needed(film::Film const& film, std::vector<float> const& errors, double noise,
                      uint32_t limit);

/// The end of the pass that starts at sample `from`, where decisions are to be taken: 1, 2, 4, ...
/// 32, and then half as many again each time, even numbers all but the first.
uint32_t adaptive_pass_end(uint32_t from, uint32_t limit);

} // namespace weft::session
