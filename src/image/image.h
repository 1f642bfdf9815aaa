// Images as floats, and the files they come from and go to (through OpenImageIO).
//
// Left out on purpose: levels (the first is read), deep images (refused), and the placement of a
// data window inside its display window.
#pragma once

#include "base/error.h"

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace weft::image {

/// Pixels by rows from the top, channels interleaved: pixels[(y * width + x) * channels + c].
struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<float> pixels;
    /// Read from a file whose numbers are meant for a screen: 8 or 16 bit integers, unless the
    /// file says that they are linear. Such colours want `srgb_to_linear` before use as light or
    /// reflectance; data such as normals or roughness is to be used as it is.
    bool is_srgb_encoded = false;
    /// Colours are not those of the file, which had another exposure or other primaries.
    bool is_converted = false;
    std::vector<std::string> warnings; ///< of what the file says and we do not follow
    std::vector<std::string> names;    ///< empty, or one per channel: "R", "albedo.R", "Z"
    /// Names of the file's parts that are not in it, since they are deep or lie elsewhere.
    std::vector<std::string> apart;

    float& at(int x, int y, int c) { return pixels[index(x, y, c)]; }
    float at(int x, int y, int c) const { return pixels[index(x, y, c)]; }
    size_t index(int x, int y, int c) const {
        return (size_t(y) * size_t(width) + size_t(x)) * size_t(channels) + size_t(c);
    }
};

/// A black image.
Image make_image(int width, int height, int channels);

/// Named strings kept in a file's header.
using Metadata = std::map<std::string, std::string>;

/// Something outside of Weft failed while writing: a full disk, a folder without permission.
class IoError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The numbers as the file holds them (integers scaled to [0, 1]; colours not premultiplied by
/// alpha where the format does not, as PNG): EXR, HDR, PNG, JPEG, TIFF and what else OpenImageIO
/// knows. Rows and columns are turned as the file says. Where it says that its colours are neither
/// Rec. 709 nor meant for a screen (color_words.h), they become linear Rec. 709. Throws InputError
/// for a file that is missing, damaged, truncated, deep, or larger than 16 GiB as floats.
///
/// The parts of an EXR file are one image, where they lie where its picture does: their channels
/// come one after the other and are called PART.CHANNEL, but for the picture's (parts.h).
Image read_image(std::string const& path);

/// One part of a file, by its name. Throws like `read_image`, and where there is none.
Image read_part(std::string const& path, std::string const& name);

/// The strings in a file's header, those included that its writer added by itself. Throws like
/// `read_image`.
Metadata read_metadata(std::string const& path);

} // namespace weft::image
