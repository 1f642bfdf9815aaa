// What an image file says about its colours, and what is made of that.
//
// Whoever uses the file has the first word (`Encoding::stated`), then comes the file, then the
// default of its use. A file that says sRGB says that its colours are meant for a screen, which
// leaves the curve to that default.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "image/texture.h"

namespace weft::image {

/// Chromaticities x, y of red, green, blue and white.
using Primaries = std::array<float, 8>;
constexpr Primaries kRec709Primaries{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
/// CIE XYZ as if it were RGB.
constexpr Primaries kXyzPrimaries{1, 0, 0, 1, 0, 0, 1 / 3.f, 1 / 3.f};

/// The matrix, by rows, from linear RGB of these primaries to linear Rec. 709. White goes to white
/// (Bradford's adaptation; Lam 1985), except from CIE XYZ, which is a measure of light and not
/// relative to a white. Nothing where that changes no colour by 1e-3, or where primaries lie on a
/// line.
std::optional<std::array<float, 9>> matrix_to_rec709(Primaries const& primaries);

/// From numbers of a file, decoded where they are integers, to linear Rec. 709.
using ColorConversion = std::function<void(std::span<float> rgb)>;

struct ColorWords {
    Transfer transfer = Transfer::linear; ///< how integers are decoded
    ColorConversion convert;              ///< and what comes then; empty: nothing
    std::vector<std::string> warnings;    ///< of words that are not followed
};

/// Returns what the colours of an image are, for a file of integers or floats with the header
/// `spec`. `png`: the file's bytes up to its pixels, where it is a PNG.
ColorWords color_words(OIIO::ImageSpec const& spec, std::string_view png, Encoding encoding);

/// The same for the numbers of a Radiance picture.
ColorWords color_words(std::array<float, 3> const& multiplied,
                       std::optional<Primaries> const& primaries, Encoding encoding);

} // namespace weft::image
