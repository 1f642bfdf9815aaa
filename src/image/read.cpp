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

namespace {

Texture opaque_texture() {
    return Texture::in_memory({TexelType::u8, 1, Transfer::linear}, 1, 1, {std::byte(0xff)});
}

} // namespace

Texture read_texture(ImageSource const& source, Transfer transfer, Channels channels) {
    std::string_view const bytes = source.bytes.value_or("");
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    auto const input =
        source.bytes ? open_flat_image(memory, source.path) : open_flat_image(source.path);
    OIIO::ImageSpec const& spec = input->spec();
    bool const alpha = channels == Channels::alpha;
    if (alpha && spec.alpha_channel < 0) return opaque_texture();
    TexelFormat const format = texel_format(spec, transfer, channels);
    int const first = alpha ? spec.alpha_channel : 0;
    std::vector<std::byte> texels(size_t(spec.width) * size_t(spec.height) * format.bytes());
    check_read(*input, source.path,
               input->read_image(0, 0, first, first + format.channels, oiio_type(format.type),
                                 texels.data()));
    if (source.bytes)
        check_end(*input, memory, source.path);
    else
        check_end(*input, source.path);
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
