#include "integrator/path.h"

#include "integrator/controls.h"
#include "integrator/direct.h"
#include "integrator/find_vertex.h"
#include "integrator/found_light.h"
#include "integrator/record.h"

namespace weft::integrator {

PathState::PathState(PathSettings const& settings, world::Ray const& camera_ray,
                     media::MediumStack const& inside)
    : ray(camera_ray), media(inside) {
    look.fold = settings.fold_normals;
    ray.mask = ray_mask(settings, last.kind);
    last.at.p = ray.origin;
}

namespace {

/// Remembers that the path was scattered at `here` by the sample `s`.
void remember(Tracer const& t, PathState& path, Vertex const& here, lobes::BsdfSample const& s) {
    ScatteringKind const kind = s.scattering.kind;
    bool const delta = is_delta(kind);
    path.last = {here.at, delta ? 0 : s.pdf, ray_kind(s.scattering), here.sets};
    path.signature.append(s.scattering);
    path.scattered |= !delta;
    path.caustic = path.diffused && !is_diffuse(kind);
    path.diffused |= is_diffuse(kind);
    if (path.scattered) path.look = look_after(t.settings, path.diffused);
}

/// Sends the path's ray from `here` towards `wi`.
void leave(Tracer const& t, PathState& path, Vertex const& here, Vec3 const& wi,
           Scattering scattering) {
    if (scattering.through) {
        SurfaceVertex const& surface = *here.surface();
        surface.crossings.cross(path.media);
        float const factor = surface.radiance_through(scattering.kind);
        path.throughput *= factor;
        path.eta_scale /= factor;
    }
    world::Ray& ray = path.ray;
    ray.origin = here.origin(wi);
    ray.direction = wi;
    ray.t_min = world::Ray().t_min;
    ray.t_max = here.reach;
    ray.mask = ray_mask(t.settings, path.last.kind);
    ray.cone.width = ray.cone.width_at(here.t);
    ray.cone = world::scattered(ray.cone, path.last.pdf, t.settings.footprint_scale);
}

/// Scatters the path at `here`. What goes straight through where light sampling also sees through
/// is no scattering: the last one stays what it was. Returns false where the path ends.
bool scatter(Tracer const& t, PathState& path, Vertex const& here) {
    lobes::BsdfSample const s = here.sample(t.stream, path.step, t.settings.by_part);
    if (!(s.pdf > 0)) return false;
    SurfaceVertex const* const surface = here.surface();
    if (surface && t.record()) record_bounce(t, path, *surface, s);
    path.throughput *= s.weight;
    if (surface && surface->passes(s)) {
        pass_through(path, *surface);
        return true;
    }
    path.eta_scale *= s.eta_scale;
    remember(t, path, here, s);
    leave(t, path, here, s.wi, s.scattering);
    return true;
}

/// Ends paths that carry nothing, and at random some of those that carry little; strengthens those
/// that survive, so that the mean stays. Returns whether the path goes on. The root makes it
/// gentle: ending paths in proportion to what they carry costs more noise than it saves time.
bool survives_roulette(Tracer const& t, PathState& path) {
    if (is_black(path.throughput)) return false;
    if (path.bounces() < t.settings.roulette_depth) return true;
    float const survival =
        std::min(1.f, std::sqrt(max_component(path.throughput) * path.eta_scale));
    if (t.stream.get1(sampling::Dimension::Roulette, path.step) >= survival) return false;
    path.throughput *= 1 / survival;
    return true;
}

/// Goes from vertex to vertex, to the path's end.
void follow(Tracer const& t, PathState& path) {
    Vertex here;
    while (path.bounces() < t.settings.depth && survives_roulette(t, path) &&
           find_vertex(t, path, here)) {
        if (t.record()) record_vertex(t, path, here);
        if (here.surface()) add_emission(t, path, *here.surface());
        bool const last = path.bounces() + 1 == t.settings.depth;
        if (last && !here.is_see_through()) return;
        if (!last) direct(t, path, here);
        if (!scatter(t, path, here)) return;
    }
}

} // namespace

void trace_path(Tracer const& t, world::Ray const& camera_ray, media::MediumStack const& media) {
    PathState path(t.settings, camera_ray, media);
    follow(t, path);
    if (path.media.has_overflowed()) t.sink.lose_track();
}

} // namespace weft::integrator
