// Writing images, each as one step: the file appears whole or not at all.
//
// Bytes go to a temporary file in the same folder, are flushed to the disk, and take the place of
// the old file by rename(2). Where anything fails the temporary file is removed, the old file
// stays as it was, and IoError tells why. Equal input gives equal bytes: no date is
// written, but for TIFF, where it is 1970.
#pragma once

#include "image/image.h"

#include <array>
#include <optional>
#include <span>

namespace weft::image {

/// One channel of an EXR file, anywhere in memory: pixel i is data[i * stride].
struct Channel {
    std::string name; ///< "R", or with a layer "albedo.R"
    float const* data = nullptr;
    size_t stride = 1;
};

enum class Precision { half, float32 };

/// Primaries and white as x and y of red, green, blue and white.
using Chromaticities = std::array<float, 8>;
inline constexpr Chromaticities kRec709{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

/// What an EXR file's header says beside its channels.
struct ExrHeader {
    Metadata texts;
    std::optional<Chromaticities> chromaticities;
    /// From world to camera space (x right, y up, z into the picture), row by row, to be multiplied
    /// by row vectors.
    std::optional<std::array<float, 16>> world_to_camera;
    /// The whole picture (the display window), where the pixels (the data window) are a part of it
    /// whose corner is `x`, `y`; 0: they are the whole.
    int x = 0, y = 0, full_width = 0, full_height = 0;
};

/// A scanline EXR with ZIP compression (16 lines each), linear numbers as they are, not-a-number
/// included. Halves saturate at infinity beyond 65504. Throws InputError where the extension of
/// `path` is not .exr.
void write_exr(std::string const& path, int width, int height, std::span<Channel const> channels,
               Metadata const& metadata = {}, Precision precision = Precision::float32);

void write_described_exr(std::string const& path, int width, int height,
                         std::span<Channel const> channels, ExrHeader const& header,
                         Precision precision = Precision::float32);

/// The same for an interleaved image, its channels named by `names` or else Y, YA, RGB, RGBA
/// by their number; more than four must be named.
void write_exr(std::string const& path, Image const& image, Metadata const& metadata = {},
               Precision precision = Precision::float32);
void write_described_exr(std::string const& path, Image const& image, ExrHeader const& header,
                         Precision precision = Precision::float32);

/// An 8-bit PNG of a linear image with 1 to 4 channels: clipped to [0, 1], encoded as sRGB and
/// rounded; not-a-number is 0. Alpha is linear; colours, premultiplied in `image`, are divided by
/// it first, as PNG wants them. An image that `is_srgb_encoded` is only clipped and rounded, its
/// colours not premultiplied. Throws InputError where the extension is not .png.
void write_png(std::string const& path, Image const& image, Metadata const& metadata = {});

/// The file of an 8-bit PNG in memory, of pixels that are already encoded; 1 to 4 channels.
std::vector<unsigned char> png_bytes(int width, int height, int channels,
                                     std::span<uint8_t const> pixels);

/// By the extension: .exr and .hdr hold linear floats, .png, .jpg, .jpeg, .tif and .tiff what
/// `write_png` describes (JPEG, at quality 95, and HDR without alpha). Throws InputError for
/// another extension.
void write_image(std::string const& path, Image const& image, Metadata const& metadata = {});

/// By the extension, in capitals or not.
bool is_exr(std::string const& path);

/// Whether `write_image` encodes for a screen what it writes to `path`, by the extension: PNG, JPEG
/// and TIFF.
bool is_for_screens(std::string const& path);
/// Whether such a file can hold alpha.
bool holds_alpha(std::string const& path);

/// To be asked before a long render: throws InputError where `path` has an unknown extension, is a
/// folder, or lies in one that is missing or in which no file can be made.
void check_writable(std::string const& path);

} // namespace weft::image
