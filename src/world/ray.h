// Rays and what they hit.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace weft::world {

struct Ray {
    Vec3 origin{0, 0, 0};
    Vec3 direction{0, 0, 1}; ///< unit
    float t_max = kInfinity;
    float time = 0; ///< in [0, 1] of the shutter interval
};

/// The kernel's answer: which primitive, and where on it.
struct Hit {
    float t = kInfinity;
    uint32_t object = UINT32_MAX; ///< UINT32_MAX: nothing was hit
    uint32_t primitive = 0;
    float u = 0, v = 0; ///< barycentric coordinates of vertices 1 and 2
    explicit operator bool() const { return object != UINT32_MAX; }
};

} // namespace weft::world
