#include "integrator/direct.h"

#include "base/feature.h"
#include "integrator/controls.h"
#include "integrator/media_walk.h"
#include "integrator/record.h"
#include "media/phase.h"

namespace weft::integrator {

lobes::LobeValue ScatterPoint::eval(Vec3 const& wi) const {
    if (bsdf) return bsdf->eval(wo, wi);
    float const phase = media::henyey_greenstein(dot(wo, wi), g);
    return {Color(phase), phase};
}

namespace {

/// Whether a surface light, met by a ray with these media, lies inside of something that hides it.
bool is_hidden(world::World const& world, int32_t object, media::MediumStack const& media) {
    if (object < 0 || !world.object(uint32_t(object)).may_be_hidden) return false;
    return !media.is_visible(uint32_t(object), world.object(uint32_t(object)).rank);
}

/// A point and what a light sends to it.
struct Connection {
    ScatterPoint const& point;
    lights::LightSample const& light;
    lights::LightRules const* rules; ///< what of it counts; null: all
    uint32_t bounces;                ///< the point included
    bool alone;                      ///< no ray finds the light
    bool combine;                    ///< what rays find is weighed against it
    bool through;                    ///< it comes from the other side of the surface
};

Connection connection(lights::Stage const& stage, PathSettings const& settings,
                      PathState const& path, ScatterPoint const& point,
                      lights::LightSample const& light) {
    lights::LightRules const* const rules = rules_of(stage.lights(), settings, light.light);
    bool const alone = light.delta || (rules && rules->sampling_alone);
    bool const through =
        point.surface && dot(light.wi, point.surface->ng) * dot(point.wo, point.surface->ng) < 0;
    return {point,  light,
            rules,  path.signature.length() + (point.bsdf ? 1 : 0),
            alone,  settings.strategy == scene::Strategy::mis && !alone,
            through};
}

/// The part of light that `value` scatters towards the camera.
Color counted(Connection const& c, lobes::LobeValue const& value, world::RayKind kind) {
    float const weight = c.combine ? power_heuristic(c.light.pdf, value.pdf) : 1;
    if (!c.rules) return value.f * weight;
    lights::Arrival const to{c.point.at.p, c.point.sets, c.bounces, kind, c.light.distance};
    return value.f * (weight * c.rules->factor(to));
}

/// What of the light is scattered towards the camera: by each part of the BSDF where these are told
/// apart, else all in the first.
using Scattered = std::array<Color, lobes::kParts.size()>;

Color sum(Scattered const& scattered) {
    Color all;
    for (Color const& c : scattered) all += c;
    return all;
}

Scattered scatter(PathSettings const& settings, PathState const& path, Connection const& c) {
    FeatureScope const scope(c.point.bsdf ? Feature::Bsdf : Feature::Media);
    using lobes::LobeFlags;
    ScatterPoint const& point = c.point;
    Vec3 const& wi = c.light.wi;
    if (!point.bsdf) return {counted(c, point.eval(wi), world::RayKind::volume)};
    if (!settings.by_part) return {counted(c, point.eval(wi), world::RayKind::diffuse)};
    Scattered scattered{};
    for (size_t i = 0; i < scattered.size(); ++i) {
        LobeFlags const part = lobes::kParts[i];
        bool const makes_caustic = path.diffused && !any(part, LobeFlags::Diffuse);
        if (makes_caustic && !settings.caustics) continue;
        scattered[i] =
            counted(c, point.bsdf->eval_part(point.wo, wi, part), scattering_kind(part, c.through));
    }
    return scattered;
}

/// The part of the light that gets to the point past what `blockers` is the mask of.
Color transmitted(world::World const& world, PathSettings const& settings, PathState const& path,
                  Connection const& c, world::RayMask blockers, sampling::SampleStream const& u,
                  uint32_t vertex) {
    lights::LightSample const& light = c.light;
    world::Ray shadow;
    shadow.origin = c.point.origin(light.wi);
    shadow.direction = light.wi;
    shadow.time = path.ray.time;
    shadow.mask = blockers;
    shadow.t_max = c.point.reach;
    if (light.distance < kInfinity) {
        if (light.distance > c.point.reach) return Color(0);
        // From the offset origin to just before the light, whose own offset was added to `p`.
        float const moved = dot(shadow.origin - c.point.at.p, light.wi);
        shadow.t_max = (light.distance - moved) * (1 - 4 * std::numeric_limits<float>::epsilon()) -
                       light.p_error;
        if (!(shadow.t_max > 0)) return Color(0);
    }
    Color through = shadow.mask ? world.visibility(shadow, !settings.full_materials) : Color(1);
    if (is_black(through) || !world.has_media()) return through;
    media::MediumStack media = path.media;
    if (c.through) cross_boundary(world, *c.point.surface, light.wi, media);
    uint32_t const alpha_seed =
        world.has_alpha() ? u.walk(sampling::Dimension::Light, vertex).next_uint() : 0;
    through *= media_transmittance(world, shadow, media, alpha_seed);
    return is_hidden(world, light.object, media) ? Color(0) : through;
}

/// Tells the film of light over the connection.
void add(PathSettings const& settings, PathState const& path, Connection const& c,
         Scattered const& scattered, Color const& arriving, film::SampleSink& sink) {
    auto const add_value = [&](Color const& value) {
        add_clamped(
            settings,
            {value * arriving, c.light.light, path.signature, -1,
             c.point.surface ? film::Found::SampledAtSurface : film::Found::SampledInMedium},
            sink);
    };
    film::SampleRecord* const record = c.point.bsdf ? sink.record() : nullptr;
    Vec3 const &wo = c.point.wo, &wi = c.light.wi;
    if (!c.point.bsdf || !settings.by_part) {
        if (record) record_connection(path, *c.point.bsdf, wo, wi, *record);
        return add_value(scattered[0]);
    }
    for (size_t i = 0; i < scattered.size(); ++i) {
        if (is_black(scattered[i])) continue;
        if (record) record_connection(path, *c.point.bsdf, wo, wi, lobes::kParts[i], *record);
        add_value(scattered[i]);
    }
}

/// One light sample at `point`, added to `sink`.
void add_light(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
               ScatterPoint const& point, lights::LightSample const& light,
               sampling::SampleStream const& u, uint32_t vertex, film::SampleSink& sink) {
    if (is_black(light.radiance)) return;
    Connection const c = connection(stage, settings, path, point, light);
    // What rays can find is left to them where the strategy says so.
    if (settings.strategy == scene::Strategy::bsdf && !c.alone) return;
    Scattered const scattered = scatter(settings, path, c);
    if (is_black(sum(scattered))) return;
    Color const visible =
        transmitted(stage.world(), settings, path, c, shadow_mask(settings, c.rules), u, vertex);
    if (is_black(visible)) return;
    add(settings, path, c, scattered, path.throughput * light.radiance * visible / light.pdf, sink);
}

/// One light sample at a shadow catcher, told to `record`.
void catch_light(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
                 ScatterPoint const& point, lights::LightSample const& light,
                 sampling::SampleStream const& u, uint32_t vertex, film::SampleRecord& record) {
    Connection c = connection(stage, settings, path, point, light);
    c.combine = false; // no ray helps
    Scattered const scattered = scatter(settings, path, c);
    Color const arriving = path.throughput * sum(scattered) * light.radiance / light.pdf;
    if (is_black(arriving)) return;
    world::RayMask const blockers = shadow_mask(settings, c.rules);
    auto const past = [&](world::RayMask mask) {
        return transmitted(stage.world(), settings, path, c, mask, u, vertex);
    };
    record.add_caught(arriving * past(blockers ? world::kCatcherMask : 0),
                      arriving * past(blockers));
}

} // namespace

void direct(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
            ScatterPoint const& point, sampling::SampleStream const& u, uint32_t vertex,
            film::SampleSink& sink) {
    stage.lights().sample(stage.world(), point.at, u.get3(sampling::Dimension::Light, vertex),
                          [&](auto const& light) {
                              add_light(stage, settings, path, point, light, u, vertex, sink);
                          });
}

void catch_shadow(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
                  ScatterPoint const& point, sampling::SampleStream const& u, uint32_t vertex,
                  film::SampleRecord& record) {
    stage.lights().sample(stage.world(), point.at, u.get3(sampling::Dimension::Light, vertex),
                          [&](auto const& light) {
                              catch_light(stage, settings, path, point, light, u, vertex, record);
                          });
}

float found_weight(scene::Strategy strategy, PathState const& path, float light_pdf) {
    if (strategy == scene::Strategy::bsdf || path.pdf == 0 || light_pdf == 0) return 1;
    return strategy == scene::Strategy::nee ? 0 : power_heuristic(path.pdf, light_pdf);
}

} // namespace weft::integrator
