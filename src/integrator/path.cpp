#include "integrator/path.h"

#include "base/feature.h"
#include "integrator/controls.h"
#include "integrator/direct.h"
#include "integrator/media_walk.h"
#include "integrator/record.h"
#include "media/phase.h"

namespace weft::integrator {

namespace {

using sampling::Dimension;

/// Emission of a surface that the ray met.
void add_emission(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
                  shading::SurfacePoint const& point, Color const& emission,
                  film::SampleSink& sink) {
    if (is_black(emission)) return;
    int32_t const light = stage.lights().of_object(point.object);
    float const light_pdf =
        light >= 0 && path.pdf > 0 ? stage.lights().pdf(light, path.at, point) : 0;
    float const weight =
        found_weight(settings.strategy, path, light_pdf) *
        found_factor(stage.lights(), settings, path, light, length(point.p - path.at.p));
    add_clamped(settings,
                {path.throughput * emission * weight, light, path.signature, int32_t(point.object)},
                sink);
}

/// Lamps of some size that the ray meets before `limit`, seen through the medium that it is in:
/// wherever the path scatters in it, their light in this direction is the same. The camera looks
/// through those that are hidden from it.
void add_lamps(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
               float limit, film::SampleSink& sink) {
    bool const seen = path.signature.length() == 0;
    lights::LightTable const& lights = stage.lights();
    if (seen && !lights.camera_sees_lamps()) return;
    world::Ray ray = path.ray;
    ray.t_max = std::min(limit, path.ray.t_max);
    int32_t const medium = path.media.current().medium;
    lights.lamps(ray, path.at, [&](int32_t light, Vec3 const& p, Color const& radiance, float pdf) {
        if (seen && lights[light].hidden_from_camera) return;
        float const light_pdf = path.pdf > 0 ? pdf : 0;
        float const weight =
            found_weight(settings.strategy, path, light_pdf) *
            found_factor(stage.lights(), settings, path, light, length(p - path.at.p));
        Color value = path.throughput * radiance * weight;
        if (medium >= 0)
            value *=
                media::transmittance(stage.world().medium(medium), length(p - path.ray.origin));
        add_clamped(settings, {value, light, path.signature}, sink);
    });
}

/// Light from infinitely far away along a ray that met nothing.
void add_background(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
                    film::SampleSink& sink) {
    Color seen;
    lights::LightTable const& lights = stage.lights();
    lights.environment(
        path.at, path.ray.direction, [&](int32_t light, Color const& radiance, float pdf) {
            if (path.signature.length() == 0 && lights[light].hidden_from_camera) return;
            seen += radiance;
            float const weight = found_weight(settings.strategy, path, pdf) *
                                 found_factor(stage.lights(), settings, path, light, kInfinity);
            add_clamped(settings,
                        {path.throughput * radiance * weight, light, path.signature, -1,
                         film::Found::InBackground},
                        sink);
        });
    if (sink.record()) record_background(path, seen, *sink.record());
}

/// The camera sees through a hole that an object cuts: black, with the alpha of a background. What
/// the object itself lets straight through is no part of the hole. Whether there is any.
bool hold_out(PathState& path, lobes::Bsdf const& bsdf, bool is_see_through,
              film::SampleSink& sink) {
    Color const through = is_see_through ? path.throughput * bsdf.straight() : Color(0);
    path.held_out += average(path.throughput - through);
    path.throughput = through;
    film::SampleRecord* const record = sink.record();
    if (!is_black(through)) {
        if (record) record->set_alpha(1 - path.held_out);
        return true;
    }
    if (record) record_background(path, Color(0), *record);
    return false;
}

/// Free flight through the current medium up to `limit`. Whether the path scattered, at the
/// ray's new origin.
bool fly(world::World const& world, PathState& path, float limit, sampling::SampleStream const& u,
         uint32_t vertex) {
    int32_t const medium = path.media.current().medium;
    if (medium < 0) return false;
    FeatureScope const scope(Feature::Media);
    Vec2 const u_distance = u.get2(Dimension::Distance, vertex);
    media::MediumSample const s =
        media::sample_distance(world.medium(medium), path.throughput, limit, u_distance);
    path.throughput *= s.weight;
    if (!s.scattered) return false;
    path.ray.origin += path.ray.direction * s.distance;
    path.ray.cone.width = path.ray.cone.width_at(s.distance);
    path.ray.t_min = world::Ray().t_min;
    return true;
}

/// Light sampling at the ray's origin inside the medium, and a new direction.
void scatter_in_medium(lights::Stage const& stage, PathSettings const& settings, PathState& path,
                       uint32_t vertex, sampling::SampleStream const& u, film::SampleSink& sink) {
    FeatureScope const scope(Feature::Media);
    ScatterPoint point;
    point.at = {path.ray.origin, Vec3(0), light_choices(settings, path)};
    point.wo = -path.ray.direction;
    world::World const& world = stage.world();
    point.g = world.medium(path.media.current().medium).g;
    if (uint32_t const object = path.media.current().object; object != UINT32_MAX)
        point.sets = world.object(object).sets;
    path.signature.append(film::Bounce::Volume);
    path.scattered = path.diffused = true;
    path.caustic = false;
    if (sink.record()) record_volume(path, *sink.record());
    direct(stage, settings, path, point, u, vertex, sink);
    path.at = point.at;
    path.sets = point.sets;
    path.kind = world::RayKind::volume;
    path.ray.mask = ray_mask(settings, path.kind);
    path.ray.t_max = kInfinity;
    path.ray.direction =
        media::sample_henyey_greenstein(point.wo, point.g, u.get2(Dimension::Phase, vertex));
    path.pdf = media::henyey_greenstein(dot(point.wo, path.ray.direction), point.g);
    path.ray.cone = world::scattered(path.ray.cone, path.pdf, settings.footprint_scale);
}

/// The rest of the path starts at `point` towards `direction`.
void continue_from(world::World const& world, PathState& path, shading::SurfacePoint const& point,
                   Vec3 const& direction, bool through) {
    if (through) cross_boundary(world, point, direction, path.media);
    path.ray.origin = shading::offset_origin(point, direction);
    path.ray.direction = direction;
    path.ray.t_min = world::Ray().t_min;
    path.ray.t_max -= point.t;
    path.ray.cone.width = path.ray.cone.width_at(point.t);
}

/// Where light that goes to `wo` may come from.
lobes::BsdfSample sample_bsdf(lobes::Bsdf const& bsdf, Vec3 const& wo, Vec3 const& u,
                              bool by_part) {
    FeatureScope const scope(Feature::Bsdf);
    return bsdf.sample(wo, u, by_part);
}

/// Scattering at a surface by the sample `s`. Whatever goes straight on where light sampling sees
/// through as well is no scattering: the last one stays the one that what is found is weighed by.
/// Whether it was one.
bool scatter(PathSettings const& settings, PathState& path, lobes::BsdfSample const& s,
             ScatterPoint const& point, bool see_through) {
    path.throughput *= s.weight;
    if (see_through && any(s.flags, lobes::LobeFlags::Straight)) return false;
    path.eta_scale *= s.eta_scale;
    bool const delta = any(s.flags, lobes::LobeFlags::Delta);
    path.pdf = delta ? 0 : s.pdf;
    path.scattered |= !delta;
    path.at = point.at;
    path.sets = point.sets;
    bool const diffuse = any(s.flags, lobes::LobeFlags::Diffuse);
    path.caustic = path.diffused && !diffuse;
    path.diffused |= diffuse;
    path.kind = scattering_kind(s.flags, any(s.flags, lobes::LobeFlags::Transmission));
    path.ray.mask = ray_mask(settings, path.kind);
    path.ray.t_max = point.reach;
    path.signature.append(bounce_kind(s.flags));
    return true;
}

/// Ends paths that carry little, and strengthens those that survive: the mean stays. The root
/// makes it gentle: ending paths in proportion to what they carry costs more noise than it saves
/// time.
bool survives_roulette(PathState& path, float u) {
    float const survival =
        std::min(1.f, std::sqrt(max_component(path.throughput) * path.eta_scale));
    if (u >= survival) return false;
    path.throughput *= 1 / survival;
    return true;
}

} // namespace

void trace_path(lights::Stage const& stage, PathSettings const& settings, world::Ray const& ray,
                media::MediumStack const& media, sampling::SampleStream const& u,
                film::SampleSink& sink) {
    world::World const& world = stage.world();
    PathState path;
    path.ray = ray;
    path.ray.mask = ray_mask(settings, path.kind);
    path.at.p = ray.origin;
    path.media = media;
    uint32_t crossings = 0; // of surfaces that are no vertex
    for (uint32_t vertex = 1; vertex <= settings.depth; ++vertex) {
        if (crossings > kMaxCrossings) return;
        uint32_t const step = vertex + crossings;
        uint32_t const alpha_seed =
            world.has_alpha() ? u.walk(Dimension::Alpha, step).next_uint() : 0;
        world::Hit const hit = world.intersect(path.ray, alpha_seed);
        add_lamps(stage, settings, path, hit.t, sink);

        if (fly(world, path, hit.t, u, step)) {
            if (vertex == settings.depth) return;
            scatter_in_medium(stage, settings, path, step, u, sink);
        } else if (!hit) {
            add_background(stage, settings, path, sink);
            return;
        } else {
            shading::SurfacePoint const point = world.surface(path.ray, hit);
            world::Object const& object = world.object(hit.object);
            bool const hidden =
                object.has_interior && !path.media.is_visible(hit.object, object.rank);
            if (object.is_null || hidden) { // no vertex: straight on
                ++crossings;
                continue_from(world, path, point, path.ray.direction, true);
                --vertex;
                continue;
            }
            Vec3 const wo = -path.ray.direction;
            shading::Shading shading =
                world.shade(point, wo, path.media, path.scattered && !settings.full_materials,
                            path.scattered ? settings.secondary_roughness : 0);
            if (path.diffused && !settings.secondary_specular) shading.bsdf.keep_diffuse();
            ScatterPoint const here{
                {point.p, shading.bsdf.frame().n, light_choices(settings, path)},
                wo,
                &shading.bsdf,
                &point,
                0,
                object.sets,
                reach_of(settings, object)};
            bool const last = vertex == settings.depth;
            if (is_matte(settings, path, object)) {
                if (object.holdout) {
                    if (!hold_out(path, shading.bsdf, object.is_see_through, sink)) return;
                } else if (sink.record() && !last) {
                    catch_shadow(stage, settings, path, here, u, step, *sink.record());
                }
                ++crossings; // no vertex, either
                continue_from(world, path, point, path.ray.direction, false);
                --vertex;
                continue;
            }
            if (sink.record()) record_surface(world, path, point, shading, *sink.record());
            add_emission(stage, settings, path, point, shading.emission, sink);
            if (last && !object.is_see_through) return;

            if (shading.bsdf.has_smooth() && !stage.lights().empty() && !last)
                direct(stage, settings, path, here, u, step, sink);

            lobes::BsdfSample const s =
                sample_bsdf(shading.bsdf, wo, u.get3(Dimension::Bsdf, step), settings.by_part);
            if (!(s.pdf > 0)) return;
            if (sink.record())
                record_bounce(settings, path, shading.bsdf, wo, s, object.is_see_through,
                              *sink.record());
            continue_from(world, path, point, s.wi, any(s.flags, lobes::LobeFlags::Transmission));
            if (scatter(settings, path, s, here, object.is_see_through)) {
                if (last) return;
                path.ray.cone = world::scattered(path.ray.cone, path.pdf, settings.footprint_scale);
            } else { // no vertex, as where opacity leaves a hole
                ++crossings;
                --vertex;
            }
        }
        if (is_black(path.throughput)) return;
        if (vertex >= settings.roulette_depth &&
            !survives_roulette(path, u.get1(Dimension::Roulette, step)))
            return;
    }
}

} // namespace weft::integrator
