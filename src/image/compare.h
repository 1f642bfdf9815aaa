// How far an image is from a reference.
//
// Over all pixels. Colours come first: those of the picture (find_colors in layers.h), else the
// first three channels where there are three or more, the first where there are one or two (grey,
// grey and alpha). All other channels are compared one by one, by their names. With a the image and
// b the reference, in double precision; a value that is not finite in either is counted and left
// out, unless both are the same.
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

/// Of the colours. Throws InputError where the sizes or the numbers of colour channels differ.
Difference compare(Image const& image, Image const& reference);

/// Of a channel that both have, or of one that only one has.
struct ChannelDifference {
    std::string name;
    bool in_image = true, in_reference = true;
    Difference difference; ///< where both have it
};

/// Of all channels that `compare` leaves out, in the order of the reference and then of the image.
/// With `colors`, of all channels. Throws InputError where the sizes differ.
std::vector<ChannelDifference> compare_channels(Image const& image, Image const& reference,
                                                bool colors = false);

/// a - b in each colour channel, signed. Throws like `compare`.
Image difference_image(Image const& image, Image const& reference);

} // namespace weft::image
