#include "lights/lamp_scene.h"

#include <stdexcept>

#include "lights/luminaire.h"

namespace weft::lights {

/// Per query: whom to call with what is met.
struct LampScene::Query {
    world::QueryContext context; // first, so that a pointer to it is a pointer to this
    world::Ray const* ray;
    Vec3 from;
    void* function;
    Call call;
};

LampScene::LampScene(RTCDevice device, std::vector<Ball> balls)
    : balls_(std::move(balls)), scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(balls_.size()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
        throw std::runtime_error("Embree failed to store the lamps (out of memory)");
}

LampScene::~LampScene() { rtcReleaseScene(scene_); }

void LampScene::bounds(RTCBoundsFunctionArguments const* args) {
    Ball const& ball = static_cast<LampScene const*>(args->geometryUserPtr)->balls_[args->primID];
    // So that rounding cuts nothing off a small ball far from the origin.
    float const reach =
        ball.radius + world::kRounding * (max_component(abs(ball.centre)) + ball.radius);
    *args->bounds_o = {ball.centre.x - reach, ball.centre.y - reach, ball.centre.z - reach, 0,
                       ball.centre.x + reach, ball.centre.y + reach, ball.centre.z + reach, 0};
}

/// Never stores a hit, so that the kernel goes on to the next ball.
void LampScene::intersect(RTCIntersectFunctionNArguments const* args) {
    if (args->valid[0] == 0) return;
    auto const& query = *reinterpret_cast<Query const*>(args->context);
    Ball const& ball = static_cast<LampScene const*>(args->geometryUserPtr)->balls_[args->primID];
    Meeting meeting{ball.light, 0, Vec3(0)};
    double const t = distance_to_ball(ball.centre, ball.radius, query.ray->origin,
                                      query.ray->direction, query.from, meeting.n);
    if (!(t > 0 && t < double(query.ray->t_max))) return;
    meeting.t = float(t);
    query.call(query.function, meeting);
}

void LampScene::visit(world::Ray const& ray, Vec3 const& from, void* function, Call call) const {
    Query query;
    world::init_context(&query.context);
    query.ray = &ray;
    query.from = from;
    query.function = function;
    query.call = call;
    RTCRayHit hit;
    hit.ray = {ray.origin.x,
               ray.origin.y,
               ray.origin.z,
               0,
               ray.direction.x,
               ray.direction.y,
               ray.direction.z,
               ray.time,
               ray.t_max,
               ~0u,
               0,
               0};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    world::embree_intersect(scene_, &query.context, &hit);
}

} // namespace weft::lights
