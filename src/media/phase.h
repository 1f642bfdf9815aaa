// Phase functions: how a medium scatters. Henyey and Greenstein 1941. Directions leave the
// scattering point; g > 0 scatters forwards, so that wi is likely to be near -wo.
#pragma once

#include "base/frame.h"
#include "base/warp.h"

namespace weft::media {

/// Density of scattering from `wo` to `wi` per solid angle; also the phase function's value.
inline float henyey_greenstein(float cos_wo_wi, float g) {
    float const d = 1 + g * g + 2 * g * cos_wo_wi;
    return (kInvPi / 4) * (1 - g * g) / (d * safe_sqrt(d));
}

/// A direction with exactly that density.
inline Vec3 sample_henyey_greenstein(Vec3 const& wo, float g, Vec2 u) {
    // The inverse of the distribution, (1 + g^2 - s^2) / (2 g) with s = (1 - g^2) / (1 + g t),
    // without its division by g.
    float const t = 2 * u.x - 1, d = 1 + g * t;
    float const cosine = 0.5f * (g + (2 * t + g * (t * t + 2 - g * g)) / (d * d)); // to -wo
    float const cos_theta = std::clamp(cosine, -1.f, 1.f);
    float const sin_theta = safe_sqrt(1 - cos_theta * cos_theta), phi = 2 * kPi * u.y;
    return Frame(-wo).to_world({sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta});
}

} // namespace weft::media
