// The committed geometry of a scene and what its surfaces look like, immutable and shared by all
// threads. Lights are built over it (lights/stage.h).
//
// An *object* is one shape at one place; groups are opened when the world is made. All objects of
// one geometry and the same traits share a *model*, so an object itself takes 16 bytes. A mesh that
// is used only once is stored in world space; meshes used several times are stored once and
// instanced. Spheres and disks are Embree's where their transform keeps them round, and instances
// of the unit sphere and disk elsewhere.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "media/medium.h"
#include "media/medium_stack.h"
#include "scene/scene.h"
#include "shading/materials.h"
#include "shading/spread.h"
#include "shading/textures.h"
#include "world/camera_rays.h"
#include "world/embree.h"
#include "world/geometry.h"
#include "world/ray.h"
#include "world/ray_recorder.h"
#include "world/set_names.h"

namespace weft::world {

/// A geometry and all that its surface looks like. What every ray asks for comes first, within a
/// cache line.
struct alignas(64) Model {
    Geometry geometry = Sphere{};
    bool instanced = false;      ///< the kernel has it in its own space
    bool in_world_space = false; ///< its own space is the world's: a mesh that stands there alone
    bool has_alpha = false;
    /// The material itself lets light straight through in parts. Not where light also goes inside,
    /// since the medium stack then has a say.
    bool is_see_through = false;
    bool has_interior = false; ///< crossing its surface changes the medium stack
    bool is_null = false;      ///< no surface: rays pass straight on
    /// Its inside may be entered several times before it is left: it is closed, of several parts.
    bool has_parts = false;
    bool needs_tangents = false;     ///< something looks at dpdu and dpdv of its points
    bool needs_object_space = false; ///< something looks at more of its points than uv
    bool softens_bent_light = false; ///< see scene::SoftensBentLight
    int32_t medium = -1;             ///< what fills it; -1: nothing
    uint64_t sets = 0;               ///< that it belongs to, as bits

    scene::InstanceTraits traits; ///< those of groups that it is a member of included
    shading::Emission emission;
    shading::Spread spread; ///< of the emission
    shading::Opacity opacity;
    scene::Input<float> ior{1}; ///< of its inside
    RayMask ray_mask = ~0u;     ///< bits of the rays that meet it
};

/// A model at a place.
struct Object {
    uint32_t model;          ///< its index
    int32_t source_instance; ///< of the scene
    /// Among all with an interior: the higher is there where they overlap.
    int32_t rank = 0;
    /// Index of what a group made of it; none: the scene lists the instance itself.
    uint32_t member : 31 = kNoMember;
    /// Whether another object's inside may lie over its boundary, which is then not seen.
    uint32_t may_be_hidden : 1 = 0;

    static constexpr uint32_t kNoMember = 0x7fffffff;
};
static_assert(sizeof(Object) == 16);

/// Where an object stands that is the member of a group.
struct GroupMember {
    Affined to_world;
    int32_t root_instance; ///< of the scene: the outermost one, of which it is a member
};

/// Returns whether rays of a kind meet what has the visibility `v`.
bool is_visible(scene::RayVisibility const& v, RayKind kind);

struct CommitOptions {
    std::string isa;  ///< Embree's kernels: "sse2", "avx2", "avx512"; "" is the best there is
    Vec2i size{0, 0}; ///< of the picture, instead of the scene's; 0: the scene's
    /// Receives every ray that the world traces, for `World::replay`; null: none. Outlives the
    /// world.
    RayRecorder* recorder = nullptr;
};

/// Counts for `weft info`.
struct WorldStatistics {
    size_t objects = 0, triangles = 0, unique_triangles = 0, memory_bytes = 0;
};

/// An object that emits because an area light of the scene holds it.
struct AreaObject {
    uint32_t object;
    scene::LightId light;
};

class World {
  public:
    /// Throws InputError where the scene cannot be rendered (no camera).
    static std::unique_ptr<World> commit(std::shared_ptr<scene::Scene const> scene,
                                         CommitOptions const& options = {});
    ~World();
    World(World const&) = delete;
    World& operator=(World const&) = delete;

