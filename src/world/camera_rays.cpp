#include "world/camera_rays.h"

#include "base/color.h"
#include "base/lat_long.h"
#include "base/match.h"
#include "base/warp.h"

namespace weft::world {

namespace {

/// The brightness of an aperture image as a density over the square around the lens.
std::shared_ptr<Distribution2D const> aperture_density(image::Texture const& image) {
    std::vector<float> weights;
    weights.reserve(size_t(image.width) * size_t(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            image::Texel const texel = image.texel(0, x, y);
            float const v = luminance({texel[0], texel[1], texel[2]});
            weights.push_back(std::isfinite(v) && v > 0 ? v : 0);
        }
    return std::make_shared<Distribution2D const>(weights, uint32_t(image.width),
                                                  uint32_t(image.height));
}

} // namespace

CameraRays::CameraRays(scene::Camera const& camera,
                       std::vector<std::shared_ptr<image::Texture const>> const& images) {
    auto set_view = [&](scene::Viewpoint const& view, scene::FovAxis axis) {
        to_world_ = Affine(view.transform);
        size_ = {view.width, view.height};
        scale_is_vertical_ = axis == scene::FovAxis::y;
    };
    std::visit(Overloaded{
                   [&](scene::Perspective const& c) {
                       set_view(c.view, c.fov_axis);
                       scale_ = std::tan(radians(c.fov) / 2);
                   },
                   [&](scene::ThinLens const& c) {
                       set_view(c.view, c.fov_axis);
                       scale_ = std::tan(radians(c.fov) / 2);
                       lens_radius_ = c.lens_radius;
                       focal_distance_ = c.focal_distance;
                       blades_ = c.blades;
                       blade_rotation_ = radians(c.blade_rotation);
                       if (c.bokeh.resource >= 0)
                           bokeh_ = aperture_density(*images[size_t(c.bokeh.resource)]);
                   },
                   [&](scene::Orthographic const& c) {
                       set_view(c.view, c.fov_axis);
                       projection_ = Projection::Orthographic;
                       scale_ = c.scale;
                   },
                   [&](scene::EnvironmentCamera const& c) {
                       set_view(c.view, scene::FovAxis::x);
                       projection_ = Projection::Environment;
                   },
               },
               camera);
}

/// Half of a pixel's width on the plane at distance 1, or in an orthographic view anywhere.
float CameraRays::half_pixel() const {
    return scale_ / float(scale_is_vertical_ ? size_.y : size_.x);
}

Vec2 CameraRays::on_screen(Vec2 raster) const {
    float const w = float(size_.x), h = float(size_.y);
    float const unit = half_pixel();
    return {(2 * raster.x - w) * unit, (2 * raster.y - h) * unit};
}

Vec2 CameraRays::on_lens(Vec2 u) const {
    if (bokeh_) {
        Vec2 const p = bokeh_->sample(u).p;
        return {2 * p.x - 1, 2 * p.y - 1};
    }
    if (blades_ < 3) return square_to_disk(u);
    // One of the polygon's triangles around the centre, then a point in it.
    float const slot = u.x * float(blades_);
    float const blade = std::floor(slot);
    Vec2 const b = square_to_triangle({slot - blade, u.y});
    float const from = blade_rotation_ + 2 * kPi * blade / float(blades_),
                to = from + 2 * kPi / float(blades_);
    return {b.x * std::cos(from) + b.y * std::cos(to), b.x * std::sin(from) + b.y * std::sin(to)};
}

float CameraRays::depth(Vec3 const& p) const {
    Vec3 const to_p = p - position();
    if (projection_ == Projection::Environment) return length(to_p);
    return dot(to_p, normalize(to_world_.vector({0, 0, 1})));
}

Ray CameraRays::ray(Vec2 raster, Vec2 lens, float time, float footprint_scale) const {
    Vec3 origin(0), direction(0, 0, 1);
    RayCone cone;
    if (projection_ == Projection::Environment) {
        direction = uv_to_direction({raster.x / float(size_.x), 1 - raster.y / float(size_.y)});
        cone.spread = kPi / float(size_.y);
    } else if (Vec2 const s = on_screen(raster); projection_ == Projection::Orthographic) {
        origin = {s.x, s.y, 0};
        cone.width = 2 * half_pixel() * length(to_world_.vector({1, 0, 0}));
    } else {
        direction = {s.x, s.y, 1};
        cone.spread = 2 * half_pixel() / length(direction);
        if (lens_radius_ > 0) {
            Vec2 const l = on_lens(lens) * lens_radius_;
            origin = {l.x, l.y, 0};
            direction = direction * focal_distance_ - origin;
        }
    }
    Ray ray;
    ray.origin = to_world_.point(origin);
    ray.direction = normalize(to_world_.vector(direction));
    ray.time = time;
    ray.cone = {cone.width * footprint_scale, cone.spread * footprint_scale};
    // What is nearer than the rounding of the camera's own place cannot be told to be in front.
    ray.t_min = std::max(ray.t_min, kRounding * max_component(abs(ray.origin)));
    return ray;
}

} // namespace weft::world
