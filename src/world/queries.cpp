// Asks the ray kernel: closest hits and shadow rays, and the filters that it calls at surfaces of
// partial opacity.
#include <algorithm>
#include <tuple>

#include "base/feature.h"
#include "base/hash.h"
#include "base/match.h"
#include "world/edge_hits.h"
#include "world/world.h"

namespace weft::world {

struct World::FilterContext {
    QueryContext query; // first, so that a pointer to it is a pointer to this
    World const* world;
    Query asked;
    uint32_t seed = 0;
    shading::Look look;  ///< of a shadow ray: at what lets light straight through
    Color visibility{1}; ///< of a shadow ray: what gets through so far
    EdgeHits met;
    NearHits* near = nullptr;          ///< collects hits
    std::array<EdgeHits, 2> collected; ///< there: fronts, backs

    FilterContext(World const& w, Query q) : world(&w), asked(q) { init_context(&query); }

    static FilterContext& of(RTCFilterFunctionNArguments const* args) {
        return *reinterpret_cast<FilterContext*>(args->context);
    }
    /// Returns the hit of the same point in a neighbouring triangle, or null.
    EdgeHits::Entry const* repeated(EdgeHits const& known, Hit const& hit, Corners corners) const {
        return known.find(hit, corners, [&](uint32_t object, uint32_t a, Corners c, uint32_t b) {
            auto const* mesh = std::get_if<TriangleMesh>(&world->model(object).geometry);
            return mesh && has_corners(*mesh, a, c, b);
        });
    }
    Corners corners(Hit const& hit) const {
        return match(world->model(hit.object).geometry,
                     [&](auto const& g) { return corners_at(g, hit); });
    }
};

namespace {

Vec3 ray_direction(RTCFilterFunctionNArguments const* args) {
    return {RTCRayN_dir_x(args->ray, 1, 0), RTCRayN_dir_y(args->ray, 1, 0),
            RTCRayN_dir_z(args->ray, 1, 0)};
}

Vec3 hit_normal(RTCFilterFunctionNArguments const* args) {
    return {RTCHitN_Ng_x(args->hit, 1, 0), RTCHitN_Ng_y(args->hit, 1, 0),
            RTCHitN_Ng_z(args->hit, 1, 0)};
}

RTCRay to_kernel(Ray const& ray) {
    return {ray.origin.x,
            ray.origin.y,
            ray.origin.z,
            ray.t_min,
            ray.direction.x,
            ray.direction.y,
            ray.direction.z,
            ray.time,
            ray.t_max,
            ray.mask,
            0,
            0};
}

} // namespace

void World::complete(Hit& hit, Vec3 const& origin, Vec3 const& direction, bool local) const {
    match(model(hit.object).geometry, [&]<class G>(G const& geometry) {
        if constexpr (!G::kernel_tells_place) {
            Vec3 const p = origin + direction * hit.t;
            nearest(geometry, local ? p : space_of(hit.object).to_object.point(p), hit);
        }
    });
}

Hit World::filtered_hit(RTCFilterFunctionNArguments const* args) const {
    uint32_t const instance = RTCHitN_instID(args->hit, 1, 0, 0);
    Hit hit{RTCRayN_tfar(args->ray, 1, 0),
            instance != RTC_INVALID_GEOMETRY_ID ? instance : RTCHitN_geomID(args->hit, 1, 0),
            RTCHitN_primID(args->hit, 1, 0),
            RTCHitN_u(args->hit, 1, 0),
            RTCHitN_v(args->hit, 1, 0),
            RTCRayN_time(args->ray, 1, 0)};
    Vec3 const origin(RTCRayN_org_x(args->ray, 1, 0), RTCRayN_org_y(args->ray, 1, 0),
                      RTCRayN_org_z(args->ray, 1, 0));
    complete(hit, origin, ray_direction(args), model(hit.object).instanced);
    return hit;
}

/// A surface is there with the probability of its opacity. A hash of the surface decides, so the
/// answer is the same however often and in whatever order the kernel asks.
void World::filter_closest(RTCFilterFunctionNArguments const* args) {
    if (args->valid[0] == 0) return;
    FilterContext& context = FilterContext::of(args);
    World const& world = *context.world;
    Hit const hit = world.filtered_hit(args);
    if (context.asked == Query::passable && !world.is_passable(hit.object)) args->valid[0] = 0;
    if (args->valid[0] == 0 || !world.model(hit.object).has_alpha) return;
    Corners const corners = context.corners(hit);
    if (EdgeHits::Entry const* const known = context.repeated(context.met, hit, corners)) {
        if (known->passed) args->valid[0] = 0;
        return;
    }
    // A sphere is one primitive that the ray may meet twice.
    Vec3 const ng = hit_normal(args), direction = ray_direction(args);
    bool const back = dot(ng, direction) > 0;
    float const u = context.asked == Query::solid
                        ? 0
                        : to_unit_float(hash_combine(hash_combine(context.seed, hit.object),
                                                     2 * hit.primitive + back));
    bool const passed = u >= world.opacity(hit, ng, direction);
    if (passed) args->valid[0] = 0;
    context.met.add(hit, corners, passed);
}

/// All surfaces along a shadow ray are passed, until nothing gets through.
void World::filter_shadow(RTCFilterFunctionNArguments const* args) {
    if (args->valid[0] == 0) return;
    FilterContext& context = FilterContext::of(args);
    World const& world = *context.world;
    Hit const hit = world.filtered_hit(args);
    Corners const corners = context.corners(hit);
    if (!world.is_passable(hit.object) && !context.repeated(context.met, hit, corners)) {
        context.visibility *=
            world.transmittance(hit, hit_normal(args), ray_direction(args), context.look);
        context.met.add(hit, corners, !is_black(context.visibility));
    }
    if (!is_black(context.visibility)) args->valid[0] = 0;
}

namespace {

/// By object as well: the order in which the kernel finds what is equally far says nothing.
bool is_nearer(Hit const& a, Hit const& b) {
    return std::tuple(a.t, a.object, a.primitive) < std::tuple(b.t, b.object, b.primitive);
}

} // namespace

void NearHits::add(Hit const& hit) {
    if (size_ < kMost) {
        all_[size_++] = hit;
        return;
    }
    Hit& farthest = *std::max_element(all_.begin(), all_.end(), is_nearer);
    if (is_nearer(hit, farthest)) farthest = hit;
}

Hit const* NearHits::closest() const {
    return size_ == 0 ? nullptr : std::min_element(begin(), end(), is_nearer);
}

/// Keeps the hit and goes on.
void World::collect(RTCFilterFunctionNArguments const* args) {
    if (args->valid[0] == 0) return;
    args->valid[0] = 0;
    FilterContext& context = FilterContext::of(args);
    World const& world = *context.world;
    Hit const hit = world.filtered_hit(args);
    if (context.asked == Query::passable && !world.is_passable(hit.object)) return;
    Corners const corners = context.corners(hit);
    EdgeHits& known = context.collected[dot(hit_normal(args), ray_direction(args)) > 0];
    if (context.repeated(known, hit, corners)) return;
    known.add(hit, corners, false);
    context.near->add(hit);
}

void World::hits_near(Ray const& ray, shading::SurfacePoint const& point, Query query,
                      uint32_t alpha_seed, NearHits& near) const {
    FeatureScope const scope(query == Query::passable ? Feature::ShadowRays : Feature::ClosestHits);
    FilterContext context(*this, query);
    context.seed = alpha_seed;
    context.near = &near;
    // The kernel's distances are off by the rounding of the largest coordinates that take part, and
    // the more so the flatter a ray meets the surface.
    Vec3 const& n = point.ng;
    float const error =
        dot(abs(n), point.p_error) +
        kRounding * (largest_coordinate_ + max_component(abs(ray.origin)) + point.t);
    float const reach = 2 * error / std::max(std::abs(dot(n, ray.direction)), 1e-6f);
    RTCRayHit answer;
    answer.ray = to_kernel(ray);
    answer.ray.tnear = std::max(ray.t_min, point.t - reach);
    answer.ray.tfar = std::min(ray.t_max, point.t + reach);
    answer.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    answer.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree_intersect(embree_scene_, &context.query, &answer, collect);
}

Hit World::intersect(Ray const& ray, uint32_t alpha_seed) const {
    return closest(ray, Query::closest, alpha_seed);
}

Hit World::intersect_solid(Ray const& ray) const { return closest(ray, Query::solid, 0); }

Hit World::intersect_passable(Ray const& ray, uint32_t alpha_seed) const {
    return closest(ray, Query::passable, alpha_seed);
}

Hit World::closest(Ray const& ray, Query query, uint32_t alpha_seed) const {
    // Shadow rays alone ask for passable boundaries.
    FeatureScope const scope(query == Query::passable ? Feature::ShadowRays : Feature::ClosestHits);
    if (recorder_) [[unlikely]]
        recorder_->record({.ray = ray, .query = query, .alpha_seed = alpha_seed});
    FilterContext context(*this, query);
    context.seed = alpha_seed;
    RTCRayHit answer;
    answer.ray = to_kernel(ray);
    answer.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    answer.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree_intersect(embree_scene_, &context.query, &answer);
    if (answer.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    bool const instanced = answer.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    Hit hit{answer.ray.tfar,   instanced ? answer.hit.instID[0] : answer.hit.geomID,
            answer.hit.primID, answer.hit.u,
            answer.hit.v,      ray.time};
    complete(hit, ray.origin, ray.direction, false);
    return hit;
}

Color World::visibility(Ray const& ray, shading::Look const& look) const {
    FeatureScope const scope(Feature::ShadowRays);
    if (recorder_) [[unlikely]]
        recorder_->record({.ray = ray, .query = Query::shadow, .look = look});
    FilterContext context(*this, Query::shadow);
    context.look = look;
    RTCRay query = to_kernel(ray);
    embree_occluded(embree_scene_, &context.query, &query);
    return query.tfar < 0 ? Color(0) : context.visibility;
}

uint32_t World::replay(RecordedRay const& recorded) const {
    if (recorded.query == Query::shadow) return is_black(visibility(recorded.ray, recorded.look));
    Hit const hit = closest(recorded.ray, recorded.query, recorded.alpha_seed);
    return hit.object + hit.primitive;
}

} // namespace weft::world
