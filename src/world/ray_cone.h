// The width of what a ray stands for (Akenine-Moeller et al. 2021, "Improved shader and texture
// level of detail using ray cones").
//
// A cone starts as wide as a pixel, or rather as the part of it that one of its samples stands for,
// grows with distance, and opens where a rough surface or a medium spreads the path: n samples of
// density p per solid angle stand for 1 / (n p) each (Bekaert et al. 2003). Textures alone are
// looked up by it.
//
// Left out on purpose: the curvature of mirrors and lenses, and the width of the camera's lens.
// Both leave the cone too narrow but near a focus, and what it then fails to average the samples
// do.
#pragma once

#include "base/vec.h"

namespace weft::world {

struct RayCone {
    float width = 0;  ///< diameter at the ray's origin; with `spread` 0: a ray without width
    float spread = 0; ///< growth of the diameter per unit of distance

    float width_at(float t) const { return width + spread * t; }
};

/// The share of a pixel's width that a sample stands for; not below 1/8, as finer details than that
/// no picture shows (as pbrt-v4 has it).
inline float footprint_scale(int samples_per_pixel) {
    return std::max(0.125f, 1 / std::sqrt(float(std::max(samples_per_pixel, 1))));
}

/// The cone after scattering into a direction sampled with density `pdf` per solid angle (0: a
/// mirror, which keeps it); `scale` from `footprint_scale`.
inline RayCone scattered(RayCone cone, float pdf, float scale) {
    if (!(pdf > 0)) return cone;
    constexpr float widest = 1; // a diffuse reflection at 4 samples per pixel
    float const lobe = 2 * scale / std::sqrt(kPi * pdf);
    return {cone.width, std::max(cone.spread, std::min(lobe, widest))};
}

} // namespace weft::world
