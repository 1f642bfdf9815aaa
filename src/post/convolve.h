// Convolution of a picture with a large kernel, by fast Fourier transforms (OpenImageIO's, which
// are kissfft's).
//
// Beyond its borders the picture goes on as its mirror image. So nothing is lost there and nothing
// darkens: the sum over the picture is that of before, and a picture of one colour stays as it is.
// The transforms are over twice the width and twice the height; sizes with large prime factors take
// longer. Memory: about 16 floats for each of those pixels.
#pragma once

#include <vector>

#include "image/image.h"

namespace weft::post {

/// A kernel that is even in x and y, by its weights at 0 <= x <= width and 0 <= y <= height of the
/// picture: weights[y * (width + 1) + x]. The scale does not matter: it is made to sum to 1.
struct EvenKernel {
    int width = 0, height = 0;
    std::vector<float> weights;
};

/// Convolves one channel in place: width * height finite values. Their sum changes by at most 1e-5
/// of itself, and single values have errors of some 1e-7 of the root mean square of all.
void convolve(std::vector<float>& values, EvenKernel const& kernel);

} // namespace weft::post
