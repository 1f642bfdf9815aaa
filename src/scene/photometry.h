// What a lamp sends in each direction, as a laboratory has measured it (CIE and IES type C: planes
// that share the vertical axis).
#pragma once

#include <cstddef>
#include <vector>

#include "base/error.h"

namespace weft::scene {

/// Luminous intensity over a grid of directions. Between its angles it is bilinear; above the last
/// and below the first vertical angle it is 0.
struct Photometry {
    std::vector<float> vertical;   ///< degrees from straight down, ascending in [0, 180]; >= 2
    std::vector<float> horizontal; ///< degrees: {0}, the same all around; or ascending, 0 to 360
    std::vector<float> candela;    ///< >= 0; plane after plane: [horizontal][vertical]
    float lamp_lumens = -1;        ///< of all lamps, as rated; -1: not told (absolute photometry)
    float watts = 0;               ///< electric

    float at(size_t h, size_t v) const { return candela[h * vertical.size() + v]; }
};

/// Throws InputError at `where` for anything that the comments above exclude.
void validate(Photometry const& lamp, SourceLocation const& where);

} // namespace weft::scene
