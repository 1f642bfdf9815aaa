// Camera rays: from a position on the picture, a point on the lens and a moment to a ray.
#pragma once

#include <memory>
#include <vector>

#include "base/distribution.h"
#include "image/texture.h"
#include "scene/camera.h"
#include "world/ray.h"

namespace weft::world {

class CameraRays {
  public:
    CameraRays() = default;
    CameraRays(scene::Camera const& camera,
               std::vector<std::shared_ptr<image::Texture const>> const& images);

    /// Replaces the size of the picture; the field of view stays what the scene says.
    void resize(Vec2i size) { size_ = size; }
    Vec2i size() const { return size_; } ///< pixels
    Vec3 position() const { return to_world_.origin; }
    /// How far `p` lies along the camera's axis; for a camera that looks all around, from it.
    float depth(Vec3 const& p) const;
    bool has_lens() const { return lens_radius_ > 0; } ///< whether `lens` matters to `ray`

    /// `raster`: pixels from the upper left corner; `lens` in [0, 1)^2. The ray's cone is
    /// `footprint_scale` times as wide as a pixel.
    Ray ray(Vec2 raster, Vec2 lens, float time, float footprint_scale = 1) const;

  private:
    enum class Projection { Perspective, Orthographic, Environment };

    float half_pixel() const;
    Vec2 on_screen(Vec2 raster) const;
    Vec2 on_lens(Vec2 u) const;

    Projection projection_ = Projection::Perspective;
    Affine to_world_;
    Vec2i size_{1, 1};
    float scale_ = 1; ///< half the picture's extent along the field-of-view axis, at distance 1
    bool scale_is_vertical_ = false;
    float lens_radius_ = 0, focal_distance_ = 1;
    int blades_ = 0;
    float blade_rotation_ = 0;
    std::shared_ptr<Distribution2D const> bokeh_;
};

} // namespace weft::world
