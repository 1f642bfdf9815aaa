// The triangles that opacity filters have met on one ray, so that a point on a shared edge or
// vertex counts once.
//
// Embree's robust kernel decides edge by edge: its test for one triangle gives an edge the negative
// of what it gives in the neighbour, and accepts down to -epsilon (barycentric), which makes meshes
// watertight. Within that band both triangles report the ray, at distances that differ by rounding:
// by 1e-3 and more of the distance where a triangle is far larger than the view. So distances say
// nothing; barycentrics do. A hit repeats an earlier one if one of the two is on an edge or vertex,
// to the kernel's epsilon, that the other triangle has, too (by the corners' positions: meshes may
// double vertices at seams).
//
// The last `capacity` hits are known: where more surfaces than that lie closer together than
// the kernel's order tells apart, an edge may count twice.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "world/ray.h"

namespace weft::world {

/// Some of a triangle's corners, as bits.
using Corners = uint8_t;
inline constexpr Corners kAllCorners = 7;

/// Returns the corners of the edge or vertex that a hit of a triangle is on, or all.
inline Corners triangle_corners(Hit const& hit) {
    // The kernel's own is half of that; the other half is for the rounding of the third coordinate.
    constexpr float epsilon = 4 * std::numeric_limits<float>::epsilon();
    return Corners((1 - hit.u - hit.v > epsilon ? 1 : 0) | (hit.u > epsilon ? 2 : 0) |
                   (hit.v > epsilon ? 4 : 0));
}

class EdgeHits {
  public:
    struct Entry {
        uint32_t object, primitive;
        Corners corners;
        bool passed; ///< what was decided there
    };

    /// The entry that a hit repeats, or null. `has_corners(object, a, corners, b)`: whether those
    /// corners of triangle a are corners of triangle b as well.
    template <class HasCorners>
    Entry const* find(Hit const& hit, Corners corners, HasCorners&& has_corners) const {
        if (corners == kAllCorners && !any_edge_) [[likely]]
            return nullptr;
        for (uint32_t i = 0; i < std::min(count_, capacity); ++i) {
            Entry const& e = entries_[i];
            if (e.object != hit.object || e.primitive == hit.primitive) continue;
            if ((corners != kAllCorners &&
                 has_corners(hit.object, hit.primitive, corners, e.primitive)) ||
                (e.corners != kAllCorners &&
                 has_corners(hit.object, e.primitive, e.corners, hit.primitive)))
                return &e;
        }
        return nullptr;
    }

    void add(Hit const& hit, Corners corners, bool passed) {
        entries_[count_++ % capacity] = {hit.object, hit.primitive, corners, passed};
        any_edge_ |= corners != kAllCorners;
    }

  private:
    static constexpr uint32_t capacity = 16;
    std::array<Entry, capacity> entries_; // not initialised: the first count_ are written
    uint32_t count_ = 0;
    bool any_edge_ = false;
};

} // namespace weft::world
