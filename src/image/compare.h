// How far an image is from a reference.
//
// Over all pixels and the colour channels alone: the first three where there are three or more,
// the first where there are one or two (grey, grey and alpha). With a the image and b the
// reference, in double precision; a value that is not finite in either is counted and left out.
#pragma once

#include "image/image.h"

namespace weft::image {

struct Difference {
    double mse = 0;        ///< mean of (a - b)^2
    double rel_mse = 0;    ///< mean of (a - b)^2 / (b^2 + 0.01)
    double mae = 0;        ///< mean of |a - b|
    double me = 0;         ///< mean of a - b: its magnitude is the bias that noise does not explain
    double max = 0;        ///< largest |a - b|
    size_t non_finite = 0; ///< values that are not finite in either image
};

/// Throws InputError where the sizes or the numbers of colour channels differ.
Difference compare(Image const& image, Image const& reference);

/// a - b in each colour channel, signed. Throws like `compare`.
Image difference_image(Image const& image, Image const& reference);

} // namespace weft::image
