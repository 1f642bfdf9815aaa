// Linear interpolation in small tables whose nodes are equally spaced over [0, 1] of each axis.
#pragma once

#include "base/vec.h"

namespace weft::lobes {

/// Where a coordinate lies on an axis of `nodes` nodes: node `index` and the fraction `t` of the
/// way to the next. Coordinates outside [0, 1] are taken at the bound, NaN at 0.
struct TableCell {
    int index;
    float t;
    TableCell(float coordinate, int nodes) {
        float const x = std::min(std::max(0.f, coordinate), 1.f) * float(nodes - 1);
        index = std::min(int(x), nodes - 2);
        t = x - float(index);
    }
};

/// Along one axis.
template <class T>
float interpolate(T const* table, TableCell const& c) {
    return lerp(float(table[c.index]), float(table[c.index + 1]), c.t);
}

/// Along several, slowest first: each axis but the last is preceded by the values in one step of
/// it.
template <class T, class... Faster>
float interpolate(T const* table, int stride, TableCell const& c, Faster const&... faster) {
    T const* const slab = table + c.index * stride;
    return lerp(interpolate(slab, faster...), interpolate(slab + stride, faster...), c.t);
}

} // namespace weft::lobes
