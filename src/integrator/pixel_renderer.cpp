#include "integrator/pixel_renderer.h"

#include "base/feature.h"
#include "integrator/media_walk.h"

namespace weft::integrator {

namespace {

constexpr uint32_t kUnlimited = 1u << 30;

uint32_t depth_limit(int depth) { return depth < 0 ? kUnlimited : uint32_t(depth); }

/// The same paths through the scene as it is.
PathSettings without_controls(PathSettings const& s) {
    PathSettings whole{s.strategy, s.depth, s.roulette_depth, s.footprint_scale, true};
    whole.light_samples = s.light_samples;
    whole.controls = false;
    return whole;
}

PathSettings settings_of(scene::PathIntegrator const& i) {
    PathSettings s{i.strategy, depth_limit(i.depth), uint32_t(i.roulette_depth), 1,
                   i.full_materials};
    s.light_samples = uint32_t(i.light_samples);
    if (!i.controls) return without_controls(s);
    s.caustics = i.caustics;
    s.secondary_specular = i.secondary_specular;
    s.secondary_roughness = i.secondary_roughness;
    if (i.indirect_clamp > 0) s.indirect_clamp = i.indirect_clamp;
    return s;
}
template <class Type>
PathSettings settings_of(scene::NamedPathIntegrator<Type> const& i) {
    return {Type::strategy, depth_limit(i.depth), PathSettings().roulette_depth};
}
PathSettings settings_of(scene::DirectIntegrator const&) { return {scene::Strategy::nee, 2, 2}; }

/// Returns how the integrator's paths go; of integrators that follow no light nobody asks more
/// than the default's footprints.
PathSettings path_settings(scene::Integrator const& integrator) {
    return match(integrator, []<class I>(I const& i) {
        if constexpr (scene::FollowsLight<I>)
            return settings_of(i);
        else
            return PathSettings();
    });
}

film::Filter make_filter(scene::RenderTarget const& target) {
    float const w = target.filter_width;
    switch (target.filter) {
    case scene::FilterShape::box:
        return film::BoxFilter{w > 0 ? w / 2 : 0.5f};
    case scene::FilterShape::tent:
        return film::TentFilter{w > 0 ? w / 2 : 1};
    case scene::FilterShape::gaussian:
        return w > 0 ? film::GaussianFilter(w / 6) : film::GaussianFilter();
    case scene::FilterShape::blackmanHarris:
        return w > 0 ? film::BlackmanHarrisFilter(w / 2) : film::BlackmanHarrisFilter();
    }
    return film::BoxFilter{};
}

sampling::SamplerKind sampler_kind(scene::Sampler const& sampler) {
    return std::visit(Overloaded{
                          [](scene::SamplerSettings<scene::SobolType> const&) {
                              return sampling::SamplerKind::Sobol;
                          },
                          [](scene::SamplerSettings<scene::HaltonType> const&) {
                              return sampling::SamplerKind::Halton;
                          },
                          [](scene::SamplerSettings<scene::IndependentType> const&) {
                              return sampling::SamplerKind::Independent;
                          },
                      },
                      sampler);
}

Color as_color(Vec3 const& v) { return {v.x, v.y, v.z}; }
Color direction_color(Vec3 const& v) { return as_color((v + Vec3(1)) * 0.5f); }

} // namespace

bool combines_strategies(scene::Integrator const& integrator) {
    return path_settings(integrator).strategy == scene::Strategy::mis;
}

PixelRenderer::PixelRenderer(lights::Stage const& stage, scene::Integrator const& integrator,
                             scene::Sampler const& sampler, uint32_t seed, int samples_per_pixel)
    : stage_(stage), world_(stage.world()), integrator_(integrator),
      path_(path_settings(integrator)), sampler_(sampler_kind(sampler)), seed_(seed),
      filter_(make_filter(match(integrator, [](auto const& i) { return i.target; }))),
      media_(media_at(world_, world_.camera().position())) {
    path_.by_part = path_.controls && (stage.has_controls_by_kind() || !path_.caustics);
    path_.footprint_scale = world::footprint_scale(
        samples_per_pixel > 0 ? samples_per_pixel
                              : match(sampler, [](auto const& s) { return s.count; }));
    unruled_ = without_controls(path_);
}

Color PixelRenderer::trace(scene::CameraIntegrator const& i, world::Ray const& ray,
                           uint32_t) const {
    if (!i.grid) return as_color(ray.direction);
    // Where the ray meets the plane z = 1.
    float const t = (1 - ray.origin.z) / ray.direction.z;
    Vec3 const p = ray.origin + ray.direction * t;
    auto on_line = [&](float x) { return std::fmod(std::abs(x) * i.grid_frequency, 1.f) < 0.1f; };
    return on_line(p.x) || on_line(p.y) ? i.grid_color : direction_color(ray.direction);
}

Color PixelRenderer::trace(scene::AovIntegrator const& i, world::Ray const& ray,
                           uint32_t alpha_seed) const {
    world::Hit const hit = world_.intersect(ray, alpha_seed);
    bool const normals = i.variable == scene::AovVariable::normals;
    if (!hit) return normals ? Color(0.5f) / i.scale : Color(0);
    shading::SurfacePoint const point = world_.surface(ray, hit);
    switch (i.variable) {
    case scene::AovVariable::normals:
        return direction_color(point.ns) / i.scale;
    case scene::AovVariable::distance:
        return Color(hit.t) / i.scale;
    case scene::AovVariable::uv:
        return Color(point.uv.x, point.uv.y, 0) / i.scale;
    case scene::AovVariable::bvh:
        return Color(1) / i.scale;
    }
    return Color(0);
}

Color PixelRenderer::trace(scene::NormalIntegrator const& i, world::Ray const& ray,
                           uint32_t alpha_seed) const {
    world::Hit const hit = world_.intersect(ray, alpha_seed);
    if (!hit) return Color(0);
    Vec3 const n = world_.surface(ray, hit).ns;
    return i.remap ? direction_color(n) : as_color(n);
}

Color PixelRenderer::trace(scene::AlbedoIntegrator const&, world::Ray const& ray,
                           uint32_t alpha_seed) const {
    world::Hit const hit = world_.intersect(ray, alpha_seed);
    if (!hit) return Color(0);
    return world_.shade(world_.surface(ray, hit), -ray.direction, media_)
        .bsdf.albedo(-ray.direction);
}

bool PixelRenderer::follows_light() const { return scene::outputs_of(integrator_) != nullptr; }

world::Ray PixelRenderer::camera_ray(Vec2i pixel, sampling::SampleStream const& u) const {
    using sampling::Dimension;
    FeatureScope const scope(Feature::Camera);
    Vec2 const offset = film::sample_filter(filter_, u.get2(Dimension::Film));
    Vec2 const raster(float(pixel.x) + 0.5f + offset.x, float(pixel.y) + 0.5f + offset.y);
    world::CameraRays const& camera = world_.camera();
    return camera.ray(raster, camera.has_lens() ? u.get2(Dimension::Lens) : Vec2(0.5f),
                      u.get1(Dimension::Time), path_.footprint_scale);
}

Color PixelRenderer::sample(Vec2i pixel, uint32_t sample, film::SampleRecord* record) const {
    using sampling::Dimension;
    sampling::SampleStream const u(sampler_, pixel, sample, seed_);
    world::Ray const ray = camera_ray(pixel, u);
    // That of a path's first vertex, so that all pictures of a scene see the same surfaces.
    uint32_t const alpha_seed = world_.has_alpha() ? u.walk(Dimension::Alpha, 1).next_uint() : 0;
    return match(integrator_, [&]<class I>(I const& i) {
        if constexpr (!scene::FollowsLight<I>) {
            return trace(i, ray, alpha_seed);
        } else {
            if (record) record->clear();
            if (record && record->log())
                record->log()->push_back({.kind = film::PathEvent::Kind::Camera,
                                          .p = ray.origin,
                                          .direction = ray.direction,
                                          .value = Color(1)});
            film::SampleSink sink(record);
            trace_path(stage_, path_, ray, media_, u, sink);
            if (record && record->layout().has(film::Aov::removed)) {
                film::SampleSink whole;
                trace_path(stage_, unruled_, ray, media_, u, whole);
                record->add_removed(whole.beauty() - sink.beauty());
            }
            return sink.beauty();
        }
    });
}

} // namespace weft::integrator
