#include "post/denoise.h"

#include <algorithm>
#include <array>

#include "post/exposure.h"
#include "post/network.h"
#include "post/nlm.h"
#include "post/oidn.h"
#include "post/weights.h"

namespace weft::post {

namespace {

void check_size(char const* what, image::Image const& image, image::Image const& color) {
    if (image.channels < 3)
        throw InputError(std::string("the ") + what + " expects 3 channels, found " +
                         std::to_string(image.channels));
    if (image.width == color.width && image.height == color.height) return;
    auto size = [](image::Image const& i) {
        return std::to_string(i.width) + " x " + std::to_string(i.height);
    };
    throw InputError(std::string("the ") + what + " expects the size of the picture, " +
                     size(color) + ", found " + size(image));
}

/// "a, b or c"
std::string list(std::vector<std::string> const& names) {
    std::string text;
    for (size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
    return text;
}

Denoised denoise_rest(DenoiseInput const& input, DenoiseOptions const& options) {
    image::Image rest = image::make_image(input.color->width, input.color->height, 3), kept = rest;
    for (int y = 0; y < rest.height; ++y)
        for (int x = 0; x < rest.width; ++x)
            for (int c = 0; c < 3; ++c) {
                float const light = sane(input.color->at(x, y, c));
                kept.at(x, y, c) = std::min(sane(input.kept->at(x, y, c)), light);
                rest.at(x, y, c) = light - kept.at(x, y, c);
            }
    Denoised result = denoise({&rest, input.albedo, input.normal}, options);
    for (size_t i = 0; i < kept.pixels.size(); ++i) result.image.pixels[i] += kept.pixels[i];
    return result;
}

} // namespace

std::string_view backend_name(Backend backend) { return choices(backend)[size_t(backend)]; }

Denoised denoise(DenoiseInput const& input, DenoiseOptions const& options) {
    check_size("picture", *input.color, *input.color);
    if (input.albedo) check_size("albedo", *input.albedo, *input.color);
    if (input.normal) check_size("normal", *input.normal, *input.color);
    if (input.kept) {
        check_size("light to keep", *input.kept, *input.color);
        return denoise_rest(input, options);
    }
    bool const any = options.backend == Backend::automatic;
    if (any || options.backend == Backend::oidn) {
        OidnLibrary const library(options.oidn_libraries);
        if (library)
            return {denoise_oidn(library, input, options.quality, options.memory), Backend::oidn};
        if (!any)
            throw InputError(
                "the backend 'oidn' expects Intel Open Image Denoise to be installed: " +
                library.problem() + ". 'network' and 'nlm' do without it");
    }
    if (any || options.backend == Backend::network) {
        auto const folders = weight_folders(options.weights);
        for (Quality quality = options.quality;; quality = Quality::balanced) {
            if (auto const paths = find_weights(weights_files(input, quality), folders))
                return {denoise_network(input, *paths, options.memory), Backend::network,
                        quality != options.quality};
            if (quality == Quality::balanced) break;
        }
        if (!any)
            throw InputError("the backend 'network' expects the file " +
                             weights_files(input, options.quality).color + " in " + list(folders) +
                             ", found none: tools/setup denoise downloads it; 'nlm' does "
                             "without it");
    }
    return {denoise_nlm(input), Backend::nlm};
}

image::Image unpack_normals(image::Image const& picture) {
    auto const& from = picture.pixels;
    image::Image normals = picture;
    if (std::any_of(from.begin(), from.end(), [](float x) { return x < 0; })) return normals;
    size_t const stride = size_t(picture.channels);
    for (size_t i = 0; i + 3 <= from.size(); i += stride)
        if (from[i] != 0 || from[i + 1] != 0 || from[i + 2] != 0)
            for (size_t c = 0; c < 3; ++c) normals.pixels[i + c] = 2 * from[i + c] - 1;
    return normals;
}

} // namespace weft::post
