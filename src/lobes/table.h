// Interpolation in small tables whose nodes are equally spaced over [0, 1] of each axis. Cubic
// (Lagrange, by the four nearest nodes) for what is looked up once per surface point; linear for
// what every evaluation asks.
#pragma once

#include <array>

#include "base/vec.h"

namespace weft::lobes {

/// Where a coordinate lies on an axis of at least 4 nodes: the first of the four nodes around it,
/// and their weights. Coordinates outside [0, 1] are taken at the bound, NaN at 0.
struct CubicCell {
    int first;
    std::array<float, 4> weights;
    CubicCell(float coordinate, int nodes) {
        float const x = std::min(std::max(0.f, coordinate), 1.f) * float(nodes - 1);
        first = std::min(std::max(int(x) - 1, 0), nodes - 4);
        float const t = x - float(first), a = t - 1, b = t - 2, c = t - 3;
        weights = {a * b * c * (-1 / 6.f), t * b * c * 0.5f, t * a * c * -0.5f,
                   t * a * b * (1 / 6.f)};
    }
};

namespace detail {

/// Adds `weight` times the four nodes around the place on the fastest axis.
template <class T>
void add_nodes(std::array<float, 4>& sum, float weight, T const* table, CubicCell const& c) {
    for (size_t i = 0; i < 4; ++i) sum[i] += weight * float(table[size_t(c.first) + i]);
}
template <class T, class... Faster>
void add_nodes(std::array<float, 4>& sum, float weight, T const* table, CubicCell const& c,
               int stride, Faster const&... faster) {
    for (int i = 0; i < 4; ++i)
        add_nodes(sum, weight * c.weights[size_t(i)], table + (c.first + i) * stride, faster...);
}

template <class Only>
Only const& last_of(Only const& only) {
    return only;
}
template <class First, class... Rest>
decltype(auto) last_of(First const&, Rest const&... rest) {
    return last_of(rest...);
}

} // namespace detail

/// Along several axes, slowest first: each cell but the last is followed by the values in one step
/// of its axis.
template <class T, class... Cells>
float interpolate(T const* table, Cells const&... cells) {
    std::array<float, 4> sum{};
    detail::add_nodes(sum, 1.f, table, cells...);
    auto const& w = detail::last_of(cells...).weights;
    return (sum[0] * w[0] + sum[1] * w[1]) + (sum[2] * w[2] + sum[3] * w[3]);
}

/// The node before a coordinate in [0, 1] and the fraction `t` of the way to the next.
struct LinearCell {
    int index;
    float t;
    LinearCell(float coordinate, int nodes) {
        float const x = std::min(std::max(0.f, coordinate), 1.f) * float(nodes - 1);
        index = std::min(int(x), nodes - 2);
        t = x - float(index);
    }
};

/// Along one axis.
template <class T>
float interpolate(T const* table, LinearCell const& c) {
    return lerp(float(table[c.index]), float(table[c.index + 1]), c.t);
}
/// Along two, the slower one of `stride` values a step first.
template <class T>
float interpolate(T const* table, LinearCell const& slow, int stride, LinearCell const& fast) {
    T const* const row = table + slow.index * stride;
    return lerp(interpolate(row, fast), interpolate(row + stride, fast), slow.t);
}

} // namespace weft::lobes
