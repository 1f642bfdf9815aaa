// Denoises pictures that sum to one: the light of each lamp, say, which somebody will mix anew.
//
// Denoised one by one they would not sum to the denoised whole, for no denoiser is linear. So the
// sum is denoised, and each part; then the parts are scaled, in each pixel and channel, by what
// makes their sum that of the whole:
//
//     part_i' = D(part_i) * D(sum of parts) / sum of D(parts)
//
// Black stays black where a part is black all around, and the whole looks as it does without
// parts. Where all parts were denoised to 0 and the whole was not, they share it evenly.
#pragma once

#include <span>

#include "post/denoise.h"

namespace weft::post {

struct DenoisedParts {
    image::Image whole;
    std::vector<image::Image> parts; ///< their sum is `whole`, to the rounding of floats
    Backend backend = Backend::nlm;
    bool lacks_weights = false; ///< as of `Denoised`
};

/// Denoises the parts. `guides` has albedo and normal, and the light that the sum is to keep; its
/// colour is not read. Throws as `denoise` does.
DenoisedParts denoise_parts(std::span<image::Image const> parts, DenoiseInput guides,
                            DenoiseOptions const& options);

} // namespace weft::post
