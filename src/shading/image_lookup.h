// Images as the render reads them: how a uv becomes a value.
//
// `mipmap` reads the two mip levels whose texels are about as large as the footprint, and goes
// linearly from one to the other (Williams 1983). The level follows the footprint's shorter axis,
// but is at most two levels finer than the longer axis asks for (Heckbert 1989, 2.5). The many
// samples of a pixel average over the rest of the longer axis. So a lookup reads 8 texels at any
// angle, grazing views stay sharp, and no texture is read at a much finer level than is seen.
#pragma once

#include <memory>

#include "base/color.h"
#include "base/vec.h"
#include "image/texture.h"
#include "scene/texture.h"
#include "shading/footprint.h"

namespace weft::shading {

/// An image over the unit square; v runs upwards, so that v = 1 is the top row.
struct ImageLookup {
    std::shared_ptr<image::Texture const> image;
    float exposure = 1;
    bool clamp_u = false, clamp_v = false; ///< else the image repeats along that axis
    scene::TextureFilter filter = scene::TextureFilter::bilinear;

    /// `footprint` matters to `mipmap` alone.
    Color at(Vec2 uv, UvFootprint const& footprint = {}) const;
    /// Returns the mip level for a footprint, with a fraction; at 0 and below it is the image
    /// itself.
    float level_of(UvFootprint const& footprint) const;
};

} // namespace weft::shading
