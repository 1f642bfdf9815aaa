#include "image/image.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

namespace weft::image {

namespace {

constexpr uint64_t kMaxFloats = uint64_t(1) << 32;

/// The PNG library tells of a truncated file on stderr by itself, so its chunks are walked first:
/// each is a big-endian length, a name, as many bytes and a check sum; the last is IEND.
void check_png_end(std::string const& path) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::fopen(path.c_str(), "rb"),
                                                               std::fclose);
    unsigned char head[8];
    if (!file || std::fread(head, 1, 8, file.get()) != 8 ||
        std::memcmp(head, "\x89PNG\r\n\x1a\n", 8) != 0)
        return;
    std::fseek(file.get(), 0, SEEK_END);
    long const size = std::ftell(file.get());
    for (long at = 8; at + 12 <= size;) {
        std::fseek(file.get(), at, SEEK_SET);
        if (std::fread(head, 1, 8, file.get()) != 8) break;
        if (std::memcmp(head + 4, "IEND", 4) == 0) return;
        at += 12 + (long(head[0]) << 24 | long(head[1]) << 16 | long(head[2]) << 8 | head[3]);
    }
    throw InputError({path}, "truncated: expected the last chunk of a PNG, found none in " +
                                 std::to_string(size) + " bytes");
}

std::unique_ptr<OIIO::ImageInput> open_image(std::string const& path) {
    // Told apart here because OpenImageIO's own message differs by format.
    if (std::FILE* const file = std::fopen(path.c_str(), "rb"))
        std::fclose(file);
    else
        throw InputError({path}, std::string("cannot open the image: ") + std::strerror(errno));
    check_png_end(path);
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1; // as stored
    auto input = OIIO::ImageInput::open(path, &config);
    if (!input) {
        std::string reason = OIIO::geterror();
        throw InputError({path}, "expected an image, found none that can be decoded: " + reason);
    }
    return input;
}

bool is_srgb_encoded(OIIO::ImageSpec const& spec) {
    auto const type = spec.format.basetype;
    if (type != OIIO::TypeDesc::UINT8 && type != OIIO::TypeDesc::UINT16) return false;
    std::string const space = spec.get_string_attribute("oiio:ColorSpace");
    return !OIIO::Strutil::iequals(space, "linear") && !OIIO::Strutil::iequals(space, "raw");
}

/// The JPEG library fills what a truncated file lacks with grey and calls it a warning, so the
/// end mark is looked for here. Some cameras append a few kilobytes after it.
void check_jpeg_end(std::string const& path) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::fopen(path.c_str(), "rb"),
                                                               std::fclose);
    std::vector<char> tail(1 << 16);
    std::fseek(file.get(), 0, SEEK_END);
    long const size = std::ftell(file.get());
    std::fseek(file.get(), std::max(0L, size - long(tail.size())), SEEK_SET);
    tail.resize(std::fread(tail.data(), 1, tail.size(), file.get()));
    if (std::string_view(tail.data(), tail.size()).rfind("\xff\xd9") == std::string_view::npos)
        throw InputError({path}, "truncated: expected the end mark of a JPEG, found none in " +
                                     std::to_string(size) + " bytes");
}

} // namespace

Image make_image(int width, int height, int channels) {
    Image image{width, height, channels, {}, false, {}};
    image.pixels.resize(size_t(width) * size_t(height) * size_t(channels));
    return image;
}

Image read_image(std::string const& path) {
    auto const input = open_image(path);
    OIIO::ImageSpec const& spec = input->spec();
    if (spec.deep) throw InputError({path}, "expected a flat image, found a deep one");
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
        throw InputError({path}, "expected an image, found " + std::to_string(spec.width) + " x " +
                                     std::to_string(spec.height) + " x " +
                                     std::to_string(spec.depth) + " pixels of " +
                                     std::to_string(spec.nchannels) + " channels");
    // Two factors below 2^31 times one below 2^16 fit: OpenImageIO's formats hold no more.
    uint64_t const area = uint64_t(spec.width) * uint64_t(spec.height);
    if (area > kMaxFloats / uint64_t(spec.nchannels))
        throw InputError({path}, "expected at most 16 GiB of floats, found " +
                                     std::to_string(spec.width) + " x " +
                                     std::to_string(spec.height) + " pixels of " +
                                     std::to_string(spec.nchannels) + " channels");
    Image image = make_image(spec.width, spec.height, spec.nchannels);
    image.is_srgb_encoded = is_srgb_encoded(spec);
    image.names = spec.channelnames;
    bool const read =
        input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data());
    // For a truncated TIFF the call succeeds, and only the message tells.
    std::string const reason = input->geterror();
    if (!read || !reason.empty())
        throw InputError({path}, "expected " + std::to_string(spec.width) + " x " +
                                     std::to_string(spec.height) +
                                     " pixels, found a damaged or truncated file: " +
                                     reason.substr(0, reason.find('\n')));
    if (std::string_view(input->format_name()) == "jpeg") check_jpeg_end(path);
    return image;
}

Metadata read_metadata(std::string const& path) {
    auto const input = open_image(path);
    Metadata metadata;
    for (OIIO::ParamValue const& p : input->spec().extra_attribs)
        if (p.type() == OIIO::TypeString) metadata[p.name().string()] = p.get_string();
    return metadata;
}

} // namespace weft::image