    /// Returns the closest hit in (0, t_max). A surface of partial opacity is met with that
    /// probability, which `alpha_seed` alone decides.
    Hit intersect(Ray const& ray, uint32_t alpha_seed = 0) const;
    /// Returns the closest hit as if every surface were opaque.
    Hit intersect_solid(Ray const& ray) const;
    /// Returns the closest boundary that `visibility` looks through, by its opacity as for
    /// `intersect`. For rays whose `visibility` is not 0.
    Hit intersect_passable(Ray const& ray, uint32_t alpha_seed) const;
    /// Finds the hits that the kernel, which rounds, may not tell apart from `point`, the closest
    /// one of `query`, by their distance; `point` itself may be among them. A point on an edge
    /// counts once for all triangles there that face the same way.
    void hits_near(Ray const& ray, shading::SurfacePoint const& point, Query query,
                   uint32_t alpha_seed, NearHits& near) const;
    /// Returns the part of light that gets through the surfaces along the ray up to t_max: 0 behind
    /// an opaque surface, the product of (1 - opacity) + opacity * (what the material lets straight
    /// through) elsewhere. Passable boundaries count as not there.
    Color visibility(Ray const& ray, shading::Look const& look = {}) const;
    /// Traces a ray again that a render has recorded. Returns a number that depends on the answer,
    /// so that no compiler leaves the work out.
    uint32_t replay(RecordedRay const& ray) const;

    /// Returns the point of the surface that a ray has met.
    shading::SurfacePoint surface(Ray const& ray, Hit const& hit) const;
    /// Returns emission and lobes at `point` towards unit `wo`. `ior_outside`: index of refraction
    /// around the object there.
    shading::Shading shade(shading::SurfacePoint const& point, Vec3 const& wo,
                           float ior_outside = 1, shading::Look const& look = {}) const;
    /// Returns the point of an object that is nearest to `p`, a place on it: of the triangle
    /// `primitive`, where it is a mesh. Seen from unit `wo`.
    shading::SurfacePoint point_near(uint32_t object, uint32_t primitive, Vec3 const& p,
                                     Vec3 const& wo) const;
    /// Returns the emission alone, towards `wo`.
    Color emission(shading::SurfacePoint const& point, Vec3 const& wo) const;

    size_t object_count() const { return objects_.size(); }
    /// `index`: as hits and surface points have it, below `object_count()`.
    Object const& object(uint32_t index) const { return objects_[index]; }
    /// Returns what the object `index` looks like.
    Model const& model(uint32_t index) const { return models_[objects_[index].model]; }
    std::span<Model const> models() const { return models_; }
    /// Returns where the object `index` stands: from its own space to the world.
    Affined const& transform(uint32_t index) const;
    /// Returns the same both ways, in the numbers that rays are traced with.
    ObjectSpace space_of(uint32_t index) const { return ObjectSpace(transform(index)); }
    /// Returns the instance of the scene that the object `index` is, or is a member of.
    int32_t root_instance(uint32_t index) const;
    /// Returns whether only the medium stack can say if light passes the object `index`.
    bool is_passable(uint32_t index) const {
        return model(index).is_null || objects_[index].may_be_hidden;
    }
    /// Returns whether more may happen at a surface of the object than there: other boundaries lie
    /// in it, and a ray passes all of them.
    bool may_coincide(uint32_t index) const {
        Model const& m = model(index);
        return m.has_interior || (m.is_see_through && has_interiors_);
    }
    /// Returns the objects that area lights hold, those of one light side by side.
    std::span<AreaObject const> area_objects() const { return area_objects_; }
    /// Makes an object emit `factor` times as much, for the light that holds it and has a power.
    void scale_emission(uint32_t object, float factor) {
        models_[objects_[object].model].emission.tint *= factor;
    }
    /// Returns what is inside of the object whose surface `point` is on.
    media::Interior interior(shading::SurfacePoint const& point) const;
    media::Medium const& medium(int32_t index) const { return media_[size_t(index)]; }
    /// Returns what surrounds the camera.
    /// Returns where the origin of all positions here lies in the scene as it was given: a scene
    /// whose camera is far from its origin is moved (scene/camera_relative.h).
    Vec3d const& origin() const { return origin_; }
    media::MediumStack outside() const { return outside_; }
    /// Returns whether straight lines may cross media or passable boundaries.
    bool has_media() const { return has_media_; }
    /// Returns whether any object has an inside that rays get into.
    bool has_interiors() const { return has_interiors_; }
    /// Returns whether objects heed controls (scene::RayVisibility, holdouts, shadow catchers,
    /// ...).
    bool has_controls() const { return has_controls_; }
    /// Returns whether these depend on the kind of scattering.
    bool has_controls_by_kind() const { return has_controls_by_kind_; }
    /// Returns the named sets of instances that lights link to.
    SetNames const& sets() const { return sets_; }
    /// Returns what a ray's mask has to be for it to meet the objects that `blockers`, the value of
    /// some light's `shadowedBy`, names.
    RayMask shadow_mask(Links const& blockers) const;
    /// Returns whether any surface is partly transparent.
    bool has_alpha() const { return has_alpha_; }

