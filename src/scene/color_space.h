// How files encode colours.
#pragma once

#include <array>
#include <string_view>

#include "image/texel.h"

namespace weft::scene {

/// Names as in MaterialX.
enum class ColorSpace { g22_rec709, srgb_texture, lin_rec709 };
constexpr auto choices(ColorSpace) {
    return std::array<std::string_view, 3>{"g22_rec709", "srgb_texture", "lin_rec709"};
}

constexpr image::Transfer transfer_of(ColorSpace space) {
    switch (space) {
    case ColorSpace::g22_rec709:
        return image::Transfer::gamma22;
    case ColorSpace::srgb_texture:
        return image::Transfer::srgb;
    case ColorSpace::lin_rec709:
        break;
    }
    return image::Transfer::linear;
}

} // namespace weft::scene
