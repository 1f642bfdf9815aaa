// Reinhard, Stark, Shirley and Ferwerda 2002, "Photographic Tone Reproduction for Digital Images",
// equation 3; Drago, Myszkowski, Annen and Chiba 2003, "Adaptive Logarithmic Mapping For Displaying
// High Contrast Scenes", equation 4 for a display whose maximum is 1.
#include <algorithm>
#include <cmath>

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

/// The luminance of each pixel; grey pictures have one channel.
float luminance_at(image::Image const& image, size_t pixel, int colors) {
    float const* p = &image.pixels[pixel * size_t(image.channels)];
    return colors == 3 ? luminance(Color(p[0], p[1], p[2])) : p[0];
}

} // namespace

Applied apply(scene::Tonemap const& tonemap, Inputs const& inputs) {
    image::Image image = *inputs.find(tonemap.input);
    int const colors = image.channels >= 3 ? 3 : 1;
    size_t const count = size_t(image.width) * size_t(image.height);
    float largest = 0;
    for (size_t i = 0; i < count; ++i)
        if (float const l = luminance_at(image, i, colors); std::isfinite(l))
            largest = std::max(largest, l);
    for (size_t i = 0; i < count; ++i) {
        float* p = &image.pixels[i * size_t(image.channels)];
        float const scale = drago(luminance_at(image, i, colors), largest, tonemap.bias);
        for (int c = 0; c < colors; ++c)
            p[c] = tonemap.curve == scene::ToneOperator::reinhard ? reinhard(p[c]) : p[c] * scale;
    }
    return {std::move(image),
            "tonemap (" + std::string(schema::TextForm<scene::ToneOperator>::write(tonemap.curve)) +
                ")"};
}

} // namespace weft::post
