#include "post/denoise_parts.h"

#include <cassert>

#include "post/exposure.h"

namespace weft::post {

DenoisedParts denoise_parts(std::span<image::Image const> parts, DenoiseInput guides,
                            DenoiseOptions const& options) {
    assert(!parts.empty());
    image::Image sum = image::make_image(parts[0].width, parts[0].height, 3);
    for (image::Image const& part : parts) {
        if (part.width != sum.width || part.height != sum.height || part.channels != 3)
            throw InputError("the parts of a picture expect one size and 3 channels");
        for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += sane(part.pixels[i]);
    }
    DenoisedParts result;
    auto denoised = [&](image::Image const& color) {
        guides.color = &color;
        Denoised d = denoise(guides, options);
        result.backend = d.backend;
        result.lacks_weights |= d.lacks_weights;
        return std::move(d.image);
    };
    result.whole = denoised(sum);
    guides.kept = nullptr; // which says nothing about single parts
    for (image::Image const& part : parts) result.parts.push_back(denoised(part));
    for (size_t i = 0; i < sum.pixels.size(); ++i) {
        double total = 0;
        for (image::Image const& part : result.parts) total += double(part.pixels[i]);
        double const whole = double(result.whole.pixels[i]);
        for (image::Image& part : result.parts)
            part.pixels[i] = total > 0 ? float(double(part.pixels[i]) * (whole / total))
                                       : float(whole / double(parts.size()));
    }
    return result;
}

} // namespace weft::post