    CameraRays const& camera() const { return camera_; }
    /// Returns the names of materials' layers, in the order of `lobes::Lobe::layer`.
    std::vector<std::string> const& layer_labels() const { return materials_.labels(); }
    shading::Textures const& textures() const { return textures_; }
    scene::Scene const& scene() const { return *scene_; }
    WorldStatistics const& statistics() const { return statistics_; }
    RTCDevice device() const { return device_; }
    /// Returns half the diagonal of the box around all objects; 1 where nothing is there.
    float radius() const;

  private:
    friend class WorldBuilder;
    World() = default;

    /// What the filters of one query need and what they leave behind.
    struct FilterContext;
    static void filter_closest(RTCFilterFunctionNArguments const* args);
    static void filter_shadow(RTCFilterFunctionNArguments const* args);
    static void collect(RTCFilterFunctionNArguments const* args);
    Hit filtered_hit(RTCFilterFunctionNArguments const* args) const;
    /// Answers any query but those of shadow rays.
    Hit closest(Ray const& ray, Query query, uint32_t alpha_seed) const;
    /// Fills in of a hit what the kernel does not tell: where on a disk it is. The ray is given in
    /// the object's own space, where `local`, and else in the world.
    void complete(Hit& hit, Vec3 const& origin, Vec3 const& direction, bool local) const;

    /// Returns a hit with the space of its object.
    Contact contact(Hit const& hit) const;
    // What filters ask. `ng`, the geometric normal, and `direction`, along which the hit is seen,
    // are as the kernel has them: in the object's own space, where it is instanced.

    /// Returns the place in the object's own space as contacts have it, in any length: only round
    /// kinds need it, and their normal says where a hit is.
    Vec3 local_place(Hit const& hit, Vec3 const& ng) const;
    float opacity(Hit const& hit, Vec3 const& ng, Vec3 const& direction) const;
    /// Returns the part of light that goes straight through.
    Color transmittance(Hit const& hit, Vec3 const& ng, Vec3 const& direction,
                        shading::Look const& look) const;
    shading::SurfacePoint filtered_point(Hit const& hit, Vec3 const& ng,
                                         Vec3 const& direction) const;

    /// Returns the point of the surface at a contact, seen from unit `wo`.
    shading::SurfacePoint point_at(Contact const& contact, Vec3 const& wo,
                                   RayCone const& cone = {}) const;
    shading::UvFootprint uv_footprint(Contact const& contact, RayCone const& cone,
                                      shading::SurfacePoint const& point) const;
    shading::View view_of(shading::SurfacePoint const& point, Vec3 const& wo, float ior_outside,
                          shading::Look const& look) const;
    void apply_normal_map(scene::TextureId map, shading::SurfacePoint& point) const;

    std::shared_ptr<scene::Scene const> scene_;
    std::vector<Object> objects_;
    std::vector<Model> models_;
    std::vector<GroupMember> members_;
    std::vector<std::shared_ptr<MeshData const>> meshes_;
    std::vector<media::Medium> media_;
    shading::Textures textures_;
    shading::Materials materials_;
    std::vector<AreaObject> area_objects_;
    SetNames sets_;
    std::vector<Links> shadow_links_; ///< one per bit of the ray masks
    CameraRays camera_;
    media::MediumStack outside_;
    Vec3d origin_{0, 0, 0};
    WorldStatistics statistics_;
    bool has_media_ = false;
    bool has_interiors_ = false;
    float largest_coordinate_ = 0; ///< of the box around all objects
    bool has_alpha_ = false;
    bool has_controls_ = false, has_controls_by_kind_ = false;
    bool use_footprints_ = false; ///< some texture depends on them
    RTCDevice device_ = nullptr;
    RTCScene embree_scene_ = nullptr;
    std::vector<RTCScene> instanced_scenes_;
    RayRecorder* recorder_ = nullptr;
};

inline Affined const& World::transform(uint32_t index) const {
    Object const& o = objects_[index];
    return o.member == Object::kNoMember ? scene_->instances[size_t(o.source_instance)].transform
                                         : members_[o.member].to_world;
}

inline int32_t World::root_instance(uint32_t index) const {
    Object const& o = objects_[index];
    return o.member == Object::kNoMember ? o.source_instance : members_[o.member].root_instance;
}

} // namespace weft::world
