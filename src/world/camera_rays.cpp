#include "world/camera_rays.h"

#include "base/color.h"
#include "base/lat_long.h"
#include "base/match.h"
#include "base/warp.h"

namespace weft::world {

namespace {

using Images = std::vector<std::shared_ptr<image::Texture const>>;

/// Returns the brightness of an image as a density over the unit square.
std::shared_ptr<Distribution2D const> density_of(image::Texture const& image) {
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

Aperture aperture_of(scene::ThinLens const& c, Images const& images) {
    if (c.bokeh.resource >= 0) return ImageAperture{density_of(*images[size_t(c.bokeh.resource)])};
    if (c.blades >= 3) return BladedAperture{c.blades, radians(c.blade_rotation)};
    return RoundAperture{};
}

/// Returns the screen of a camera whose field of view is `fov` degrees.
Screen screen_of(float fov, scene::FovAxis axis) { return {std::tan(radians(fov) / 2), axis}; }

CameraView view_of(scene::Perspective const& c, Images const&) {
    return PerspectiveView{screen_of(c.fov, c.fov_axis)};
}
CameraView view_of(scene::ThinLens const& c, Images const& images) {
    Screen const screen = screen_of(c.fov, c.fov_axis);
    if (!(c.lens_radius > 0)) return PerspectiveView{screen};
    return ThinLensView{screen, c.lens_radius, c.focal_distance, aperture_of(c, images)};
}
CameraView view_of(scene::Orthographic const& c, Images const&) {
    return OrthographicView{{c.scale, c.fov_axis}};
}
CameraView view_of(scene::EnvironmentCamera const&, Images const&) { return EnvironmentView{}; }

} // namespace

Vec2 RoundAperture::sample(Vec2 u) const { return square_to_disk(u); }

Vec2 BladedAperture::sample(Vec2 u) const {
    // One of the polygon's triangles around the centre, then a point in it.
    float const slot = u.x * float(blades);
    float const blade = std::floor(slot);
    Vec2 const b = square_to_triangle({slot - blade, u.y});
    float const from = rotation + 2 * kPi * blade / float(blades),
                to = from + 2 * kPi / float(blades);
    return {b.x * std::cos(from) + b.y * std::cos(to), b.x * std::sin(from) + b.y * std::sin(to)};
}

Vec2 ImageAperture::sample(Vec2 u) const {
    Vec2 const p = density->sample(u).p;
    return {2 * p.x - 1, 2 * p.y - 1};
}

Vec2 Screen::at(Vec2 raster, Vec2i size) const {
    float const w = float(size.x), h = float(size.y);
    float const unit = half_pixel(size);
    return {(2 * raster.x - w) * unit, (2 * raster.y - h) * unit};
}

CameraRay PerspectiveView::ray(Vec2 raster, Vec2i size, Vec2) const {
    Vec2 const s = screen.at(raster, size);
    CameraRay ray;
    ray.direction = {s.x, s.y, 1};
    ray.cone.spread = 2 * screen.half_pixel(size) / length(ray.direction);
    return ray;
}

CameraRay ThinLensView::ray(Vec2 raster, Vec2i size, Vec2 lens) const {
    CameraRay ray = PerspectiveView{screen}.ray(raster, size, lens);
    Vec2 const l = match(aperture, [&](auto const& a) { return a.sample(lens); }) * radius;
    ray.origin = {l.x, l.y, 0};
    ray.direction = ray.direction * focal_distance - ray.origin;
    return ray;
}

CameraRay OrthographicView::ray(Vec2 raster, Vec2i size, Vec2) const {
    Vec2 const s = screen.at(raster, size);
    CameraRay ray;
    ray.origin = {s.x, s.y, 0};
    ray.cone.width = 2 * screen.half_pixel(size);
    return ray;
}

CameraRay EnvironmentView::ray(Vec2 raster, Vec2i size, Vec2) const {
    CameraRay ray;
    ray.direction = uv_to_direction({raster.x / float(size.x), 1 - raster.y / float(size.y)});
    ray.cone.spread = kPi / float(size.y);
    return ray;
}

CameraRays::CameraRays(scene::Camera const& camera, Images const& images) {
    match(camera, [&](auto const& c) {
        view_ = view_of(c, images);
        to_world_ = Affine(c.view.transform);
        size_ = {c.view.width, c.view.height};
    });
}

float CameraRays::depth(Vec3 const& p) const {
    Vec3 const to_p = p - position();
    if (std::holds_alternative<EnvironmentView>(view_)) return length(to_p);
    return dot(to_p, normalize(to_world_.vector({0, 0, 1})));
}

float CameraRays::blur_at(float inverse_depth) const {
    auto const* const lens = std::get_if<ThinLensView>(&view_);
    if (!lens) return 0;
    float const unit = length(to_world_.vector({0, 0, 1})); // of the camera's space, in the world
    // The lens as seen from the point, on the plane in focus: 2 r |1 - focal / depth|.
    return lens->radius * std::abs(1 / lens->focal_distance - unit * inverse_depth) /
           lens->screen.half_pixel(size_);
}

Ray CameraRays::ray(Vec2 raster, Vec2 lens, float time, float footprint_scale) const {
    CameraRay const own = match(view_, [&](auto const& v) { return v.ray(raster, size_, lens); });
    Ray ray;
    ray.origin = to_world_.point(own.origin);
    ray.direction = normalize(to_world_.vector(own.direction));
    ray.time = time;
    // A cone's width grows with the camera's space, its spread does not.
    float const width = own.cone.width * length(to_world_.vector({1, 0, 0}));
    ray.cone = {width * footprint_scale, own.cone.spread * footprint_scale};
    // What is nearer than the rounding of the camera's own place cannot be told to be in front.
    ray.t_min = std::max(ray.t_min, kRounding * max_component(abs(ray.origin)));
    return ray;
}

} // namespace weft::world
