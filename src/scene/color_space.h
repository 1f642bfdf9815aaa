// How files encode colours.
#pragma once

#include <array>
#include <string_view>

#include "image/texture.h"

namespace weft::scene {

/// Names as in MaterialX. `automatic`: what the file says, else lightwave's g22_rec709.
enum class ColorSpace { automatic, g22_rec709, srgb_texture, lin_rec709 };
constexpr auto choices(ColorSpace) {
    return std::array<std::string_view, 4>{"auto", "g22_rec709", "srgb_texture", "lin_rec709"};
}

constexpr image::Transfer transfer_of(ColorSpace space) {
    switch (space) {
    case ColorSpace::automatic:
    case ColorSpace::g22_rec709:
        return image::Transfer::gamma22;
    case ColorSpace::srgb_texture:
        return image::Transfer::srgb;
    case ColorSpace::lin_rec709:
        break;
    }
    return image::Transfer::linear;
}

constexpr image::Encoding encoding_of(ColorSpace space) {
    return {transfer_of(space), space != ColorSpace::automatic};
}

} // namespace weft::scene
