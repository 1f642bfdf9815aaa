#include "integrator/media_walk.h"

#include "base/feature.h"
#include "integrator/place.h"

namespace weft::integrator {

Color media_transmittance(world::World const& world, world::Ray ray, media::MediumStack& stack,
                          uint32_t alpha_seed) {
    FeatureScope const scope(Feature::Media);
    Color through(1);
    float skipped = 0; // of the ray's length, where it was moved past the errors of a surface
    for (uint32_t crossing = 0; crossing < kMaxCrossings; ++crossing) {
        world::Hit const hit = world.intersect_passable(ray, alpha_seed);
        int32_t const medium = stack.current().medium;
        if (medium >= 0)
            through *= media::transmittance(world.medium(medium),
                                            std::max(0.f, std::min(hit.t, ray.t_max) + skipped));
        if (!hit || is_black(through)) return through;
        Place const place = place_at(world, ray, hit, world::Query::passable, alpha_seed, stack);
        if (place.is_seen) return Color(0);
        place.crossings.cross(stack);
        through *= place.radiance_here * place.radiance_through;
        Vec3 const origin = shading::offset_origin(point_of(world, ray, place), ray.direction);
        float const moved = dot(origin - ray.origin, ray.direction);
        skipped = moved - hit.t;
        ray.t_max -= moved;
        ray.origin = origin;
        if (!(ray.t_max > 0)) return through;
    }
    return Color(0);
}

} // namespace weft::integrator
