#include "integrator/place.h"

#include <vector>

#include "integrator/media_walk.h"

namespace weft::integrator {

void Crossings::add(media::Interior const& inside, int turns) {
    for (uint32_t i = 0; i < size_; ++i)
        if (all_[i].inside.object == inside.object) {
            all_[i].turns += turns;
            return;
        }
    all_[size_++] = {inside, turns};
}

int Crossings::turns(uint32_t object) const {
    for (Crossing const& c : *this)
        if (c.inside.object == object) return c.turns;
    return 0;
}

void Crossings::cross(media::MediumStack& stack) const {
    for (Crossing const& c : *this)
        if (c.turns < 0) stack.leave(c.inside.object, -c.turns);
    for (Crossing const& c : *this)
        if (c.turns > 0) stack.enter(c.inside, c.turns);
}

namespace {

/// A surface near the closest hit of a ray.
struct Met {
    world::Hit hit;
    Vec3 p, ng, error;
    media::Interior inside;
    bool has_inside, is_null;
    bool is_front; ///< the ray meets the object from outside
    bool is_there; ///< it belongs to the place
};

/// The surfaces near the closest hit of a ray, from which a place is made.
struct Surfaces {
    uint32_t size = 0;
    Vec3 error; ///< how far each coordinate of any that is there may be off
    union {     // not initialised: the first `size` are written
        std::array<Met, world::NearHits::kMost> all;
    };

    Surfaces(world::World const& world, world::Ray const& ray, world::Hit const& hit,
             world::Query query, uint32_t alpha_seed);
    Surfaces(Surfaces const&) = delete;

