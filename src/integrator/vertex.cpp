#include "integrator/vertex.h"

#include <memory>

#include "integrator/controls.h"

namespace weft::integrator {

SurfaceVertex const& Vertex::move_to_surface(Tracer const& tracer, PathState const& path,
                                             world::Hit const& hit) {
    SurfaceVertex const& surface = *std::construct_at(&surface_, tracer.world, path, hit);
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

} // namespace weft::integrator
