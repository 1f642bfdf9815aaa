// The part of WorldBuilder that makes the ray kernel's scenes. World's end, which releases them.
#include <stdexcept>

#include "base/match.h"
#include "world/world_builder.h"

namespace weft::world {

namespace {

void throw_on_error(RTCDevice device) {
    if (RTCError const error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
        throw std::runtime_error("Embree failed with error " + std::to_string(int(error)) +
                                 (error == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

} // namespace

/// Rays may go on behind an object without a vertex.
bool WorldBuilder::needs_filter(uint32_t object) const {
    Model const& m = world_.model(object);
    return m.has_alpha || m.is_see_through || world_.is_passable(object);
}

void WorldBuilder::attach(RTCScene to, RTCGeometry geometry, uint32_t id, bool filtered,
                          RayMask mask) {
    rtcSetGeometryMask(geometry, mask);
    if (filtered) {
        rtcSetGeometryIntersectFilterFunction(geometry, World::filter_closest);
        rtcSetGeometryOccludedFilterFunction(geometry, World::filter_shadow);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(to, geometry, id);
    rtcReleaseGeometry(geometry);
}

RTCSceneFlags WorldBuilder::scene_flags() const {
    return world_.has_interiors() ? RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | kQueryFilters)
                                  : RTC_SCENE_FLAG_ROBUST;
}

RTCScene WorldBuilder::instanced_scene(Geometry const& geometry) {
    auto& [scene, filtered] = shared_scenes_.at(key_of(geometry));
    if (scene) return scene;
    scene = rtcNewScene(world_.device_);
    world_.instanced_scenes_.push_back(scene);
    rtcSetSceneFlags(scene, scene_flags());
    RTCGeometry const made = match(
        geometry, [&](auto const& g) { return make_kernel_geometry(g, world_.device_, Affine()); });
    attach(scene, made, 0, filtered, ~0u);
    rtcCommitScene(scene);
    return scene;
}

void WorldBuilder::build_kernel_scene() {
    std::string const config = options_.isa.empty() ? "" : "isa=" + options_.isa;
    world_.device_ = rtcNewDevice(config.c_str());
    if (!world_.device_)
        throw InputError("the ray kernel cannot be started" +
                         (config.empty() ? "" : " with " + config));
    world_.embree_scene_ = rtcNewScene(world_.device_);
    rtcSetSceneFlags(world_.embree_scene_, scene_flags());
    for (uint32_t i = 0; i < world_.object_count(); ++i)
        if (Model const& m = world_.model(i); m.instanced)
            shared_scenes_[key_of(m.geometry)].filtered |= needs_filter(i);
    for (uint32_t i = 0; i < world_.object_count(); ++i) {
        Model const& m = world_.model(i);
        Affine const to_world(world_.transform(i));
        if (m.instanced) {
            RTCGeometry const instance = rtcNewGeometry(world_.device_, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(instance, instanced_scene(m.geometry));
            rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &to_world);
            attach(world_.embree_scene_, instance, i, false, m.ray_mask);
        } else {
            RTCGeometry const made = match(m.geometry, [&](auto const& g) {
                return make_kernel_geometry(g, world_.device_, to_world);
            });
            attach(world_.embree_scene_, made, i, needs_filter(i), m.ray_mask);
        }
    }
    rtcCommitScene(world_.embree_scene_);
    throw_on_error(world_.device_);
    RTCBounds box;
    rtcGetSceneBounds(world_.embree_scene_, &box);
    for (float x : {box.lower_x, box.lower_y, box.lower_z, box.upper_x, box.upper_y, box.upper_z})
        if (std::isfinite(x))
            world_.largest_coordinate_ = std::max(world_.largest_coordinate_, std::abs(x));
}

float World::radius() const {
    RTCBounds box;
    rtcGetSceneBounds(embree_scene_, &box);
    Vec3 const extent(box.upper_x - box.lower_x, box.upper_y - box.lower_y,
                      box.upper_z - box.lower_z);
    return is_finite(extent) && extent.x >= 0 ? 0.5f * length(extent) : 1;
}

World::~World() {
    if (embree_scene_) rtcReleaseScene(embree_scene_);
    for (RTCScene scene : instanced_scenes_) rtcReleaseScene(scene);
    if (device_) rtcReleaseDevice(device_);
}

} // namespace weft::world
