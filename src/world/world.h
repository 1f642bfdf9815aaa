// The committed geometry of a scene and what its surfaces look like, immutable and shared by all
// threads. Lights are built over it (lights/stage.h).
//
// Geometry is a list of *objects*: one shape at one place. Groups are opened when the world is
// made. An object whose mesh is used only once is stored in world space; meshes used several
// times are stored once and instanced. Spheres and disks are Embree's where their transform keeps
// them round, and instances of the unit sphere and disk elsewhere.
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
#include "world/ray.h"
#include "world/ray_recorder.h"
#include "world/set_names.h"

namespace weft::world {

/// Half a cache line: a hit reads three of these from anywhere in memory.
struct alignas(32) Vertex {
    Vec3 p{0, 0, 0};
    float u = 0;
    Vec3 n{0, 0, 0}; ///< of any length, to be interpolated
    float v = 0;
};

/// A triangle mesh as the render reads it, in the space of its object.
struct TriangleData {
    std::vector<Vertex> vertices;
    std::shared_ptr<scene::Mesh const> source; ///< indices
    shading::VertexAttributes attributes;      ///< what nodes ask for
    bool smooth = false;                       ///< has normals
    bool has_uvs = false;
    bool mirrored = false; ///< counter-clockwise is the back
};

enum class ObjectKind : uint8_t { Mesh, Sphere, Disk };

struct Object {
    ObjectKind kind = ObjectKind::Mesh;
    bool instanced = false; ///< hits are in the object's own space
    bool has_alpha = false;
    /// The material itself lets light straight through in parts. Not where light also goes inside,
    /// since the medium stack then has a say.
    bool is_see_through = false;
    bool has_tangents = false; ///< something looks at the direction of growing u
    int32_t triangles = -1;    ///< index of the TriangleData
    scene::MaterialId material;
    shading::Emission emission;
    shading::Spread spread; ///< of the emission
    scene::TextureId normal_map;
    shading::Opacity opacity;
    scene::Input<float> ior{1}; ///< of its inside
    int32_t medium = -1;        ///< what fills it
    int32_t priority = 0;       ///< as the user gave it
    int32_t rank = 0; ///< among all with an interior: the higher is there where they overlap
    bool has_interior = false; ///< crossing its surface changes the medium stack
    bool is_null = false;      ///< no surface: rays pass straight on
    /// Another object's inside may lie over its boundary, which is then not seen.
    bool may_be_hidden = false;

    /// Whether only the medium stack can say if light passes.
    bool is_passable() const { return is_null || may_be_hidden; }
    /// Whether rays may go on behind it without a vertex.
    bool needs_filter() const { return has_alpha || is_see_through || is_passable(); }
    Affine to_world, to_object;
    bool is_rectangle = false;    ///< a mesh of two triangles that lights know as one
    int32_t source_instance = -1; ///< of the scene
    int32_t root_instance = -1;   ///< the outermost one, of which it is a member
    int32_t group_instance = -1;  ///< the one that names its light group; -1: none
    scene::RayVisibility visibility;
    RayMask ray_mask = ~0u;                       ///< bits of the rays that meet it
    uint64_t sets = 0;                            ///< that it belongs to, as bits
    float trace_distance = 0;                     ///< how far rays that leave it see; 0: no limit
    bool holdout = false, shadow_catcher = false; ///< what the camera sees in its place
};

/// Whether rays of a kind meet objects of visibility `v`.
bool is_visible(scene::RayVisibility const& v, RayKind kind);

struct CommitOptions {
    std::string isa;  ///< Embree's kernels: "sse2", "avx2", "avx512"; "" is the best there is
    Vec2i size{0, 0}; ///< of the picture, instead of the scene's; 0: the scene's
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

    /// The closest hit in (0, t_max). Surfaces of partial opacity are met with that probability,
    /// decided by `alpha_seed` alone.
    Hit intersect(Ray const& ray, uint32_t alpha_seed = 0) const;
    /// The closest hit, where every surface is there as a whole.
    Hit intersect_solid(Ray const& ray) const;
    /// The closest boundary that `visibility` looks through, by its opacity as for `intersect`.
    /// For rays that `visibility` is not 0 for.
    Hit intersect_passable(Ray const& ray, uint32_t alpha_seed) const;
    /// The part of light that gets through the surfaces along the ray up to t_max: 0 behind an
    /// opaque surface, the product of (1 - opacity) + opacity * (what the material lets straight
    /// through) elsewhere. Passable boundaries are not seen.
    Color visibility(Ray const& ray, shading::Look const& look = {}) const;

    shading::SurfacePoint surface(Ray const& ray, Hit const& hit) const;
    /// Returns emission and lobes at `point` towards unit `wo`, seen from within `stack`.
    shading::Shading shade(shading::SurfacePoint const& point, Vec3 const& wo,
                           media::MediumStack const& stack, shading::Look const& look = {}) const;
    /// The point of an object that is nearest to `p` on it: of the triangle `primitive`, where it
    /// is a mesh. Seen from unit `wo`.
    shading::SurfacePoint point_near(uint32_t object, uint32_t primitive, Vec3 const& p,
                                     Vec3 const& wo) const;
    /// Emission alone, towards `wo`.
    Color emission(shading::SurfacePoint const& point, Vec3 const& wo) const;

