// The half of WorldBuilder that talks to Embree.
#include <stdexcept>

#include "base/feature.h"
#include "base/hash.h"
#include "world/edge_hits.h"
#include "world/world_builder.h"

namespace weft::world {

namespace {

/// Per query: what the opacity filters need and what they leave behind.
struct FilterContext {
    QueryContext query; // first, so that a pointer to it is a pointer to this
    World const* world;
    uint32_t seed = 0;
    bool passable_only = false, solid = false; ///< of closest hits
    shading::Look look;                        ///< of shadows: at what lets light straight through
    Color visibility{1};

    EdgeHits met;

    /// The hit of the same point in a neighbouring triangle, if there was one.
    EdgeHits::Entry const* repeated(Hit const& hit, Corners corners) const {
        return met.find(hit, corners, [&](uint32_t object, uint32_t a, Corners c, uint32_t b) {
            return world->has_corners(object, a, c, b);
        });
    }
};

uint32_t hit_object(RTCFilterFunctionNArguments const* args) {
    uint32_t const instance = RTCHitN_instID(args->hit, 1, 0, 0);
    return instance != RTC_INVALID_GEOMETRY_ID ? instance : RTCHitN_geomID(args->hit, 1, 0);
}

Vec3 ray_direction(RTCFilterFunctionNArguments const* args) {
    return {RTCRayN_dir_x(args->ray, 1, 0), RTCRayN_dir_y(args->ray, 1, 0),
            RTCRayN_dir_z(args->ray, 1, 0)};
}

/// The kernel knows no place on a disk. `p` is the hit in the space that the kernel has it in.
void place_on_disk(Object const& disk, Vec3 const& p, Hit& hit) {
    Vec3 const local = disk.instanced ? p : disk.to_object.point(p);
    hit.u = local.x;
    hit.v = local.y;
}

Hit to_hit(World const& world, RTCFilterFunctionNArguments const* args) {
    Hit hit{RTCRayN_tfar(args->ray, 1, 0), hit_object(args), RTCHitN_primID(args->hit, 1, 0),
            RTCHitN_u(args->hit, 1, 0), RTCHitN_v(args->hit, 1, 0)};
    if (Object const& o = world.object(hit.object); o.kind == ObjectKind::Disk) {
        Vec3 const origin(RTCRayN_org_x(args->ray, 1, 0), RTCRayN_org_y(args->ray, 1, 0),
                          RTCRayN_org_z(args->ray, 1, 0));
        place_on_disk(o, origin + ray_direction(args) * hit.t, hit);
    }
    return hit;
}

Vec3 hit_normal(RTCFilterFunctionNArguments const* args) {
    return {RTCHitN_Ng_x(args->hit, 1, 0), RTCHitN_Ng_y(args->hit, 1, 0),
            RTCHitN_Ng_z(args->hit, 1, 0)};
}

/// Closest hit: a surface is there with the probability of its opacity. The decision is a hash of
/// the surface, so it is the same however often and in which order the kernel asks.
void filter_closest(RTCFilterFunctionNArguments const* args) {
    auto& context = *reinterpret_cast<FilterContext*>(args->context);
    if (args->valid[0] == 0) return;
    Hit const hit = to_hit(*context.world, args);
    Object const& o = context.world->object(hit.object);
    if (context.passable_only && !o.is_passable()) args->valid[0] = 0;
    if (args->valid[0] == 0 || !o.has_alpha) return;
    Corners const corners = o.kind == ObjectKind::Mesh ? corners_at(hit) : kAllCorners;
    if (EdgeHits::Entry const* const known = context.repeated(hit, corners)) {
        if (known->passed) args->valid[0] = 0;
        return;
    }
    // A sphere is one primitive that the ray may meet twice.
    Vec3 const ng = hit_normal(args), direction = ray_direction(args);
    bool const back = dot(ng, direction) > 0;
    float const u = context.solid
                        ? 0
                        : to_unit_float(hash_combine(hash_combine(context.seed, hit.object),
                                                     2 * hit.primitive + back));
    bool const passed = u >= context.world->opacity(hit, ng, direction);
    if (passed) args->valid[0] = 0;
    context.met.add(hit, corners, passed);
}

/// Shadow: all surfaces along the ray are passed, until nothing gets through.
void filter_shadow(RTCFilterFunctionNArguments const* args) {
    auto& context = *reinterpret_cast<FilterContext*>(args->context);
    if (args->valid[0] == 0) return;
    Hit const hit = to_hit(*context.world, args);
    Object const& o = context.world->object(hit.object);
    Corners const corners = o.kind == ObjectKind::Mesh ? corners_at(hit) : kAllCorners;
    if (!o.is_passable() && !context.repeated(hit, corners)) {
        context.visibility *=
            context.world->transmittance(hit, hit_normal(args), ray_direction(args), context.look);
        context.met.add(hit, corners, !is_black(context.visibility));
    }
    if (!is_black(context.visibility)) args->valid[0] = 0;
}

void throw_on_error(RTCDevice device) {
    if (RTCError const error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
        throw std::runtime_error("Embree failed with error " + std::to_string(int(error)) +
                                 (error == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory)" : ""));
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

RTCGeometry WorldBuilder::make_mesh(TriangleData const& triangles) const {
    RTCGeometry const geometry = rtcNewGeometry(world_.device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto const& indices = triangles.source->triangles;
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               triangles.vertices.data(), offsetof(Vertex, p), sizeof(Vertex),
                               triangles.vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(),
                               0, sizeof(scene::Mesh::Triangle), indices.size());
    return geometry;
}

RTCGeometry WorldBuilder::make_sphere(Vec3 const& centre, float radius) const {
    RTCGeometry const geometry = rtcNewGeometry(world_.device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* data = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, 1));
    data[0] = centre.x;
    data[1] = centre.y;
    data[2] = centre.z;
    data[3] = radius;
    return geometry;
}

RTCGeometry WorldBuilder::make_disk(Affine const& to_world) const {
    RTCGeometry const geometry =
        rtcNewGeometry(world_.device_, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* data = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, 1));
    auto* normal = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 12, 1));
    Vec3 const n = normalize(Vec3(cross(Vec3d(to_world.x), Vec3d(to_world.y)))) *
                   (to_world.determinant() < 0 ? -1.f : 1.f);
    for (int i = 0; i < 3; ++i) {
        data[i] = to_world.origin[i];
        normal[i] = n[i];
    }
    data[3] = length(to_world.x);
    return geometry;
}

void WorldBuilder::attach(RTCScene to, RTCGeometry geometry, uint32_t id, bool filtered,
                          RayMask mask) {
    rtcSetGeometryMask(geometry, mask);
    if (filtered) {
        rtcSetGeometryIntersectFilterFunction(geometry, filter_closest);
        rtcSetGeometryOccludedFilterFunction(geometry, filter_shadow);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(to, geometry, id);
    rtcReleaseGeometry(geometry);
}

RTCScene WorldBuilder::instanced_scene(Object const& object) {
    RTCScene& scene = object.kind == ObjectKind::Sphere ? sphere_scene_
                      : object.kind == ObjectKind::Disk ? disk_scene_
                                                        : mesh_scenes_[object.triangles];
    if (scene) return scene;
    scene = rtcNewScene(world_.device_);
    world_.instanced_scenes_.push_back(scene);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry const geometry = object.kind == ObjectKind::Sphere ? make_sphere(Vec3(0), 1)
                                 : object.kind == ObjectKind::Disk
                                     ? make_disk(Affine())
                                     : make_mesh(world_.triangles_[size_t(object.triangles)]);
    // The instances share these filters: those without opacity answer 1.
    bool filtered = false;
    for (Object const& o : world_.objects_)
        filtered |= o.instanced && o.kind == object.kind && o.triangles == object.triangles &&
                    o.needs_filter();
    attach(scene, geometry, 0, filtered, ~0u);
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
    rtcSetSceneFlags(world_.embree_scene_, RTC_SCENE_FLAG_ROBUST);
    for (uint32_t id = 0; id < world_.objects_.size(); ++id) {
        Object const& o = world_.objects_[id];
        if (o.instanced) {
            RTCScene const inner = instanced_scene(o);
            RTCGeometry const instance = rtcNewGeometry(world_.device_, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(instance, inner);
            rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &o.to_world);
            attach(world_.embree_scene_, instance, id, false, o.ray_mask);
        } else if (o.kind == ObjectKind::Sphere) {
            attach(world_.embree_scene_, make_sphere(o.to_world.origin, length(o.to_world.x)), id,
                   o.needs_filter(), o.ray_mask);
        } else if (o.kind == ObjectKind::Disk) {
            attach(world_.embree_scene_, make_disk(o.to_world), id, o.needs_filter(), o.ray_mask);
        } else {
            attach(world_.embree_scene_, make_mesh(world_.triangles_[size_t(o.triangles)]), id,
                   o.needs_filter(), o.ray_mask);
        }
    }
    rtcCommitScene(world_.embree_scene_);
    throw_on_error(world_.device_);
}

Hit World::intersect(Ray const& ray, uint32_t alpha_seed) const {
    return closest(ray, Target::Surfaces, alpha_seed);
}

Hit World::intersect_solid(Ray const& ray) const { return closest(ray, Target::Solid, 0); }

Hit World::intersect_passable(Ray const& ray, uint32_t alpha_seed) const {
    return closest(ray, Target::Passable, alpha_seed);
}

Hit World::closest(Ray const& ray, Target target, uint32_t alpha_seed) const {
    // Passable boundaries are asked for by shadow rays alone.
    FeatureScope const scope(target == Target::Passable ? Feature::ShadowRays
                                                        : Feature::ClosestHits);
    if (recorder_) [[unlikely]]
        recorder_->record(ray, false);
    FilterContext context;
    init_context(&context.query);
    context.world = this;
    context.seed = alpha_seed;
    context.passable_only = target == Target::Passable;
    context.solid = target == Target::Solid;
    RTCRayHit query;
    query.ray = to_kernel(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree_intersect(embree_scene_, &context.query, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    bool const instanced = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    Hit hit{query.ray.tfar, instanced ? query.hit.instID[0] : query.hit.geomID, query.hit.primID,
            query.hit.u, query.hit.v};
    if (Object const& o = objects_[hit.object]; o.kind == ObjectKind::Disk) {
        Vec3 const p = ray.origin + ray.direction * hit.t;
        place_on_disk(o, instanced ? o.to_object.point(p) : p, hit);
    }
    return hit;
}

Color World::visibility(Ray const& ray, shading::Look const& look) const {
    FeatureScope const scope(Feature::ShadowRays);
    if (recorder_) [[unlikely]]
        recorder_->record(ray, true);
    FilterContext context;
    init_context(&context.query);
    context.world = this;
    context.look = look;
    RTCRay query = to_kernel(ray);
    embree_occluded(embree_scene_, &context.query, &query);
    return query.tfar < 0 ? Color(0) : context.visibility;
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
