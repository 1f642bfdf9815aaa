// Makes a World out of a Scene: opens groups, stores geometry, and builds the kernel's scenes.
#pragma once

#include <map>

#include "world/world.h"

namespace weft::world {

class WorldBuilder {
  public:
    WorldBuilder(World& world, scene::Scene const& scene, CommitOptions const& options)
        : world_(world), scene_(scene), options_(options), compiler_(scene) {}
    void build();

  private:
    /// What an instance hands down to the members of a group.
    struct Inherited {
        Affined transform;
        scene::MaterialId material;
        scene::EmissionId emission;
        scene::TextureId normal_map;
        scene::VolumeId volume;
        scene::MediumId medium;
        scene::Input<float> alpha{1};
        int priority = 0;
        scene::RayVisibility visibility;
        uint64_t sets = 0;
        float trace_distance = 0;
        bool holdout = false, shadow_catcher = false;
        int32_t root_instance = -1, group_instance = -1; ///< as in Object
    };

    void collect_instances();
    void add_instance(int32_t index, Inherited const& outer);
    void add_area_object(uint32_t object, scene::LightId light);
    void add_object(scene::Shape const& shape, int32_t instance, Inherited const& given);
    int32_t add_medium(media::Medium const& medium);
    int32_t medium_of(Inherited const& given);

    int32_t shared_triangles(int32_t mesh, bool smooth);
    int32_t baked_triangles(std::shared_ptr<scene::Mesh const> mesh, bool smooth,
                            Affined const& transform);

    /// Ranks what has an inside: by priority; then shapes that are not closed below those that
    /// are; then the smaller volume above the larger, so that what is put inside of another thing
    /// is there; then the earlier object above the later.
    void rank_boundaries();
    void build_kernel_scene();
    RTCGeometry make_mesh(TriangleData const& triangles) const;
    RTCGeometry make_sphere(Vec3 const& centre, float radius) const;
    RTCGeometry make_disk(Affine const& to_world) const;
    RTCScene instanced_scene(Object const& object);
    /// `mask`: bits of the rays that meet it.
    void attach(RTCScene to, RTCGeometry geometry, uint32_t id, bool filtered, RayMask mask);

    void compile_networks();
    void attach_attributes();
    /// Says which rays meet which objects, in build_masks.cpp.
    void mask_objects();
    void count();

    World& world_;
    scene::Scene const& scene_;
    CommitOptions const& options_;
    shading::GraphCompiler compiler_;
    std::map<int32_t, int> mesh_uses_;                   ///< objects per mesh
    std::map<std::pair<int32_t, bool>, int32_t> shared_; ///< mesh, smooth -> triangles
    std::map<int32_t, RTCScene> mesh_scenes_;            ///< triangles -> kernel scene
    RTCScene sphere_scene_ = nullptr, disk_scene_ = nullptr;
    std::shared_ptr<scene::Mesh const> rectangle_;
};

} // namespace weft::world
