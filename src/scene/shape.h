// Shapes, and the instances that put them into the world.
#pragma once

#include <bit>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/hash.h"
#include "base/shared_text.h"
#include "scene/dialects.h"
#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

struct Sphere {
    static constexpr schema::TypeInfo info{
        .category = "shape", .type = "sphere", .help = "The sphere of radius 1 around the origin."};

    template <class F>
    constexpr void describe(F&&) {}
};

struct Rectangle {
    static constexpr schema::TypeInfo info{
        .category = "shape",
        .type = "rectangle",
        .help = "[-1, 1] x [-1, 1] in the plane z = 0; its normal is +z, uv runs from 0 to 1."};

    template <class F>
    constexpr void describe(F&&) {}
};

struct Disk {
    static constexpr schema::TypeInfo info{
        .category = "shape",
        .type = "disk",
        .help = "The disk of radius 1 around the origin in the plane z = 0; its normal is +z. uv "
                "is that of a rectangle around it: 0.5 at the centre, 0 to 1 across."};

    template <class F>
    constexpr void describe(F&&) {}
};

struct MeshShape {
    static constexpr schema::TypeInfo info{.category = "shape",
                                           .type = "mesh",
                                           .help =
                                               "Triangles and polygons from a PLY or OBJ file."};
    FileName filename;
    bool smooth = true;

    template <class F>
    constexpr void describe(F&& f) {
        f("filename", filename,
          {.required = true,
           .help = "A PLY (ASCII or binary) or OBJ file, relative to the scene file."});
        f("smooth", smooth,
          {.help = "Interpolate the file's vertex normals; otherwise facets show."});
    }
};

struct Group {
    static constexpr schema::TypeInfo info{
        .category = "shape",
        .type = "group",
        .help = "Several instances as one shape. What the outer instance sets (bsdf, emission, "
                "alpha, normal) replaces what its members have.",
        .example = "<shape type=\"group\" filename=\"robot.glb\"/>"};
    FileName filename;
    std::vector<InstanceId> instances;

    template <class F>
    constexpr void describe(F&& f) {
        f("filename", filename,
          {.help = "A glTF file (.gltf or .glb) whose meshes are members, too, with its materials; "
                   "relative to the scene file."});
        f("instance", instances, {.help = "The members."});
    }
};

using Shape = std::variant<Sphere, Rectangle, Disk, MeshShape, Group>;

/// Which rays meet an instance, by how they came about.
struct RayVisibility {
    bool camera = true, diffuse = true, glossy = true, transmission = true, volume = true;
    bool shadow = true;

    template <class F>
    constexpr void describe(F&& f) {
        f("visibleToCamera", camera, {.help = "Whether the camera sees it."});
        f("visibleToDiffuse", diffuse,
          {.help = "Whether rays see it that a surface reflected diffusely."});
        f("visibleToGlossy", glossy,
          {.help = "Whether rays see it that a mirror or a glossy surface reflected."});
        f("visibleToTransmission", transmission,
          {.help = "Whether rays see it that a surface let through."});
        f("visibleToVolume", volume, {.help = "Whether rays see it that a medium scattered."});
        f("castShadows", shadow, {.help = "Whether it blocks the light of lights."});
    }
    friend constexpr bool operator==(RayVisibility const&, RayVisibility const&) = default;
};

/// Returns what is seen of a member of a group: what a group hides, its members do not show.
constexpr RayVisibility inherit(RayVisibility const& outer, RayVisibility const& own) {
    // A name for each: a new one does not compile before there is something to say of it here.
    [[maybe_unused]] auto const& [camera, diffuse, glossy, transmission, volume, shadow] = own;
    return {outer.camera && own.camera, outer.diffuse && own.diffuse,
            outer.glossy && own.glossy, outer.transmission && own.transmission,
            outer.volume && own.volume, outer.shadow && own.shadow};
}

/// All that an instance says of its shape but where it is, in few bytes, as there may be millions.
/// An instance of a group says it of the members: `inherit` tells how.
struct InstanceTraits {
    SharedText sets;
    SharedText group;
    MaterialId bsdf;
    EmissionId emission;
    TextureId normal;
    Input<float> alpha{1};
    VolumeId volume;
    MediumId medium;
    int priority = 0;
    RayVisibility visibility;
    bool holdout = false, shadow_catcher = false;
    float trace_distance = 0;

