#include "image/layers.h"
#include "post/apply.h"
#include "post/denoise.h"

namespace weft::post {

namespace {

/// Returns a guide: the picture that is named for it, or else the layer of the input that is called
/// as such usually are; empty where there is none.
image::Image guide(Inputs const& inputs, scene::ImageId named, scene::ImageId input,
                   std::string const& usual) {
    return named ? inputs.colors(named) : inputs.layer(input, usual);
}

} // namespace

Applied apply(scene::Denoising const& d, Inputs const& inputs) {
    auto const& channels = inputs.channels(d.input);
    image::Image const color = inputs.colors(d.input),
                       albedo =
                           guide(inputs, d.albedo, d.input, image::find_albedo_layer(channels)),
                       normal = unpack_normals(
                           guide(inputs, d.normal, d.input, image::find_normal_layer(channels))),
                       kept = inputs.layer(d.input, image::find_kept_layer(channels));
    auto const given = [](image::Image const& image) {
        return image.pixels.empty() ? nullptr : &image;
    };
    DenoiseOptions options;
    options.backend = d.backend;
    options.quality = d.quality;
    options.memory = d.memory;
    Denoised result = denoise({&color, given(albedo), given(normal), given(kept)}, options);
    return {std::move(result.image), "denoising (" + std::string(backend_name(result.backend)) +
                                         (result.lacks_weights ? ", balanced)" : ")")};
}

} // namespace weft::post
