// Reinhard, Stark, Shirley and Ferwerda 2002, "Photographic Tone Reproduction for Digital Images",
// equation 3; Drago, Myszkowski, Annen and Chiba 2003, "Adaptive Logarithmic Mapping For Displaying
// High Contrast Scenes", equation 4 for a display whose maximum is 1.
#include <algorithm>
#include <cmath>
#include <span>

#include "post/apply.h"
#include "schema/text.h"

namespace weft::post {

namespace {

/// Whatever is no light (negative, not a number) stays what it is.
float reinhard(float c) {
    if (!(c > 0)) return c;
    return std::isinf(c) ? 1 : c / (1 + c);
}

/// The factor that a pixel of luminance `l` is scaled by; `largest` is the picture's.
float drago(float l, float largest, float bias) {
    if (!(l > 0) || !(largest > 0)) return 1;
    l = std::min(l, largest);
    float const power = std::pow(l / largest, std::log(bias) / std::log(0.5f));
    return std::log1p(l) / (std::log10(1 + largest) * std::log(2 + 8 * power) * l);
}

/// Returns the luminance of a pixel's colours: three, or one of a grey picture.
float luminance_of(std::span<float const> pixel) {
    return pixel.size() == 3 ? luminance(Color(pixel[0], pixel[1], pixel[2])) : pixel[0];
}

} // namespace

Applied apply(scene::Tonemap const& tonemap, Inputs const& inputs) {
    image::Image image = inputs.colors(tonemap.input);
    int const colors = image.channels >= 3 ? 3 : 1;
    auto const for_each_pixel = [&](auto const& f) {
        for (size_t i = 0; i < image.pixels.size(); i += size_t(image.channels))
            f(std::span(&image.pixels[i], size_t(colors)));
    };
    switch (tonemap.curve) {
    case scene::ToneOperator::reinhard:
        for_each_pixel([](std::span<float> pixel) {
            for (float& c : pixel) c = reinhard(c);
        });
        break;
    case scene::ToneOperator::drago: {
        float largest = 0;
        for_each_pixel([&](std::span<float> pixel) {
            if (float const l = luminance_of(pixel); std::isfinite(l))
                largest = std::max(largest, l);
        });
        for_each_pixel([&](std::span<float> pixel) {
            float const scale = drago(luminance_of(pixel), largest, tonemap.bias);
            for (float& c : pixel) c *= scale;
        });
        break;
    }
    }
    return {std::move(image),
            "tonemap (" + std::string(schema::TextForm<scene::ToneOperator>::write(tonemap.curve)) +
                ")"};
}

} // namespace weft::post
