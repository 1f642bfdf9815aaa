#include "integrator/direct.h"

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

} // namespace

void direct(world::World const& world, PathSettings const& settings, PathState const& path,
            ScatterPoint const& point, sampling::SampleStream const& u, uint32_t vertex,
            film::SampleSink& sink) {
    using sampling::Dimension;
    scene::Strategy const strategy = settings.strategy;
    world::LightSample const light =
        world.lights().sample(point.p, point.n, u.get3(Dimension::Light, vertex));
    // What rays can find is left to them where the strategy says so.
    if (!(light.pdf > 0) || (strategy == scene::Strategy::bsdf && !light.delta)) return;
    lobes::LobeValue const value = point.eval(light.wi);
    if (is_black(value.f) || is_black(light.radiance)) return;
    world::Ray shadow;
    shadow.origin = point.origin(light.wi);
    shadow.direction = light.wi;
    shadow.t_max = light.distance;
    shadow.time = path.ray.time;
    if (light.distance < kInfinity) {
        // From the offset origin to just before the light, whose own offset was added to `p`.
        float const moved = dot(shadow.origin - point.p, light.wi);
        shadow.t_max = (light.distance - moved) * (1 - 4 * std::numeric_limits<float>::epsilon()) -
                       light.p_error;
        if (!(shadow.t_max > 0)) return;
    }
    Color through = world.visibility(shadow, !settings.full_materials);
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
    bool const combine = strategy == scene::Strategy::mis && !light.delta;
    float const weight = combine ? power_heuristic(light.pdf, value.pdf) : 1;
    if (sink.record() && point.bsdf)
        record_connection(path, *point.bsdf, point.wo, light.wi, *sink.record());
    sink.add({path.throughput * value.f * light.radiance * through * (weight / light.pdf),
              light.light, path.signature, -1, point.surface != nullptr});
}

float found_weight(scene::Strategy strategy, PathState const& path, float light_pdf) {
    if (strategy == scene::Strategy::bsdf || path.pdf == 0 || light_pdf == 0) return 1;
    return strategy == scene::Strategy::nee ? 0 : power_heuristic(path.pdf, light_pdf);
}

} // namespace weft::integrator
