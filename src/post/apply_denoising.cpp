#include "post/apply.h"
#include "post/denoise.h"

namespace weft::post {

Applied apply(scene::Denoising const& denoising, Inputs const& inputs) {
    DenoiseInput input{inputs.find(denoising.input), inputs.find(denoising.albedo), nullptr};
    image::Image normal;
    if (image::Image const* picture = inputs.find(denoising.normal)) {
        normal = unpack_normals(*picture);
        input.normal = &normal;
    }
    DenoiseOptions options;
    options.backend = denoising.backend;
    options.quality = denoising.quality;
    options.memory = denoising.memory;
    Denoised result = denoise(input, options);
    return {std::move(result.image), "denoising (" + std::string(backend_name(result.backend)) +
                                         (result.lacks_weights ? ", balanced)" : ")")};
}

} // namespace weft::post
