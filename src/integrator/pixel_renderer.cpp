#include "integrator/pixel_renderer.h"

#include "base/feature.h"
#include "integrator/first_hit.h"
#include "integrator/place.h"

namespace weft::integrator {

namespace {

constexpr uint32_t kUnlimited = 1u << 30;

uint32_t depth_limit(int depth) { return depth < 0 ? kUnlimited : uint32_t(depth); }

/// Returns the settings of the same paths through the scene as it is, without controls and simpler
/// materials.
PathSettings without_controls(PathSettings const& s) {
    PathSettings whole{s.strategy, s.depth, s.roulette_depth, s.footprint_scale, true};
    whole.light_samples = s.light_samples;
    whole.fold_normals = s.fold_normals;
    whole.controls = false;
    return whole;
}

PathSettings settings_of(scene::PathIntegrator const& i) {
    PathSettings s{i.strategy, depth_limit(i.depth), uint32_t(i.roulette_depth), 1,
                   i.full_materials};
    s.light_samples = uint32_t(i.light_samples);
    s.fold_normals = i.normals == scene::BentNormals::fold;
    if (!i.controls) return without_controls(s);
    s.caustics = i.caustics;
    s.secondary_specular = i.secondary_specular;
    s.secondary_roughness = i.secondary_roughness;
    if (i.indirect_clamp > 0) s.indirect_clamp = i.indirect_clamp;
    return s;
}
template <class Type>
PathSettings settings_of(scene::NamedPathIntegrator<Type> const& i) {
    return {i.strategy, depth_limit(i.depth), PathSettings().roulette_depth};
}
PathSettings settings_of(scene::DirectIntegrator const&) { return {scene::Strategy::nee, 2, 2}; }

/// Returns how the integrator's paths go. Integrators that follow no light find the first surface
/// as paths of the default settings do.
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

Color PixelRenderer::sample(Vec2i pixel, uint32_t sample, film::SampleRecord* record,
                            bool* lost_track) const {
    sampling::SampleStream const stream(sampler_, pixel, sample, seed_);
    world::Ray const ray = camera_ray(pixel, stream);
    return match(integrator_, [&]<class I>(I const& i) {
        if constexpr (scene::FollowsLight<I>) {
            return follow_light(ray, stream, record, lost_track);
        } else {
            film::SampleSink nowhere;
            return draw(i, Tracer{world_, stage_.lights(), path_, stream, nowhere}, ray, media_);
        }
    });
}

Color PixelRenderer::follow_light(world::Ray const& ray, sampling::SampleStream const& stream,
                                  film::SampleRecord* record, bool* lost_track) const {
    if (record) record->clear();
    if (record && record->log())
        record->log()->push_back({.kind = film::PathEvent::Kind::Camera,
                                  .p = ray.origin,
                                  .direction = ray.direction,
                                  .value = Color(1)});
    film::SampleSink sink(record);
    trace_path({world_, stage_.lights(), path_, stream, sink}, ray, media_);
    if (lost_track) *lost_track |= sink.has_lost_track();
    if (record && record->layout().has(film::Aov::removed)) {
        film::SampleSink whole;
        trace_path({world_, stage_.lights(), unruled_, stream, whole}, ray, media_);
        record->set(film::Aov::removed, whole.beauty() - sink.beauty());
    }
    return sink.beauty();
}

} // namespace weft::integrator