    Object const& object(uint32_t index) const { return objects_[index]; }
    std::span<Object const> objects() const { return objects_; }
    TriangleData const& triangles(Object const& mesh) const {
        return triangles_[size_t(mesh.triangles)];
    }
    /// Those of one light of the scene stand side by side.
    std::span<AreaObject const> area_objects() const { return area_objects_; }
    /// Makes an object emit `factor` times as much, for the light that holds it and has a power.
    void scale_emission(uint32_t object, float factor) { objects_[object].emission.tint *= factor; }
    /// What is inside of the object whose surface `point` is on.
    media::Interior interior(shading::SurfacePoint const& point) const;
    media::Medium const& medium(int32_t index) const { return media_[size_t(index)]; }
    /// What surrounds the camera.
    media::MediumStack outside() const { return outside_; }
    /// Whether straight lines may cross media or passable boundaries.
    bool has_media() const { return has_media_; }
    /// Whether objects heed controls (scene::RayVisibility, holdouts, shadow catchers, ...).
    bool has_controls() const { return has_controls_; }
    /// Whether these depend on the kind of scattering.
    bool has_controls_by_kind() const { return has_controls_by_kind_; }
    /// The named sets of instances that lights link to.
    SetNames const& sets() const { return sets_; }
    /// What a ray's mask has to be for it to meet the objects that `blockers`, the value of some
    /// light's `shadowedBy`, names.
    RayMask shadow_mask(Links const& blockers) const;
    /// Whether any surface is partly transparent.
    bool has_alpha() const { return has_alpha_; }

    CameraRays const& camera() const { return camera_; }
    /// The names of materials' layers, in the order of `lobes::Lobe::layer`.
    std::vector<std::string> const& layer_labels() const { return materials_.labels(); }
    shading::Textures const& textures() const { return textures_; }
    scene::Scene const& scene() const { return *scene_; }
    WorldStatistics const& statistics() const { return statistics_; }
    RTCScene embree_scene() const { return embree_scene_; }
    RTCDevice device() const { return device_; }
    /// Half the diagonal of the box around all objects; 1 where nothing is there.
    float radius() const;
    /// Records every ray into `recorder` (null: none), for measuring the kernel alone.
    void record_rays(RayRecorder* recorder) const { recorder_ = recorder; }

    /// Opacity at a hit, seen along `direction`, whose geometric normal, as the kernel has it, is
    /// `ng`.
    float opacity(Hit const& hit, Vec3 const& ng, Vec3 const& direction) const;
    /// The part of light that goes straight through at a hit, seen likewise.
    Color transmittance(Hit const& hit, Vec3 const& ng, Vec3 const& direction,
                        shading::Look const& look) const;
    /// Whether those corners (bits) of a mesh's triangle `a` are corners of triangle `b`, too.
    bool has_corners(uint32_t object, uint32_t a, uint8_t corners, uint32_t b) const;
    /// A point of a mesh or a disk at `hit`, or of a sphere in direction `local` from its centre,
    /// all in the object's space; seen from unit `wo`.
    shading::SurfacePoint point_on(Hit const& hit, Vec3 const& local, Vec3 const& wo,
                                   RayCone const& cone = {}) const;
    shading::UvFootprint uv_footprint(Object const& object, RayCone const& cone,
                                      shading::SurfacePoint const& point) const;

  private:
    friend class WorldBuilder;
    World() = default;

    enum class Target : uint8_t { Surfaces, Passable, Solid };
    Hit closest(Ray const& ray, Target target, uint32_t alpha_seed) const;

    shading::View view_of(shading::SurfacePoint const& point, Vec3 const& wo, float ior_outside,
                          shading::Look const& look) const;
    void mesh_point(Object const& object, Hit const& hit, shading::SurfacePoint& point) const;
    void sphere_point(Object const& object, Vec3 const& local, shading::SurfacePoint& point) const;
    void disk_point(Object const& object, Hit const& hit, shading::SurfacePoint& point) const;
    Vec2 mesh_uv(Object const& object, Hit const& hit) const;
    static Vec3 sphere_local(Object const& object, Vec3 const& ng);
    /// The point that an opacity filter asks about: `ng` and `direction` are as the kernel has
    /// them.
    shading::SurfacePoint filtered_point(Hit const& hit, Vec3 const& ng,
                                         Vec3 const& direction) const;
    void apply_normal_map(Object const& object, shading::SurfacePoint& point) const;

    std::shared_ptr<scene::Scene const> scene_;
    std::vector<Object> objects_;
    std::vector<TriangleData> triangles_;
    std::vector<media::Medium> media_;
    shading::Textures textures_;
    shading::Materials materials_;
    std::vector<AreaObject> area_objects_;
    SetNames sets_;
    std::vector<Links> shadow_links_; ///< one per bit of the ray masks
    CameraRays camera_;
    media::MediumStack outside_;
    WorldStatistics statistics_;
    bool has_media_ = false;
    bool has_alpha_ = false;
    bool has_controls_ = false, has_controls_by_kind_ = false;
    bool use_footprints_ = false; ///< some texture depends on them
    RTCDevice device_ = nullptr;
    RTCScene embree_scene_ = nullptr;
    std::vector<RTCScene> instanced_scenes_;
    mutable RayRecorder* recorder_ = nullptr;
};

} // namespace weft::world
