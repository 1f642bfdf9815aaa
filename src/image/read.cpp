#include "image/image.h"

#include <algorithm>

#include "image/parts.h"
#include "image/shown_picture.h"

namespace weft::image {

Image make_image(int width, int height, int channels) {
    Image image{.width = width, .height = height, .channels = channels, .pixels = {}};
    image.pixels.resize(size_t(width) * size_t(height) * size_t(channels));
    return image;
}

namespace {

/// Returns where the three channels of colours are, one after the other, plain or of a layer.
std::vector<size_t> colors_in(std::vector<std::string> const& names) {
    std::vector<size_t> found;
    for (size_t i = 0; i + 3 <= names.size(); ++i) {
        std::string const layer = names[i].substr(0, names[i].rfind('.') + 1);
        if (names[i] == layer + "R" && names[i + 1] == layer + "G" && names[i + 2] == layer + "B")
            found.push_back(i);
    }
    return found;
}

/// Turns the colours of an image into linear Rec. 709.
void convert_colors(Image& image, ColorWords const& words, bool integers) {
    for (size_t const first : colors_in(image.names)) {
        bool const has_alpha =
            integers && first + 3 < image.names.size() && image.names[first + 3] == "A";
        for (size_t i = 0; i < image.pixels.size(); i += size_t(image.channels)) {
            std::span<float> const rgb(&image.pixels[i + first], 3);
            if (integers)
                for (float& x : rgb) x = decoded(words.transfer, x);
            words.convert(rgb);
            if (has_alpha) // as light is stored
                for (float& x : rgb) x *= image.pixels[i + first + 3];
        }
        image.is_srgb_encoded = false;
        image.is_converted = true;
    }
}

Image turned(Image const& image, int orientation) {
    bool const across = orientation > 4;
    Image result = make_image(across ? image.height : image.width,
                              across ? image.width : image.height, image.channels);
    result.is_srgb_encoded = image.is_srgb_encoded;
    result.is_converted = image.is_converted;
    result.names = image.names;
    result.warnings = image.warnings;
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            Vec2i const p = stored_place(orientation, x, y, image.width, image.height);
            std::copy_n(&image.pixels[image.index(p.x, p.y, 0)], image.channels,
                        &result.pixels[result.index(x, y, 0)]);
        }
    return result;
}

Image read_hdr(std::string const& path) {
    ShownPicture file(path, {Transfer::linear});
    Image image = make_image(file.width(), file.height(), 3);
    image.names = {"R", "G", "B"};
    image.warnings = file.warnings();
    image.is_converted = !file.is_as_stored();
    file.read_to(image.height, reinterpret_cast<std::byte*>(image.pixels.data()));
    return image;
}

Image read_part(OIIO::ImageInput& input, int part, std::string const& path) {
    OIIO::ImageSpec const spec = input.spec(part, 0);
    check_flat(spec, path);
    Image image = make_image(spec.width, spec.height, spec.nchannels);
    image.is_srgb_encoded = is_srgb_encoded(spec);
    image.names = spec.channelnames;
    check_read(
        input, path,
        input.read_image(part, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()));
    ColorWords const words = color_words(spec, png_head(path), {Transfer::srgb});
    image.warnings = words.warnings;
    auto const type = spec.format.basetype;
    bool const integers = type == OIIO::TypeDesc::UINT8 || type == OIIO::TypeDesc::UINT16;
    if (words.convert) convert_colors(image, words, integers);
    // Numbers that a PNG says are linear, as OpenImageIO has understood, too.
    if (integers && words.transfer == Transfer::linear) image.is_srgb_encoded = false;
    if (int const o = spec.get_int_attribute("Orientation", 1); o > 1 && o <= 8)
        return turned(image, o);
    return image;
}

/// Puts the channels of a part beside those of the image, which has room for them from `first` on.
void put_part(Image const& part, int first, Image& image) {
    for (size_t i = 0; i < image.pixels.size() / size_t(image.channels); ++i)
        std::copy_n(&part.pixels[i * size_t(part.channels)], part.channels,
                    &image.pixels[i * size_t(image.channels) + size_t(first)]);
}

Image read_parts(OIIO::ImageInput& input, FileParts const& parts, std::string const& path) {
    uint64_t channels = 0;
    for (size_t i = 0; i < parts.specs.size(); ++i)
        if (parts.joins(i)) channels += uint64_t(parts.specs[i].nchannels);
    OIIO::ImageSpec whole = parts.specs[parts.picture];
    whole.nchannels = int(std::min<uint64_t>(channels, 1u << 16));
    check_flat(whole, path);
    Image image = make_image(whole.width, whole.height, whole.nchannels);
    for (size_t i = 0; i < parts.specs.size(); ++i) {
        if (!parts.joins(i)) {
            image.apart.push_back(parts.names[i]);
            continue;
        }
        Image const part = read_part(input, int(i), path);
        put_part(part, int(image.names.size()), image);
        image.names.insert(image.names.end(), parts.channels[i].begin(), parts.channels[i].end());
        image.warnings.insert(image.warnings.end(), part.warnings.begin(), part.warnings.end());
        image.is_converted |= part.is_converted;
    }
    return image;
}

} // namespace

Image read_image(std::string const& path) {
    if (HdrFile::has_signature(path)) return read_hdr(path);
    auto const input = open_image(path);
    FileParts const parts = parts_of(*input);
    Image image =
        parts.specs.size() == 1 ? read_part(*input, 0, path) : read_parts(*input, parts, path);
    check_end(*input, path);
    return image;
}

Image read_part(std::string const& path, std::string const& name) {
    auto const input = open_image(path);
    FileParts const parts = parts_of(*input);
    auto const found = std::find(parts.names.begin(), parts.names.end(), name);
    if (found == parts.names.end()) throw InputError({path}, "expected a part '" + name + "'");
    return read_part(*input, int(found - parts.names.begin()), path);
}

namespace {

Texture opaque_texture() {
    return Texture::in_memory({TexelType::u8, 1, Transfer::linear}, 1, 1, {std::byte(0xff)});
}

} // namespace

Texture read_texture(ImageSource const& source, Encoding encoding, Channels channels,
                     std::vector<std::string>* warnings) {
    ShownPicture file(source, encoding, channels);
    if (!file.has_channels()) return opaque_texture();
    if (warnings)
        for (std::string const& w : file.warnings()) warnings->push_back(source.path + ": " + w);
    std::vector<std::byte> texels(size_t(file.width()) * size_t(file.height()) *
                                  file.format().bytes());
    file.read_to(file.height(), texels.data());
    return Texture::in_memory(file.format(), file.width(), file.height(), std::move(texels));
}

Metadata read_metadata(std::string const& path) {
    auto const input = open_image(path);
    Metadata metadata;
    for (OIIO::ParamValue const& p : input->spec().extra_attribs)
        if (p.type() == OIIO::TypeString) metadata[p.name().string()] = p.get_string();
    return metadata;
}

} // namespace weft::image
