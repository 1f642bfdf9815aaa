#include "image/image.h"

#include "image/input.h"
#include "image/texture.h"

namespace weft::image {

Image make_image(int width, int height, int channels) {
    Image image{width, height, channels, {}, false, {}};
    image.pixels.resize(size_t(width) * size_t(height) * size_t(channels));
    return image;
}

Image read_image(std::string const& path) {
    auto const input = open_flat_image(path);
    OIIO::ImageSpec const& spec = input->spec();
    Image image = make_image(spec.width, spec.height, spec.nchannels);
    image.is_srgb_encoded = is_srgb_encoded(spec);
    image.names = spec.channelnames;
    check_read(
        *input, path,
        input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()));
    check_end(*input, path);
    return image;
}

Texture read_texture(std::string const& path, Transfer transfer) {
    auto const input = open_flat_image(path);
    OIIO::ImageSpec const& spec = input->spec();
    TexelFormat const format = texel_format(spec, transfer);
    std::vector<std::byte> texels(size_t(spec.width) * size_t(spec.height) * format.bytes());
    check_read(*input, path,
               input->read_image(0, 0, 0, format.channels, oiio_type(format.type), texels.data()));
    check_end(*input, path);
    return Texture::in_memory(format, spec.width, spec.height, std::move(texels));
}

Metadata read_metadata(std::string const& path) {
    auto const input = open_image(path);
    Metadata metadata;
    for (OIIO::ParamValue const& p : input->spec().extra_attribs)
        if (p.type() == OIIO::TypeString) metadata[p.name().string()] = p.get_string();
    return metadata;
}

} // namespace weft::image
