// Bloom (scene/bloom.h) of a scene-linear picture.
//
// glare: out = (1 - strength) in + strength (K * in). K is what Spencer, Shirley, Zimmerman and
// Greenberg 1995, "Physically-Based Glare Effects for Digital Images", give for the eye in daylight
// (photopic): of their components the two wide ones, 0.478 f1 + 0.138 f2 with f1 = 20.91 / (t +
// 0.02)^3, f2 = 72.37 / (t + 0.02)^2 and t in degrees, integrated over each pixel and scaled to the
// sum 1. Their narrow f0 is the part that stays: it is smaller than a pixel. Left out: the flare
// lines of the lens' fibres, the lenticular halo of dark-adapted eyes, and colour fringes.
//
// threshold: out = in + intensity G * b, with b = in max(0, m - threshold) / m, m the pixel's
// largest channel and G a Gaussian. This gains light.
//
// Beyond its borders the picture goes on as its mirror image (post/convolve.h). A pixel that is not
// finite is left as it is and scatters nothing.
#pragma once

#include "image/image.h"
#include "post/convolve.h"
#include "scene/bloom.h"

namespace weft::post {

/// Returns K for a picture of that size, in pixels, whose width is `fov` degrees.
EvenKernel glare_kernel(int width, int height, float fov);
/// Returns a Gaussian that ends at `radius` pixels; `sigma` is in pixels, too.
EvenKernel gaussian_kernel(int width, int height, float sigma, int radius);

/// Returns the picture with bloom in its first three channels, or in the first where there are
/// fewer; the others stay as they are. Does not read `bloom.input` and `bloom.image`.
image::Image apply_bloom(scene::Bloom const& bloom, image::Image const& image);

} // namespace weft::post
