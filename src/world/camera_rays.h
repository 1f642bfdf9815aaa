// Camera rays: from a position on the picture, a point on the lens and a moment to a ray.
//
// Each kind of camera makes rays in its own space, where it stands at the origin and looks along +z
// with +y down the picture. `CameraRays` puts them into the world.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "base/distribution.h"
#include "image/texture.h"
#include "scene/camera.h"
#include "world/ray.h"

namespace weft::world {

/// The opening of a lens, within the unit disk.
struct RoundAperture {
    Vec2 sample(Vec2 u) const;
};
/// A regular polygon.
struct BladedAperture {
    int blades;     ///< at least 3
    float rotation; ///< radians
    Vec2 sample(Vec2 u) const;
};
/// A picture, whose brightness says how much light comes through each point of [-1, 1]^2.
struct ImageAperture {
    std::shared_ptr<Distribution2D const> density;
    Vec2 sample(Vec2 u) const;
};
using Aperture = std::variant<RoundAperture, BladedAperture, ImageAperture>;

/// A camera ray in the camera's own space.
struct CameraRay {
    Vec3 origin{0, 0, 0};
    Vec3 direction{0, 0, 1}; ///< of any length
    RayCone cone{};          ///< of one whole pixel
};

/// The plane at distance 1 that the picture is on, or in an orthographic view any plane.
struct Screen {
    float scale = 1; ///< half the picture's extent along the field-of-view axis
    scene::FovAxis axis = scene::FovAxis::x;

    /// Half of a pixel's width.
    float half_pixel(Vec2i size) const {
        return scale / float(axis == scene::FovAxis::y ? size.y : size.x);
    }
    Vec2 at(Vec2 raster, Vec2i size) const;
};

// The kinds of camera. `size`: of the picture in pixels; `raster`: pixels from its upper left
// corner; `lens` in [0, 1)^2.

struct PerspectiveView {
    Screen screen;
    CameraRay ray(Vec2 raster, Vec2i size, Vec2 lens) const;
};
struct ThinLensView {
    Screen screen;
    float radius; ///< above 0
    float focal_distance;
    Aperture aperture;
    CameraRay ray(Vec2 raster, Vec2i size, Vec2 lens) const;
};
struct OrthographicView {
    Screen screen;
    CameraRay ray(Vec2 raster, Vec2i size, Vec2 lens) const;
};
/// All directions, over a picture twice as wide as high.
struct EnvironmentView {
    CameraRay ray(Vec2 raster, Vec2i size, Vec2 lens) const;
};
using CameraView = std::variant<PerspectiveView, ThinLensView, OrthographicView, EnvironmentView>;

class CameraRays {
  public:
    CameraRays() = default;
    CameraRays(scene::Camera const& camera,
               std::vector<std::shared_ptr<image::Texture const>> const& images);

    /// Replaces the size of the picture; the field of view stays what the scene says.
    void resize(Vec2i size) { size_ = size; }
    Vec2i size() const { return size_; } ///< pixels
    Vec3 position() const { return to_world_.origin; }
    /// Returns how far `p` lies along the camera's axis, or from a camera that looks all around.
    float depth(Vec3 const& p) const;
    /// Returns how wide the spot is that a point makes on the picture, in pixels: 0 where it is in
    /// focus.
    float blur(Vec3 const& p) const { return blur_at(1 / depth(p)); }
    float blur_at_infinity() const { return blur_at(0); }
    /// Returns whether `lens` matters to `ray`.
    bool has_lens() const { return std::holds_alternative<ThinLensView>(view_); }

    /// `raster`: pixels from the upper left corner; `lens` in [0, 1)^2; `time` in [0, 1] of the
    /// shutter interval. The ray's cone is `footprint_scale` times as wide as a pixel.
    Ray ray(Vec2 raster, Vec2 lens, float time, float footprint_scale = 1) const;

  private:
    float blur_at(float inverse_depth) const;

    CameraView view_;
    Affine to_world_;
    Vec2i size_{1, 1};
};

} // namespace weft::world
