#include "image/input.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace weft::image {

namespace {

using OIIO::Filesystem::IOProxy;

constexpr uint64_t kMaxFloats = uint64_t(1) << 32;

/// The PNG library tells of a truncated file on stderr by itself, so its chunks are walked first:
/// each is a big-endian length, a name, as many bytes and a check sum; the last is IEND.
void check_png_end(IOProxy& file, std::string const& name) {
    unsigned char head[8];
    if (file.pread(head, 8, 0) != 8 || std::memcmp(head, "\x89PNG\r\n\x1a\n", 8) != 0) return;
    auto const size = int64_t(file.size());
    for (int64_t at = 8; at + 12 <= size;) {
        if (file.pread(head, 8, at) != 8) break;
        if (std::memcmp(head + 4, "IEND", 4) == 0) return;
        at += 12 +
              (int64_t(head[0]) << 24 | int64_t(head[1]) << 16 | int64_t(head[2]) << 8 | head[3]);
    }
    throw InputError({name}, "truncated: expected the last chunk of a PNG, found none in " +
                                 std::to_string(size) + " bytes");
}

/// The JPEG library fills what a truncated file lacks with grey and calls it a warning, so the
/// end mark is looked for here. Some cameras append a few kilobytes after it.
void check_jpeg_end(IOProxy& file, std::string const& name) {
    std::vector<char> tail(1 << 16);
    auto const size = int64_t(file.size());
    tail.resize(
        file.pread(tail.data(), tail.size(), std::max(int64_t(0), size - int64_t(tail.size()))));
    if (std::string_view(tail.data(), tail.size()).rfind("\xff\xd9") == std::string_view::npos)
        throw InputError({name}, "truncated: expected the end mark of a JPEG, found none in " +
                                     std::to_string(size) + " bytes");
}

OIIO::ImageSpec reading_options() {
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1; // as stored
    return config;
}

[[noreturn]] void fail_to_decode(std::string const& name, std::string const& reason) {
    throw InputError({name}, "expected an image, found none that can be decoded: " + reason);
}

} // namespace

void check_flat(OIIO::ImageSpec const& spec, std::string const& name) {
    if (spec.deep) throw InputError({name}, "expected a flat image, found a deep one");
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
        throw InputError({name}, "expected an image, found " + std::to_string(spec.width) + " x " +
                                     std::to_string(spec.height) + " x " +
                                     std::to_string(spec.depth) + " pixels of " +
                                     std::to_string(spec.nchannels) + " channels");
    // Two factors below 2^31 times one below 2^16 fit: OpenImageIO's formats hold no more.
    uint64_t const area = uint64_t(spec.width) * uint64_t(spec.height);
    if (area > kMaxFloats / uint64_t(spec.nchannels))
        throw InputError({name}, "expected at most 16 GiB of floats, found " +
                                     std::to_string(spec.width) + " x " +
                                     std::to_string(spec.height) + " pixels of " +
                                     std::to_string(spec.nchannels) + " channels");
}

std::unique_ptr<OIIO::ImageInput> open_image(std::string const& path) {
    // Told apart here because OpenImageIO's own message differs by format.
    if (std::FILE* const file = std::fopen(path.c_str(), "rb"))
        std::fclose(file);
    else
        throw InputError({path}, std::string("cannot open the image: ") + std::strerror(errno));
    OIIO::Filesystem::IOFile file(path, IOProxy::Read);
    check_png_end(file, path);
    OIIO::ImageSpec const config = reading_options();
    auto input = OIIO::ImageInput::open(path, &config);
    if (!input) fail_to_decode(path, OIIO::geterror());
    return input;
}

std::unique_ptr<OIIO::ImageInput> open_flat_image(std::string const& path) {
    auto input = open_image(path);
    check_flat(input->spec(), path);
    return input;
}

std::unique_ptr<OIIO::ImageInput> open_flat_image(OIIO::Filesystem::IOMemReader& memory,
                                                  std::string const& name) {
    char head[4] = {};
    memory.pread(head, sizeof head, 0);
    std::string_view const start(head, sizeof head);
    bool const png = start == "\x89PNG", jpeg = start.starts_with("\xff\xd8");
    if (!png && !jpeg) throw InputError({name}, "expected a PNG or JPEG image, found none");
    check_png_end(memory, name);
    auto input = OIIO::ImageInput::create(png ? "png" : "jpeg");
    OIIO::ImageSpec spec;
    if (!input || !input->set_ioproxy(&memory) || !input->open(name, spec, reading_options()))
        fail_to_decode(name, input ? input->geterror() : OIIO::geterror());
    check_flat(spec, name);
    return input;
}

void check_read(OIIO::ImageInput& input, std::string const& path, bool succeeded) {
    // For a truncated TIFF the call succeeds, and only the message tells.
    std::string const reason = input.geterror();
    OIIO::ImageSpec const& spec = input.spec();
    if (!succeeded || !reason.empty())
        throw InputError({path}, "expected " + std::to_string(spec.width) + " x " +
                                     std::to_string(spec.height) +
                                     " pixels, found a damaged or truncated file: " +
                                     reason.substr(0, reason.find('\n')));
}

void check_end(OIIO::ImageInput const& input, std::string const& path) {
    if (std::string_view(input.format_name()) != "jpeg") return;
    OIIO::Filesystem::IOFile file(path, IOProxy::Read);
    check_jpeg_end(file, path);
}

void check_end(OIIO::ImageInput const& input, OIIO::Filesystem::IOMemReader& memory,
               std::string const& name) {
    if (std::string_view(input.format_name()) == "jpeg") check_jpeg_end(memory, name);
}

bool is_srgb_encoded(OIIO::ImageSpec const& spec) {
    auto const type = spec.format.basetype;
    if (type != OIIO::TypeDesc::UINT8 && type != OIIO::TypeDesc::UINT16) return false;
    std::string const space = spec.get_string_attribute("oiio:ColorSpace");
    return !OIIO::Strutil::iequals(space, "linear") && !OIIO::Strutil::iequals(space, "raw");
}

TexelFormat texel_format(OIIO::ImageSpec const& spec, Transfer transfer, Channels channels) {
    TexelFormat format;
    format.channels = channels == Channels::color && spec.nchannels >= 3 ? 3 : 1;
    auto const type = spec.format.basetype;
    format.type = type == OIIO::TypeDesc::UINT8    ? TexelType::u8
                  : type == OIIO::TypeDesc::UINT16 ? TexelType::u16
                  : type == OIIO::TypeDesc::HALF   ? TexelType::f16
                                                   : TexelType::f32;
    if (channels == Channels::color && is_srgb_encoded(spec)) format.transfer = transfer;
    return format;
}

OIIO::TypeDesc oiio_type(TexelType type) {
    switch (type) {
    case TexelType::u8:
        return OIIO::TypeDesc::UINT8;
    case TexelType::u16:
        return OIIO::TypeDesc::UINT16;
    case TexelType::f16:
        return OIIO::TypeDesc::HALF;
    case TexelType::f32:
        return OIIO::TypeDesc::FLOAT;
    }
    return OIIO::TypeDesc::FLOAT;
}

} // namespace weft::image
