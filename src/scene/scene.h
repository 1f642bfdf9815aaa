// The scene as plain data: vectors of structs that refer to each other by typed indices. Readers
// make it, `World::commit` turns it into what a render reads.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "image/texture.h"
#include "scene/camera.h"
#include "scene/dialects.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/mesh.h"
#include "scene/photometry.h"
#include "scene/render_settings.h"
#include "scene/shape.h"
#include "scene/texture.h"

namespace weft::scene {

namespace dialects {
inline constexpr std::array kScenes{
    Spelling{.parameter = "instance",
             .today = "that is a volume around no shape is the `medium` of the scene today",
             .rewrite = volume_everywhere},
};
} // namespace dialects

/// What stands directly inside `<scene>`.
struct SceneContents {
    static constexpr schema::TypeInfo info{
        .category = "scene",
        .type = "",
        .help = "A camera, lights and instances; also materials, textures and shapes with an id, "
                "for use by reference.",
        .spellings = dialects::kScenes};
    CameraId camera;
    std::vector<LightId> lights;
    std::vector<InstanceId> instances;
    MediumId medium;

    template <class F>
    constexpr void describe(F&& f) {
        f("camera", camera, {.required = true, .help = "The point of view."});
        f("light", lights, {.help = "The lights."});
        f("instance", instances, {.help = "What is there to be seen."});
        f("medium", medium,
          {.help = "What fills all space that no shape fills: fog around the camera."});
    }
};

/// One file of a set whose name holds <UDIM>: tile 1001 + u + 10 v covers [u, u + 1) x [v, v + 1).
struct UdimTile {
    int number = 1001;
    int32_t image = -1; ///< index into the scene's images
};

/// All that a picture is made of. scene/scene_vectors.h lists the members once more, for whoever
/// has to walk over all of them; one that is not listed does not compile.
struct Scene {
    SceneContents contents;
    std::vector<Camera> cameras;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Layer> layers;
    std::vector<LambertianEmission> emissions;
    std::vector<ConstantVolume> volumes;
    std::vector<HomogeneousMedium> media;
    std::vector<Shape> shapes;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Portal> portals;

    /// What files hold; shared, since several scenes of one document may use them.
    std::vector<std::shared_ptr<Mesh const>> meshes;
    std::vector<std::shared_ptr<image::Texture const>> images;
    std::vector<std::shared_ptr<Photometry const>> photometries;
    /// What file names with <UDIM> stand for: their `resource` is an index into this.
    std::vector<std::vector<UdimTile>> udims;

    /// Where things were written, for messages. These vectors may be shorter than those of the
    /// objects: ask `location_of` and `name_of`.
    std::vector<SourceLocation> instance_locations;
    std::vector<SourceLocation> light_locations;
    std::vector<SourceLocation> material_locations;
    std::vector<SourceLocation> texture_locations;
    std::vector<SharedText> instance_names; ///< ids; "" where there is none
    std::vector<SharedText> material_names; ///< likewise
};

/// Returns an object's id in a scene file or its name in a glTF file; "" where it has none.
template <class Kind>
std::string_view name_of(Scene const& scene, schema::Id<Kind> id) {
    auto const name = [&](auto const& names) -> std::string_view {
        if (size_t(id.index) >= names.size()) return "";
        std::string const& text = names[size_t(id.index)];
        return text;
    };
    if constexpr (std::is_same_v<Kind, InstanceKind>) return name(scene.instance_names);
    if constexpr (std::is_same_v<Kind, MaterialKind>) return name(scene.material_names);
    return "";
}

/// Where an object was written. Where nobody has said, a place that tells which one it is:
/// "instance 3 'lamp'", counted from 0.
template <class Kind>
SourceLocation location_of(Scene const& scene, schema::Id<Kind> id) {
    std::vector<SourceLocation> const* known = nullptr;
    if constexpr (std::is_same_v<Kind, InstanceKind>) known = &scene.instance_locations;
    if constexpr (std::is_same_v<Kind, LightKind>) known = &scene.light_locations;
    if constexpr (std::is_same_v<Kind, MaterialKind>) known = &scene.material_locations;
    if constexpr (std::is_same_v<Kind, schema::TextureKind>) known = &scene.texture_locations;
    if (known && size_t(id.index) < known->size() && !(*known)[size_t(id.index)].file.empty())
        return (*known)[size_t(id.index)];
    std::string text = Kind::category + (" " + std::to_string(id.index));
    if (std::string_view const name = name_of(scene, id); !name.empty())
        text += " '" + std::string(name) + "'";
    return {text};
}

} // namespace weft::scene
