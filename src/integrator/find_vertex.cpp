#include "integrator/find_vertex.h"

#include "integrator/controls.h"
#include "integrator/direct.h"
#include "integrator/found_light.h"
#include "integrator/media_walk.h"
#include "integrator/place.h"
#include "integrator/record.h"

namespace weft::integrator {

namespace {

using sampling::Dimension;

/// Returns what decides which surfaces of partial opacity the path's ray meets.
uint32_t alpha_seed(Tracer const& t, PathState const& path) {
    return t.world.has_alpha() ? t.stream.walk(Dimension::Alpha, path.step).next_uint() : 0;
}

/// Samples how far the path flies through the medium that it is in. Returns the distance to where
/// it scatters; `limit` where it gets that far.
float fly(Tracer const& t, PathState& path, float limit) {
    int32_t const medium = path.media.current().medium;
    if (medium < 0) return limit;
    FeatureScope const scope(Feature::Media);
    media::MediumSample const s =
        media::sample_distance(t.world.medium(medium), path.throughput, limit,
                               t.stream.get2(Dimension::Distance, path.step));
    path.throughput *= s.weight;
    return s.scattered ? s.distance : limit;
}

/// Changes what the path carries by a factor of radiance.
void scale_radiance(PathState& path, float factor) {
    path.throughput *= factor;
    path.eta_scale /= factor;
}

/// Lets the path go straight on behind `point`.
void go_on_behind(PathState& path, shading::SurfacePoint const& point) {
    world::Ray& ray = path.ray;
    ray.origin = shading::offset_origin(point, ray.direction);
    ray.t_min = world::Ray().t_min;
    ray.t_max -= point.t;
    ray.cone.width = ray.cone.width_at(point.t);
}

/// Lets the camera see through a hole that the object cuts: black, with the alpha of a background.
/// What the material lets straight through does not belong to the hole. Returns whether there is
/// any such light.
bool hold_out(Tracer const& t, PathState& path, SurfaceVertex const& surface) {
    Color const through =
        surface.model.is_see_through ? path.throughput * surface.bsdf().straight() : Color(0);
    path.held_out += average(path.throughput - through);
    path.throughput = through;
    film::SampleRecord* const record = t.record();
    if (!is_black(through)) {
        if (record) record->set(film::Aov::alpha, 1 - path.held_out);
        return true;
    }
    if (record) record_background(path, Color(0), *record);
    return false;
}

/// Shows the camera what is to be seen in a matte object's place. Returns whether the path goes on
/// behind it.
bool show_matte(Tracer const& t, PathState& path, Vertex const& here) {
    if (here.surface()->model.traits.holdout) return hold_out(t, path, *here.surface());
    if (t.record() && path.bounces() + 1 < t.settings.depth) catch_shadow(t, path, here);
    return true;
}

} // namespace

bool find_vertex(Tracer const& t, PathState& path, Vertex& here) {
    for (++path.step; path.step <= path.bounces() + 1 + kMaxCrossings; ++path.step) {
        uint32_t const seed = alpha_seed(t, path);
        world::Hit const hit = t.world.intersect(path.ray, seed);
        add_lamps(t, path, hit.t);
        if (float const distance = fly(t, path, hit.t); distance < hit.t) {
            here.move_into_medium(t, path, distance);
            if (hit) here.keep_before(t, path, hit);
            return true;
        }
        if (!hit) {
            add_background(t, path);
            return false;
        }
        Place const place =
            place_at(t.world, path.ray, hit, world::Query::closest, seed, path.media);
        scale_radiance(path, place.radiance_here);
        if (!place.is_seen) {
            place.crossings.cross(path.media);
            scale_radiance(path, place.radiance_through);
            go_on_behind(path, point_of(t.world, path.ray, place));
            continue;
        }
        SurfaceVertex const& surface = here.move_to_surface(t, path, place);
        if (!is_matte(t.settings, path, surface.model)) return true;
        if (!show_matte(t, path, here)) return false;
        go_on_behind(path, surface.point);
    }
    return false;
}

void pass_through(PathState& path, SurfaceVertex const& surface) {
    surface.crossings.cross(path.media);
    scale_radiance(path, surface.radiance_through(ScatteringKind::Straight));
    go_on_behind(path, surface.point);
}

SurfaceVertex const* find_first_surface(Tracer const& t, PathState& path, Vertex& here) {
    while (find_vertex(t, path, here)) {
        SurfaceVertex const* const surface = here.surface();
        if (!surface || !surface->model.is_see_through) return surface;
        if (!surface->passes(here.sample(t.stream, path.step, t.settings.by_part))) return surface;
        pass_through(path, *surface);
    }
    return nullptr;
}

} // namespace weft::integrator
