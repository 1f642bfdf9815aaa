#include "integrator/media_walk.h"

#include <vector>

#include "base/feature.h"

namespace weft::integrator {

void cross_boundary(world::World const& world, shading::SurfacePoint const& point,
                    Vec3 const& direction, media::MediumStack& stack) {
    if (!world.model(point.object).has_interior) return;
    if (dot(direction, point.ng) < 0)
        stack.enter(world.interior(point));
    else
        stack.leave(point.object);
}

Color media_transmittance(world::World const& world, world::Ray ray, media::MediumStack& stack,
                          uint32_t alpha_seed) {
    FeatureScope const scope(Feature::Media);
    Color through(1);
    for (uint32_t crossing = 0; crossing < kMaxCrossings; ++crossing) {
        world::Hit const hit = world.intersect_passable(ray, alpha_seed);
        int32_t const medium = stack.current().medium;
        if (medium >= 0)
            through *= media::transmittance(world.medium(medium), std::min(hit.t, ray.t_max));
        if (!hit || is_black(through)) return through;
        shading::SurfacePoint const point = world.surface(ray, hit);
        if (!world.model(hit.object).is_null &&
            stack.is_visible(hit.object, world.object(hit.object).rank))
            return Color(0);
        cross_boundary(world, point, ray.direction, stack);
        Vec3 const origin = shading::offset_origin(point, ray.direction);
        ray.t_max -= dot(origin - ray.origin, ray.direction);
        ray.origin = origin;
        if (!(ray.t_max > 0)) return through;
    }
    return Color(0);
}

media::MediumStack media_at(world::World const& world, Vec3 const& p) {
    // Objects whose first crossing leaves them contain the point.
    std::vector<media::Interior> containing;
    std::vector<uint32_t> seen;
    world::Ray ray;
    ray.origin = p;
    ray.direction = normalize(Vec3(0.4082f, 0.7071f, 0.5774f));
    for (uint32_t crossing = 0; crossing < kMaxCrossings; ++crossing) {
        world::Hit const hit = world.intersect_solid(ray);
        if (!hit) break;
        shading::SurfacePoint const point = world.surface(ray, hit);
        bool const fresh = std::find(seen.begin(), seen.end(), point.object) == seen.end();
        seen.push_back(point.object);
        if (fresh && world.model(point.object).has_interior && dot(point.ng, ray.direction) > 0)
            containing.push_back(world.interior(point));
        ray.origin = shading::offset_origin(point, ray.direction);
    }
    // The outermost is left last, so it was entered first.
    media::MediumStack stack = world.outside();
    for (auto it = containing.rbegin(); it != containing.rend(); ++it) stack.enter(*it);
    return stack;
}

} // namespace weft::integrator