    template <class F>
    constexpr void describe(F&& f) {
        f("bsdf", bsdf, {.help = "How its surface scatters light; without one it is black."});
        f("emission", emission, {.help = "Light that it emits."});
        f("normal", normal,
          {.help = "Tangent-space normal map, [0, 1] standing for [-1, 1]; load the image with "
                   "linear=\"true\"."});
        f("alpha", alpha, {.min = 0, .max = 1, .help = "Opacity; 0 is not there at all."});
        f("volume", volume, {.help = "Density of the medium of a `volume` bsdf."});
        f("medium", medium, {.help = "What fills the inside of a closed shape."});
        f("priority", priority,
          {.min = -1000,
           .max = 1000,
           .help = "Where closed dielectrics or media overlap, the higher priority is what is "
                   "there (liquid in a glass: the glass higher). Of equal ones the smaller volume "
                   "is, and of equal volumes the one that comes first."});
        f.group(visibility);
        f("holdout", holdout,
          {.help = "Where the camera sees it, it cuts a hole into the picture, with an alpha of 0; "
                   "all other rays meet it as ever."});
        f("shadowCatcher", shadow_catcher,
          {.help = "The camera does not see it, but the AOV `shadow_catcher` has the shadows that "
                   "others cast on it; all other rays meet it as ever."});
        f("sets", sets,
          {.help = "Names of sets that it belongs to, for the links of lights: \"cast hero\"."});
        f("traceDistance", trace_distance,
          {.unit = "scene",
           .min = 0,
           .help =
               "What is further away is not there for rays that leave its surface, whether they "
               "look for surfaces or lights: they see the environment. 0 is no limit."});
        f("group", group,
          {.help = "Light group of what it emits, as of lights; that of a light made of it comes "
                   "first."});
    }
    friend bool operator==(InstanceTraits const&, InstanceTraits const&) = default;
};

/// Returns the traits of a member that says `own` in a group whose instance says `outer`. What the
/// outer instance sets replaces what the member has. But both may hide it, make it a holdout or a
/// shadow catcher, and put it into sets.
inline InstanceTraits inherit(InstanceTraits const& outer, InstanceTraits const& own) {
    // A name for each: a new one does not compile before there is something to say of it here.
    [[maybe_unused]] auto const& [own_sets, group, bsdf, emission, normal, alpha, volume, medium,
                                  priority, visibility, holdout, shadow_catcher, trace_distance] =
        own;
    InstanceTraits const unset;
    auto pick = [&](auto InstanceTraits::*member) {
        return outer.*member != unset.*member ? outer.*member : own.*member;
    };
    bool const both_name_sets = !outer.sets.empty() && !own.sets.empty();
    SharedText const sets = both_name_sets ? SharedText(outer.sets.str() + " " + own.sets.str())
                                           : pick(&InstanceTraits::sets);
    return {.sets = sets,
            .group = pick(&InstanceTraits::group),
            .bsdf = pick(&InstanceTraits::bsdf),
            .emission = pick(&InstanceTraits::emission),
            .normal = pick(&InstanceTraits::normal),
            .alpha = pick(&InstanceTraits::alpha),
            .volume = pick(&InstanceTraits::volume),
            .medium = pick(&InstanceTraits::medium),
            .priority = pick(&InstanceTraits::priority),
            .visibility = inherit(outer.visibility, own.visibility),
            .holdout = outer.holdout || own.holdout,
            .shadow_catcher = outer.shadow_catcher || own.shadow_catcher,
            .trace_distance = pick(&InstanceTraits::trace_distance)};
}

namespace dialects {
inline constexpr std::array kInstances{
    Spelling{.parameter = "shape",
             .today = "that is a volume around another shape is that shape today, with a `volume` "
                      "bsdf and a <volume type=\"constant\">, whose density is per unit of the "
                      "scene",
             .rewrite = volume_shape},
    Spelling{.parameter = "bsdf",
             .today =
                 "of type \"volumebsdf\" beside a <medium> is no surface: today the medium has "
                 "its colour, and the instance no bsdf",
             .rewrite = albedo_into_medium},
    Spelling{.parameter = "index",
             .today = "has no effect: nothing asks for the number of an object"},
};
} // namespace dialects

/// Returns the same number for the same traits. All of them count, since millions of instances may
/// differ in any one.
inline uint64_t hash_of(InstanceTraits const& traits) {
    auto const& [sets, group, bsdf, emission, normal, alpha, volume, medium, priority, visibility,
                 holdout, shadow_catcher, trace_distance] = traits;
    uint64_t hash = hash_combine(hash_bytes(sets.str()), hash_bytes(group.str()));
    for (int32_t part : {bsdf.index, emission.index, normal.index,
                         std::bit_cast<int32_t>(alpha.value), alpha.texture.index, volume.index,
                         medium.index, priority, std::bit_cast<int32_t>(trace_distance)})
        hash = hash_combine(hash, uint64_t(uint32_t(part)));
    auto const& [camera, diffuse, glossy, transmission, in_volume, shadow] = visibility;
    for (bool flag :
         {camera, diffuse, glossy, transmission, in_volume, shadow, holdout, shadow_catcher})
        hash = hash_combine(hash, flag);
    return hash;
}

struct Instance {
    static constexpr schema::TypeInfo info{.category = "instance",
                                           .type = "",
                                           .help =
                                               "One shape at one place, with what it is made of.",
                                           .spellings = dialects::kInstances};
    [[no_unique_address]] InstanceTraits
        traits; // `shape` takes the bytes that it leaves at its end
    ShapeId shape;
    Affined transform;

    template <class F>
    constexpr void describe(F&& f) {
        f("shape", shape, {.required = true, .help = "What is put there."});
        f("transform", transform,
          {.help = "From the shape's space to the world; mirroring and shear are welcome."});
        f.group(traits);
    }
};
static_assert(sizeof(Instance) == 160);

} // namespace weft::scene