    void add(world::World const& world, shading::SurfacePoint const& point, world::Hit const& hit,
             Vec3 const& direction);
    void gather();
    Crossings crossings() const;
    /// Returns the error with which a ray from the point of `met` starts past all that is there.
    Vec3 error_at(Met const& met) const {
        return error + abs(met.ng) * std::abs(dot(met.p - all[0].p, met.ng));
    }
};

void Surfaces::add(world::World const& world, shading::SurfacePoint const& point,
                   world::Hit const& hit, Vec3 const& direction) {
    world::Model const& model = world.model(hit.object);
    all[size++] = {hit,
                   point.p,
                   point.ng,
                   point.p_error,
                   model.has_interior ? world.interior(point) : media::Interior(),
                   model.has_interior,
                   model.is_null,
                   dot(direction, point.ng) < 0,
                   false};
}

/// Returns whether a ray that crosses `from` starts so far behind it, by an error of each
/// coordinate, that it does not cross `other` any more.
bool jumps_over(Met const& from, Met const& other, Vec3 const& error) {
    auto const behind = [](Met const& m) { return m.is_front ? -m.ng : m.ng; };
    Vec3 const origin = from.p + behind(from) * dot(abs(from.ng), error);
    return dot(origin - other.p, behind(other)) >= 0;
}

/// Finds the surfaces that a ray past the errors of the first would jump over, and so on.
void Surfaces::gather() {
    Met& closest = all[0];
    closest.is_there = true;
    error = closest.error;
    for (bool grown = size > 1; grown;) {
        grown = false;
        for (uint32_t i = 1; i < size; ++i) {
            Met& other = all[i];
            Vec3 const wider = max(error, closest.error + other.error);
            if (other.is_there || !jumps_over(closest, other, wider)) continue;
            other.is_there = grown = true;
            error = wider;
        }
    }
}

Surfaces::Surfaces(world::World const& world, world::Ray const& ray, world::Hit const& hit,
                   world::Query query, uint32_t alpha_seed) {
    shading::SurfacePoint const first = world.surface(ray, hit);
    world::NearHits near;
    world.hits_near(ray, first, query, alpha_seed, near);
    // Of several at one distance the kernel may have given any.
    world::Hit const* const closest = near.closest();
    if (!closest || (closest->object == hit.object && closest->primitive == hit.primitive))
        add(world, first, hit, ray.direction);
    else
        add(world, world.surface(ray, *closest), *closest, ray.direction);
    for (world::Hit const& other : near)
        if (&other != closest) add(world, world.surface(ray, other), other, ray.direction);
    gather();
}

Crossings Surfaces::crossings() const {
    Crossings crossings;
    for (uint32_t i = 0; i < size; ++i)
        if (Met const& m = all[i]; m.is_there && m.has_inside)
            crossings.add(m.inside, m.is_front ? 1 : -1);
    return crossings;
}

float radiance_ratio(float ior_before, float ior_after) {
    return ior_before == ior_after ? 1 : square(ior_before / ior_after);
}

/// Makes `stack` agree with what a ray is about to cross. Returns what radiance changes by.
float correct(world::World const& world, Crossings const& crossings, media::MediumStack& stack) {
    float const before = stack.current().ior;
    for (Crossings::Crossing const& c : crossings) {
        int const count = stack.count(c.inside.object);
        if (c.turns < 0 && count < -c.turns) stack.enter(c.inside, -c.turns - count);
        // A part may lie inside of another one; without parts, the ray has got out by a hole.
        if (c.turns > 0 && count > 0 && !world.model(c.inside.object).has_parts)
            stack.leave(c.inside.object, count);
    }
    return radiance_ratio(before, stack.current().ior);
}

/// Returns the surface that is seen where a ray passes from `here` to `there`; null: none. What has
/// no inside is seen from both sides. Else it is the boundary of what ends or begins there, of both
/// the one of the higher rank.
Met const* seen(Surfaces const& s, Crossings const& crossings, media::Interior const& here,
                media::Interior const& there) {
    bool const changes = here.object != there.object;
    bool const ends = changes && crossings.turns(here.object) < 0;
    bool const begins = changes && crossings.turns(there.object) > 0;
    Met const* best = nullptr;
    for (uint32_t i = 0; i < s.size; ++i) {
        Met const& m = s.all[i];
        if (!m.is_there) continue;
        if (!m.has_inside) return &m;
        bool const shows = m.is_front ? begins && m.hit.object == there.object
                                      : ends && m.hit.object == here.object;
        if (shows && !m.is_null && (!best || m.inside.rank > best->inside.rank)) best = &m;
    }
    return best;
}

} // namespace

Place place_at(world::World const& world, world::Ray const& ray, world::Hit const& hit,
               world::Query query, uint32_t alpha_seed, media::MediumStack& stack) {
    Place place;
    place.hit = hit;
    if (!world.may_coincide(hit.object)) return place;
    Surfaces const s(world, ray, hit, query, alpha_seed);
    place.crossings = s.crossings();
    place.radiance_here = correct(world, place.crossings, stack);
    media::MediumStack beyond = stack;
    place.crossings.cross(beyond);
    media::Interior const &here = stack.current(), &there = beyond.current();
    Met const* const shown = seen(s, place.crossings, here, there);
    Met const& met = shown ? *shown : s.all[0];
    place.is_seen = shown != nullptr;
    place.hit = met.hit;
    place.error = s.error_at(met);
    if (place.is_seen && met.has_inside)
        place.ior_outside = met.hit.object == there.object ? here.ior : there.ior;
    place.radiance_through = radiance_ratio(here.ior, there.ior);
    return place;
}

shading::SurfacePoint point_of(world::World const& world, world::Ray const& ray,
                               Place const& place) {
    shading::SurfacePoint point = world.surface(ray, place.hit);
    if (place.error) point.p_error = *place.error;
    return point;
}

media::MediumStack media_at(world::World const& world, Vec3 const& p) {
    if (!world.has_interiors()) return world.outside();
    // The winding number of an object around the point says whether the point lies in it.
    std::vector<Crossings::Crossing> met;
    world::Ray ray;
    ray.origin = p;
    ray.direction = normalize(Vec3(0.4082f, 0.7071f, 0.5774f));
    for (uint32_t crossing = 0; crossing < kMaxCrossings; ++crossing) {
        world::Hit const hit = world.intersect_solid(ray);
        if (!hit) break;
        Surfaces const s(world, ray, hit, world::Query::solid, 0);
        for (Crossings::Crossing const& c : s.crossings()) {
            auto const known = std::find_if(met.begin(), met.end(), [&](auto const& m) {
                return m.inside.object == c.inside.object;
            });
            if (known != met.end())
                known->turns -= c.turns;
            else
                met.push_back({c.inside, -c.turns});
        }
        shading::SurfacePoint point = world.surface(ray, s.all[0].hit);
        point.p_error = s.error;
        ray.origin = shading::offset_origin(point, ray.direction);
    }
    // The outermost is left last, so it was entered first.
    media::MediumStack stack = world.outside();
    for (auto it = met.rbegin(); it != met.rend(); ++it)
        if (it->turns > 0) stack.enter(it->inside, it->turns);
    return stack;
}

} // namespace weft::integrator
