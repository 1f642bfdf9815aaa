#include "image/compare.h"

#include <algorithm>
#include <cmath>

namespace weft::image {

namespace {

int color_channels(Image const& image) { return image.channels >= 3 ? 3 : 1; }

std::string describe(Image const& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels of " +
           std::to_string(color_channels(image)) + " colour channels";
}

void check_comparable(Image const& a, Image const& b) {
    if (a.width != b.width || a.height != b.height || color_channels(a) != color_channels(b))
        throw InputError("images differ in shape: expected " + describe(b) + ", found " +
                         describe(a));
}

} // namespace

Difference compare(Image const& image, Image const& reference) {
    check_comparable(image, reference);
    Difference d;
    int const colors = color_channels(image);
    size_t count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < colors; ++c) {
                double const a = image.at(x, y, c), b = reference.at(x, y, c);
                if (!std::isfinite(a) || !std::isfinite(b)) {
                    ++d.non_finite;
                    continue;
                }
                double const e = a - b;
                d.mse += e * e;
                d.rel_mse += e * e / (b * b + 0.01);
                d.mae += std::abs(e);
                d.me += e;
                d.max = std::max(d.max, std::abs(e));
                ++count;
            }
    if (count == 0) return d;
    for (double* sum : {&d.mse, &d.rel_mse, &d.mae, &d.me}) *sum /= double(count);
    return d;
}

Image difference_image(Image const& image, Image const& reference) {
    check_comparable(image, reference);
    int const colors = color_channels(image);
    Image result = make_image(image.width, image.height, colors);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < colors; ++c)
                result.at(x, y, c) = image.at(x, y, c) - reference.at(x, y, c);
    return result;
}

} // namespace weft::image
