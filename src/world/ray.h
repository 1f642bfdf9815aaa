// Rays and what they hit.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "world/ray_cone.h"
#include "world/ray_kind.h"

namespace weft::world {

struct Ray {
    Vec3 origin{0, 0, 0};
    Vec3 direction{0, 0, 1}; ///< unit
    float t_max = kInfinity;
    /// Hits must lie beyond this. Not 0: the kernel takes a ray that starts in the very plane of
    /// a triangle as hitting it at 0.
    float t_min = 1e-18f;
    float time = 0;              ///< in [0, 1] of the shutter interval
    RayMask mask = kUnruledMask; ///< which objects it meets
    RayCone cone;                ///< for texture lookups where the ray ends
};

/// The kernel's answer: which primitive, and where on it.
struct Hit {
    float t = kInfinity;
    uint32_t object = UINT32_MAX; ///< UINT32_MAX: nothing was hit
    uint32_t primitive = 0;
    float u = 0, v = 0; ///< barycentric coordinates of vertices 1 and 2; x and y of a disk's own
    float time = 0;     ///< of the ray, in [0, 1] of the shutter interval
    explicit operator bool() const { return object != UINT32_MAX; }
};

/// Hits close to another one on the same ray, in no order.
class NearHits {
  public:
    /// Of more than these, the closest are kept.
    static constexpr uint32_t kMost = 31;

    NearHits() {}
    NearHits(NearHits const&) = delete;
    void add(Hit const& hit);
    /// Returns the closest; null where there are none.
    Hit const* closest() const;
    Hit const* begin() const { return all_.data(); }
    Hit const* end() const { return all_.data() + size_; }

  private:
    union { // not initialised: the first size_ are written
        std::array<Hit, kMost> all_;
    };
    uint32_t size_ = 0;
};

/// How many units in the last place a computed position may be off: the chain of transform,
/// interpolation and kernel test, a handful of operations of half a unit each, with room for the
/// kernel's own. Times the largest coordinate that takes part it is a distance.
inline constexpr float kRounding = 8 * std::numeric_limits<float>::epsilon();

} // namespace weft::world
