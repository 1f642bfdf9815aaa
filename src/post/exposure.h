// How bright a picture is, as one number: so that denoising does not depend on its exposure.
#pragma once

#include <cmath>

#include "image/image.h"

namespace weft::post {

/// Returns a channel of a colour as light: 0 where it is negative or not finite.
inline float sane(float x) { return std::isfinite(x) && x > 0 ? x : 0.f; }

/// Returns the scale that brings the geometric mean of the luminance of blocks of about 16 x 16
/// pixels to 0.18 (Reinhard et al. 2002; blocks, since single pixels are noise). Black blocks do
/// not count; 1 where all are black. The first three channels are linear RGB.
float auto_exposure(image::Image const& color);

} // namespace weft::post
