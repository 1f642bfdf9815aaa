// FLIP: what a viewer who flips between two pictures sees change.
//
// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference
// Evaluator for Alternating Images": both pictures are blurred by the contrast sensitivity of the
// eye in YCxCz, clamped to what the screen shows, and compared by the HyAB distance in CIELAB with
// Hunt's adjustment; where edges or points differ (first and second derivatives of a Gaussian of
// the luminance), that counts for more.
//
// HDR-FLIP (Andersson, Nilsson, Shirley and Akenine-Moeller 2021) is the largest LDR-FLIP of a
// pixel over exposures a stop apart at most, from where the brightest pixel of the reference is
// just below white to where its median is, each tone mapped by Narkowicz' curve.
//
// Left out: their other tone mappers, the map of exposures, and weighted histograms.
#pragma once

#include "image/image.h"

namespace weft::post {

/// A screen 0.7 m wide of 3840 pixels, seen from 0.7 m.
inline constexpr float kPixelsPerDegree = 67.0206433f;

/// Returns the error of each pixel, in [0, 1], as a picture of one channel. The images have the
/// same size and the same number of colours: linear RGB, clipped to [0, 1] (grey where there are
/// one or two channels). Throws InputError where they have not.
image::Image ldr_flip(image::Image const& reference, image::Image const& test,
                      float pixels_per_degree = kPixelsPerDegree);

struct HdrFlip {
    image::Image errors;       ///< as of `ldr_flip`
    float start = 0, stop = 0; ///< the exposures, in stops
    int exposures = 0;         ///< how many
};

/// Does the same for light of any brightness; negative and non-finite values count as 0.
HdrFlip hdr_flip(image::Image const& reference, image::Image const& test,
                 float pixels_per_degree = kPixelsPerDegree);

/// Returns the mean of a map of errors: the number that the papers give for a pair of pictures.
double mean_error(image::Image const& errors);

} // namespace weft::post
