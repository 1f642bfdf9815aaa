#include "integrator/vertex.h"

#include <memory>

#include "integrator/controls.h"

namespace weft::integrator {

SurfaceVertex const& Vertex::move_to_surface(Tracer const& tracer, PathState const& path,
                                             Place const& place) {
    SurfaceVertex const& surface = *std::construct_at(&surface_, tracer.world, path, place);
    on_surface_ = true;
    at = {surface.point.p, surface.bsdf().frame().n, light_choices(tracer.settings, path)};
    wo = -path.ray.direction;
    t = surface.point.t;
    sets = surface.model.sets;
    reach = reach_of(tracer.settings, surface.model);
    return surface;
}

void Vertex::move_into_medium(Tracer const& tracer, PathState const& path, float distance) {
    media::Interior const& inside = path.media.current();
    medium_ = MediumVertex(tracer.world.medium(inside.medium).g);
    on_surface_ = false;
    at = {path.ray.origin + path.ray.direction * distance, Vec3(0),
          light_choices(tracer.settings, path)};
    wo = -path.ray.direction;
    t = distance;
    sets = inside.object != UINT32_MAX ? tracer.world.model(inside.object).sets : 0;
    reach = kInfinity;
}

void Vertex::keep_before(Tracer const& tracer, PathState const& path, world::Hit const& hit) {
    shading::SurfacePoint const point = tracer.world.surface(path.ray, hit);
    Vec3 const back = dot(wo, point.ng) < 0 ? -point.ng : point.ng;
    Vec3 const error = point.p_error + abs(at.p) * world::kRounding;
    if (dot(at.p - point.p, back) <= dot(abs(back), error))
        at.p = shading::offset_origin(point, wo);
}

} // namespace weft::integrator
