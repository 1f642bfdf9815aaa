// The lat-long (equirectangular) map between directions and the unit square, in one place: the
// environment, its sampler and the texture coordinates of the sphere all share it.
//
//   u = 1/2 - atan2(z, x) / (2 pi)    +x at the centre; -x at both ends; u falls from +x to +z
//   v = theta / pi, cos theta = y     0 at +y, 1 at -y
//
// v is measured from +y. Whether an image's top row belongs at v = 0 or at v = 1 is the caller's
// decision; nothing here flips.
#pragma once

#include "base/vec.h"

namespace weft {

/// (u, v) in [0, 1]^2 of the direction `d` of any length but 0. At the poles u is arbitrary but
/// finite. theta is taken by atan2, which keeps its digits near the poles where acos loses half.
inline Vec2 direction_to_uv(Vec3 const& d) {
    float const u = 0.5f - std::atan2(d.z, d.x) * (0.5f * kInvPi);
    float const v = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y) * kInvPi;
    return {u, v};
}

/// The unit direction at (u, v) in [0, 1]^2.
inline Vec3 uv_to_direction(Vec2 uv) {
    float const phi = (0.5f - uv.x) * (2 * kPi), theta = uv.y * kPi;
    float const r = std::sin(theta);
    return {r * std::cos(phi), std::cos(theta), r * std::sin(phi)};
}

} // namespace weft
