// Linear interpolation in small tables whose nodes are equally spaced over [0, 1] of each axis.
#pragma once

#include "base/vec.h"

namespace weft::lobes {

/// Where a coordinate lies on an axis of `nodes` nodes: node `index` and the fraction `t` of the
/// way to the next. Coordinates outside [0, 1] are taken at the bound.
struct TableCell {
    int index;
    float t;
    TableCell(float coordinate, int nodes) {
        float const x = std::min(std::max(coordinate, 0.f), 1.f) * float(nodes - 1);
        index = std::min(int(x), nodes - 2);
        t = x - float(index);
    }
};

/// Along one axis.
template <class T>
float interpolate(T const* table, TableCell const& c) {
    return lerp(float(table[c.index]), float(table[c.index + 1]), c.t);
}

/// Rows of `columns` values.
template <class T>
float interpolate(T const* table, int columns, TableCell const& row, TableCell const& column) {
    T const* const first = table + row.index * columns;
    return lerp(interpolate(first, column), interpolate(first + columns, column), row.t);
}

} // namespace weft::lobes
