// Images as the render reads them: float pixels and how they are looked up.
//
// Left out until textures are cached: filtering by ray footprints.
#pragma once

#include <memory>

#include "base/color.h"
#include "base/vec.h"
#include "image/image.h"

namespace weft::shading {

/// An image over the unit square; v runs upwards, so that v = 1 is the top row.
struct ImageLookup {
    std::shared_ptr<image::Image const> image;
    float exposure = 1;
    bool clamp = false;
    bool nearest = false;

    Color at(Vec2 uv) const;
};

} // namespace weft::shading
