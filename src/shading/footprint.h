// How much of a texture one lookup sees.
#pragma once

#include "base/vec.h"

namespace weft::shading {

/// Two axes (full lengths, in uv) of the ellipse around a lookup's uv that its ray stands for. 0: a
/// point. Who maps uvs linearly maps the axes alike, without the translation.
struct UvFootprint {
    Vec2 a{0, 0}, b{0, 0};
};

} // namespace weft::shading
