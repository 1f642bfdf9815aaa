// How a picture is cut into windows that a network sees one at a time, so that memory stays below a
// limit and nothing shows where they meet.
//
// All windows have one size and begin at multiples of the network's alignment, so that its halved
// pictures lie as they do for the whole. They overlap by at least twice its reach; each gives the
// pixels that are further than the reach from its edges (but for the edges of the picture).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace weft::post {

/// A window along one axis: it is [begin, begin + size), and its pixels [from, to) are used.
struct Window {
    int begin, from, to;
};

struct AxisTiling {
    int size = 0; ///< of all windows; a multiple of the alignment, maybe beyond the picture's end
    std::vector<Window> windows;
};

struct TilingRules {
    int alignment = 16;
    int reach = 96; ///< a multiple of the alignment
};

/// Cuts `length` pixels into `count` windows that are as small as can be.
AxisTiling tile_axis(int length, int count, TilingRules const& rules);

struct Tiling {
    AxisTiling x, y;
};

/// Chooses windows with the fewest pixels in all of which each takes at most `limit` bytes, by
/// memory(width, height). Where none is small enough, `x.windows` is empty.
Tiling tile_picture(int width, int height, TilingRules const& rules, size_t limit,
                    std::function<size_t(int width, int height)> const& memory);

} // namespace weft::post
