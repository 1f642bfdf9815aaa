#include "integrator/direct.h"

#include "integrator/controls.h"
#include "integrator/media_walk.h"
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

/// What goes on towards the camera of light from `light`: the value there, weighted against the
/// rays that may find it, where `combine`, and the part that the light's controls let count.
Color scattered(PathSettings const& settings, PathState const& path, ScatterPoint const& point,
                world::LightSample const& light, world::LightRules const* rules, uint32_t bounces,
                bool combine) {
    using lobes::LobeFlags;
    auto const weighted = [&](lobes::LobeValue const& v) {
        return combine ? v.f * power_heuristic(light.pdf, v.pdf) : v.f;
    };
    auto const factor = [&](world::RayKind kind) {
        return rules ? rules->factor({point.p, point.sets, bounces, kind, light.distance}) : 1.f;
    };
    if (!point.bsdf) return weighted(point.eval(light.wi)) * factor(world::RayKind::volume);
    if (!settings.by_part) return weighted(point.eval(light.wi)) * factor(world::RayKind::diffuse);
    bool const through = dot(light.wi, point.surface->ng) * dot(point.wo, point.surface->ng) < 0;
    Color sum(0);
    for (LobeFlags part : {LobeFlags::Diffuse, LobeFlags::Glossy}) {
        if (part == LobeFlags::Glossy && path.diffused && !settings.caustics) continue;
        lobes::LobeValue const v = point.bsdf->eval_part(point.wo, light.wi, part);
        if (is_black(v.f)) continue;
        sum += weighted(v) * factor(scattering_kind(part, through));
    }
    return sum;
}

} // namespace

void direct(world::World const& world, PathSettings const& settings, PathState const& path,
            ScatterPoint const& point, sampling::SampleStream const& u, uint32_t vertex,
            film::SampleSink& sink) {
    using sampling::Dimension;
    scene::Strategy const strategy = settings.strategy;
    world::LightSample const light =
        world.lights().sample(point.p, point.n, u.get3(Dimension::Light, vertex));
    if (!(light.pdf > 0)) return;
    world::LightRules const* rules = rules_of(world, settings, light.light);
    bool const alone = light.delta || (rules && rules->sampling_alone);
    // What rays can find is left to them where the strategy says so.
    if (strategy == scene::Strategy::bsdf && !alone) return;
    uint32_t const bounces = path.signature.length() + (point.bsdf ? 1 : 0);
    Color const value = scattered(settings, path, point, light, rules, bounces,
                                  strategy == scene::Strategy::mis && !alone);
    if (is_black(value) || is_black(light.radiance)) return;
    world::Ray shadow;
    shadow.origin = point.origin(light.wi);
    shadow.direction = light.wi;
    shadow.time = path.ray.time;
    shadow.mask = !settings.controls ? world::kUnruledMask
                  : rules            ? rules->shadow_mask
                                     : world::kShadowMask;
    shadow.t_max = point.reach;
    if (light.distance < kInfinity) {
        if (light.distance > point.reach) return;
        // From the offset origin to just before the light, whose own offset was added to `p`.
        float const moved = dot(shadow.origin - point.p, light.wi);
        shadow.t_max = (light.distance - moved) * (1 - 4 * std::numeric_limits<float>::epsilon()) -
                       light.p_error;
        if (!(shadow.t_max > 0)) return;
    }
    Color through = shadow.mask ? world.visibility(shadow, !settings.full_materials) : Color(1);
    if (is_black(through)) return;
    if (world.has_media()) {
        media::MediumStack media = path.media;
        bool const crosses =
            point.surface &&
            dot(light.wi, point.surface->ng) * dot(point.wo, point.surface->ng) < 0;
        if (crosses) cross_boundary(world, *point.surface, light.wi, media);
        uint32_t const alpha_seed =
            world.has_alpha() ? u.walk(Dimension::Light, vertex).next_uint() : 0;
        through *= media_transmittance(world, shadow, media, alpha_seed);
        if (is_black(through) || is_hidden(world, light.object, media)) return;
    }
    Color const contribution = path.throughput * value * light.radiance * through / light.pdf;
    sink.add({clamped(settings, contribution, bounces), light.light, path.signature});
}

float found_weight(scene::Strategy strategy, PathState const& path, float light_pdf) {
    if (strategy == scene::Strategy::bsdf || path.pdf == 0 || light_pdf == 0) return 1;
    return strategy == scene::Strategy::nee ? 0 : power_heuristic(path.pdf, light_pdf);
}

} // namespace weft::integrator
