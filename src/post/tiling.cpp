#include "post/tiling.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace weft::post {

AxisTiling tile_axis(int length, int count, TilingRules const& rules) {
    int const a = rules.alignment;
    auto round_up = [&](int x) { return (x + a - 1) / a * a; };
    int const whole = round_up(length);
    AxisTiling axis;
    if (count == 1) {
        axis.size = whole;
        axis.windows = {{0, 0, length}};
        return axis;
    }
    // Rounding a begin down may take one alignment more of the overlap.
    int const overlap = 2 * rules.reach + a;
    axis.size = round_up((whole + (count - 1) * overlap + count - 1) / count);
    if (axis.size >= whole) return tile_axis(length, 1, rules);
    for (int i = 0; i < count; ++i) {
        int const begin = int(int64_t(whole - axis.size) * i / (count - 1)) / a * a;
        axis.windows.push_back({begin, 0, length});
    }
    for (size_t i = 1; i < axis.windows.size(); ++i) {
        Window &before = axis.windows[i - 1], &after = axis.windows[i];
        before.to = after.from = (after.begin + before.begin + axis.size) / 2;
    }
    return axis;
}

Tiling tile_picture(int width, int height, TilingRules const& rules, size_t limit,
                    std::function<size_t(int, int)> const& memory) {
    // Beyond this the windows are little more than their overlap.
    auto most = [&](int length) { return std::max(1, length / (2 * rules.alignment)); };
    Tiling best;
    int64_t least = std::numeric_limits<int64_t>::max();
    int last_rows = std::numeric_limits<int>::max();
    for (int rows = 1; rows <= most(height); ++rows) {
        AxisTiling const y = tile_axis(height, rows, rules);
        if (y.size >= last_rows) break; // no smaller windows follow
        last_rows = y.size;
        int last_columns = std::numeric_limits<int>::max();
        for (int columns = 1; columns <= most(width); ++columns) {
            AxisTiling const x = tile_axis(width, columns, rules);
            if (x.size >= last_columns) break;
            last_columns = x.size;
            int64_t const pixels =
                int64_t(x.size) * int64_t(x.windows.size()) * y.size * int64_t(y.windows.size());
            if (pixels >= least) break; // more columns overlap more
            if (memory(x.size, y.size) > limit) continue;
            least = pixels;
            best = {x, y};
            break;
        }
    }
    return best;
}

} // namespace weft::post
