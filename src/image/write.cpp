#include "image/write.h"

#include "base/color.h"
#include "image/atomic_file.h"
#include "image/output_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <filesystem>
#include <functional>

namespace weft::image {

namespace {

using Fill = std::function<bool(OIIO::ImageOutput&)>;

void write_pixels(std::string const& path, OIIO::ImageSpec const& spec, Fill const& fill) {
    write_file(path, "", [&](OIIO::ImageOutput& output, std::string const& name) {
        return output.open(name, spec) && fill(output);
    });
}

void add_metadata(OIIO::ImageSpec& spec, Metadata const& metadata) {
    for (auto const& [name, value] : metadata) spec.attribute(name, value);
}

void add_header(OIIO::ImageSpec& spec, ExrHeader const& header) {
    add_metadata(spec, header.texts);
    if (header.chromaticities)
        spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                       header.chromaticities->data());
    if (header.world_to_camera)
        spec.attribute("worldtocamera", OIIO::TypeDesc::TypeMatrix, header.world_to_camera->data());
    if (header.full_width == 0) return;
    spec.x = header.x;
    spec.y = header.y;
    spec.full_width = header.full_width;
    spec.full_height = header.full_height;
}

std::vector<std::string> channel_names(Image const& image) {
    if (!image.names.empty()) return image.names;
    switch (image.channels) {
    case 1:
        return {"Y"};
    case 2:
        return {"Y", "A"};
    case 3:
        return {"R", "G", "B"};
    default:
        return {"R", "G", "B", "A"};
    }
}

[[maybe_unused]] bool is_whole(Image const& image) {
    return image.width > 0 && image.height > 0 && image.channels > 0 &&
           image.pixels.size() == image.index(0, image.height, 0);
}

/// Clips with NaN to 0.
float clip(float x) { return x > 0 ? std::min(x, 1.f) : 0; }

uint8_t to_byte(float x) { return uint8_t(clip(x) * 255 + 0.5f); }

/// What write.h describes for PNG, cut to the first `kept` channels.
std::vector<uint8_t> encode_pixels(Image const& image, int kept) {
    bool const has_alpha = image.channels == 2 || image.channels == 4;
    int const colors = has_alpha ? image.channels - 1 : image.channels;
    std::vector<uint8_t> bytes;
    bytes.reserve(image.pixels.size());
    for (size_t i = 0; i < image.pixels.size(); i += size_t(image.channels)) {
        float const* const p = &image.pixels[i];
        float const alpha = has_alpha ? p[colors] : 1;
        // Without alpha in the file the colours stay as they are over black.
        bool const divide = kept > colors && alpha > 0;
        for (int c = 0; c < colors; ++c)
            bytes.push_back(to_byte(
                image.is_srgb_encoded ? p[c] : linear_to_srgb(clip(divide ? p[c] / alpha : p[c]))));
        if (kept > colors) bytes.push_back(to_byte(alpha));
    }
    return bytes;
}

std::string extension_of(std::string const& path) {
    std::string e = std::filesystem::path(path).extension().string();
    std::transform(e.begin(), e.end(), e.begin(),
                   [](char c) { return char(std::tolower(static_cast<unsigned char>(c))); });
    return e;
}

bool is_display_format(std::string const& e) {
    return e == ".png" || e == ".jpg" || e == ".jpeg" || e == ".tif" || e == ".tiff";
}

void require_extension(std::string const& path, std::string const& expected) {
    if (std::string const e = extension_of(path); e != expected)
        throw InputError({path}, "expected the extension '" + expected + "', found '" + e + "'");
}

void check_extension(std::string const& path) {
    std::string const e = extension_of(path);
    if (e == ".exr" || e == ".hdr" || is_display_format(e)) return;
    throw InputError({path}, "expected an image file's extension (.exr, .hdr, .png, .jpg, .tiff), "
                             "found '" +
                                 e + "'");
}

void check_display_channels(std::string const& path, Image const& image) {
    if (image.channels > 4)
        throw InputError({path}, "expected 1 to 4 channels, found " +
                                     std::to_string(image.channels) + "; EXR takes them");
}

void write_display(std::string const& path, Image const& image, Metadata const& metadata) {
    assert(is_whole(image));
    check_display_channels(path, image);
    bool const jpeg = !holds_alpha(path);
    bool const has_alpha = image.channels == 2 || image.channels == 4;
    int const kept = jpeg && has_alpha ? image.channels - 1 : image.channels;
    std::vector<uint8_t> const bytes = encode_pixels(image, kept);
    OIIO::ImageSpec spec(image.width, image.height, kept, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("compression", jpeg ? "jpeg:95" : "zip");
    spec.attribute("jpeg:subsampling", "4:4:4");
    if (extension_of(path).starts_with(".tif"))
        // Or else OpenImageIO writes the time of day, and an empty date is no TIFF.
        spec.attribute("DateTime", "1970:01:01 00:00:00");
    else
        // Not in TIFF: it would go to an EXIF directory, with which OpenImageIO 2.4 writes a file
        // that it cannot read.
        spec.attribute("oiio:ColorSpace", "sRGB");
    add_metadata(spec, metadata);
    write_pixels(path, spec, [&](OIIO::ImageOutput& output) {
        return output.write_image(OIIO::TypeDesc::UINT8, bytes.data());
    });
}

void write_hdr(std::string const& path, Image const& image, Metadata const& metadata) {
    assert(is_whole(image));
    check_display_channels(path, image);
    // RGBE has three channels and neither negative nor unbounded numbers.
    std::vector<float> rgb;
    rgb.reserve(size_t(image.width) * size_t(image.height) * 3);
    for (size_t i = 0; i < image.pixels.size(); i += size_t(image.channels))
        for (size_t c = 0; c < 3; ++c) {
            float const x = image.pixels[i + (image.channels >= 3 ? c : 0)];
            rgb.push_back(x > 0 ? std::min(x, 1e38f) : 0);
        }
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
    add_metadata(spec, metadata);
    write_pixels(path, spec, [&](OIIO::ImageOutput& output) {
        return output.write_image(OIIO::TypeDesc::FLOAT, rgb.data());
    });
}

} // namespace

void write_exr(std::string const& path, int width, int height, std::span<Channel const> channels,
               Metadata const& metadata, Precision precision) {
    ExrHeader header;
    header.texts = metadata;
    write_described_exr(path, width, height, channels, header, precision);
}

void write_described_exr(std::string const& path, int width, int height,
                         std::span<Channel const> channels, ExrHeader const& header,
                         Precision precision) {
    require_extension(path, ".exr");
    OIIO::ImageSpec spec(width, height, int(channels.size()),
                         precision == Precision::half ? OIIO::TypeDesc::HALF
                                                      : OIIO::TypeDesc::FLOAT);
    spec.channelnames.clear();
    for (Channel const& c : channels) spec.channelnames.push_back(c.name);
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", ""); // or else OpenImageIO writes the time of day
    add_header(spec, header);
    write_pixels(path, spec, [&](OIIO::ImageOutput& output) {
        // In strips, so that an image with many layers is never held twice; 64 lines are whole
        // blocks of the compression.
        constexpr int kStrip = 64;
        size_t const n = channels.size(), row = size_t(width) * n;
        std::vector<float> strip(row * size_t(std::min(kStrip, height)));
        for (int y = 0; y < height; y += kStrip) {
            int const end = std::min(y + kStrip, height);
            size_t const first = size_t(y) * size_t(width);
            size_t const count = size_t(end - y) * size_t(width);
            for (size_t c = 0; c < n; ++c)
                for (size_t i = 0; i < count; ++i)
                    strip[i * n + c] = channels[c].data[(first + i) * channels[c].stride];
            if (!output.write_scanlines(spec.y + y, spec.y + end, 0, OIIO::TypeDesc::FLOAT,
                                        strip.data()))
                return false;
        }
        return true;
    });
}

void write_exr(std::string const& path, Image const& image, Metadata const& metadata,
               Precision precision) {
    ExrHeader header;
    header.texts = metadata;
    write_described_exr(path, image, header, precision);
}

void write_described_exr(std::string const& path, Image const& image, ExrHeader const& header,
                         Precision precision) {
    assert(is_whole(image));
    std::vector<std::string> const names = channel_names(image);
    if (names.size() != size_t(image.channels))
        throw InputError({path}, "expected a name for each of " + std::to_string(image.channels) +
                                     " channels, found " + std::to_string(names.size()));
    std::vector<Channel> channels;
    for (size_t c = 0; c < names.size(); ++c)
        channels.push_back({names[c], image.pixels.data() + c, names.size()});
    write_described_exr(path, image.width, image.height, channels, header, precision);
}

void write_png(std::string const& path, Image const& image, Metadata const& metadata) {
    require_extension(path, ".png");
    write_display(path, image, metadata);
}

std::vector<unsigned char> png_bytes(int width, int height, int channels,
                                     std::span<uint8_t const> pixels) {
    assert(pixels.size() == size_t(width) * size_t(height) * size_t(channels));
    OIIO::Filesystem::IOVecOutput file;
    auto const output = OIIO::ImageOutput::create("png", &file);
    OIIO::ImageSpec const spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (!output || !output->open("memory.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close())
        throw IoError("cannot make a PNG" + (output ? ": " + output->geterror() : ""));
    return file.buffer();
}

void write_image(std::string const& path, Image const& image, Metadata const& metadata) {
    check_extension(path);
    std::string const e = extension_of(path);
    if (e == ".exr")
        write_exr(path, image, metadata);
    else if (e == ".hdr")
        write_hdr(path, image, metadata);
    else
        write_display(path, image, metadata);
}

bool is_exr(std::string const& path) { return extension_of(path) == ".exr"; }

bool is_for_screens(std::string const& path) { return is_display_format(extension_of(path)); }

bool holds_alpha(std::string const& path) { return !extension_of(path).starts_with(".jp"); }

void check_writable(std::string const& path) {
    check_extension(path);
    if (std::filesystem::is_directory(path))
        throw InputError({path}, "expected a file to write, found a folder");
    try {
        probe_folder(path);
    } catch (IoError const& e) {
        throw InputError(e.what());
    }
}

} // namespace weft::image
