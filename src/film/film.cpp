#include "film/film.h"

#include <algorithm>

namespace weft::film {

uint32_t Film::least_samples() const {
    auto const fewest =
        std::min_element(pixels_.begin(), pixels_.end(), [](PixelSum const& a, PixelSum const& b) {
            return a.samples < b.samples;
        });
    return fewest == pixels_.end() ? 0 : fewest->samples;
}

image::Image Film::mean() const {
    image::Image image = image::make_image(region_.width(), region_.height(), 3);
    for (size_t i = 0; i < pixels_.size(); ++i) {
        PixelSum const& p = pixels_[i];
        if (p.samples == 0) continue;
        double const scale = 1.0 / p.samples;
        image.pixels[3 * i] = float(p.r * scale);
        image.pixels[3 * i + 1] = float(p.g * scale);
        image.pixels[3 * i + 2] = float(p.b * scale);
    }
    return image;
}

} // namespace weft::film
