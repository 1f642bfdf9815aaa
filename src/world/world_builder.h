// Makes a World out of a Scene: opens groups, stores geometry, and builds the kernel's scenes.
#pragma once

#include <map>
#include <unordered_map>

#include "world/world.h"

namespace weft::world {

class WorldBuilder {
  public:
    WorldBuilder(World& world, scene::Scene const& scene, CommitOptions const& options)
        : world_(world), scene_(scene), options_(options),
          compiler_(scene, {.origin = Vec3(world.origin())}) {}
    void build();

  private:
    /// What an instance hands down to the members of a group.
    struct Inherited {
        Affined transform;
        scene::InstanceTraits traits;
        int32_t root_instance = -1; ///< the outermost one; -1: none yet
    };
    /// A geometry, and how the kernel is to have it.
    struct Placed {
        Geometry geometry;
        bool instanced = false, in_world_space = false;
    };

    void collect_instances();
    void count_uses(std::vector<int32_t> const& roots);
    void add_instance(int32_t index, Inherited const& outer);
    void add_area_object(uint32_t object, scene::LightId light);
    void add_object(scene::Shape const& shape, int32_t instance, Inherited const& given);

    /// Shapes that are a kind of geometry.
    template <class S>
    requires requires(S const& shape) { geometry_of(shape); }
    Placed place(S const& shape, Affined const& to_world) {
        auto const geometry = geometry_of(shape);
        return {geometry, !keeps_kind(geometry, to_world)};
    }
    Placed place(scene::Rectangle const&, Affined const& to_world);
    Placed place(scene::MeshShape const& shape, Affined const& to_world);
    Placed place(scene::Group const&, Affined const& to_world);
    MeshData const& shared_mesh(int32_t mesh, bool smooth);
    MeshData const& add_mesh(std::shared_ptr<scene::Mesh const> mesh, bool smooth,
                             Affined const& transform);

    /// Returns the index of the model of that geometry and those traits, a new one if need be.
    uint32_t model_of(Placed const& placed, scene::InstanceTraits const& traits, int32_t instance);
    Model make_model(Placed const& placed, scene::InstanceTraits const& traits, int32_t instance);
    int32_t add_medium(media::Medium const& medium);
    int32_t medium_of(scene::InstanceTraits const& given);
    void compile_networks();
    void attach_attributes();

    /// Ranks what has an inside: by priority; then shapes that are not closed below those that
    /// are; then the smaller volume above the larger, so that what is put inside of another thing
    /// is there; then the earlier object above the later.
    void rank_boundaries();
    /// Says which rays meet which objects, in build_masks.cpp.
    void mask_models();
    void build_kernel_scene();
    RTCSceneFlags scene_flags() const;
    /// Returns the kernel's scene that all instances of a geometry share.
    RTCScene instanced_scene(Geometry const& geometry);
    bool needs_filter(uint32_t object) const;
    /// Hands a geometry over to a scene of the kernel. `mask`: bits of the rays that meet it.
    void attach(RTCScene to, RTCGeometry geometry, uint32_t id, bool filtered, RayMask mask);
    void count();

    /// A scene of the kernel that instances share, and its filters. An instance that needs none
    /// answers them that it is opaque.
    struct SharedScene {
        RTCScene scene = nullptr;
        bool filtered = false; ///< some instance needs a filter
    };
    /// Which geometry it is: the kind, and what a mesh is made of.
    using GeometryKey = std::pair<size_t, void const*>;
    static GeometryKey key_of(Geometry const& geometry);

    World& world_;
    scene::Scene const& scene_;
    CommitOptions const& options_;
    shading::GraphCompiler compiler_;
    size_t object_count_ = 0;          ///< that there will be
    std::map<int32_t, int> mesh_uses_; ///< objects per mesh
    std::vector<std::shared_ptr<MeshData>> meshes_;
    std::map<std::pair<int32_t, bool>, MeshData const*> shared_meshes_; ///< by mesh, smooth
    std::unordered_multimap<size_t, uint32_t> shared_models_; ///< by a hash of their traits
    std::map<GeometryKey, SharedScene> shared_scenes_;
    std::vector<int32_t> first_instance_; ///< of the scene, per model: for messages
    std::shared_ptr<scene::Mesh const> rectangle_;
};

} // namespace weft::world
