// glTF 2.0 scenes (Khronos 2021, ISO/IEC 12113:2022): text with external or embedded data, and
// the binary container .glb.
//
// Meshes, the hierarchy of nodes (EXT_mesh_gpu_instancing included), cameras, lamps
// (KHR_lights_punctual) and materials become plain scene data; gltf_mesh.h, gltf_texture.h and
// gltf_material.h say how. glTF's axes are kept: y is up, and +z is what a model faces.
// Lamps are photometric: candela and lux are divided by 683 lm/W, as if all light were green at
// 555 nm, which is what other importers do. A camera's clipping planes have no meaning here.
//
// Left out, with a warning that names the place: animations, skins, morph targets, points and
// lines, and whatever extension is not listed there. One that the file says it cannot be
// understood without is an error.
//
// The JSON is read by nlohmann-json and not by tinygltf, whose version 2.7 takes a member of the
// wrong type for an absent one, tells no place, and can be made to read beyond the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/scene_file.h"

namespace weft::io {

/// What a glTF file adds to a scene.
struct GltfContents {
    std::vector<scene::InstanceId> instances; ///< what is there to be seen, lamps included
    std::vector<scene::InstanceId> emissive;  ///< those of them that light others
    std::vector<scene::InstanceId> unlit;     ///< those that shine without being lamps
    float radiance = 0;                       ///< of the brightest emission
    std::vector<scene::LightId> lights;
    std::vector<scene::CameraId> cameras; ///< in the order of the nodes
    std::vector<std::string> warnings;    ///< what could not be taken over, and where it stands
};

/// Returns whether the name ends like that of a glTF file.
bool is_gltf(std::string_view path);

/// Appends what the file shows (its default scene) to `scene`. `contents` of the scene is left
/// alone; images are read through `textures`. Throws InputError naming the file and the path inside
/// of its JSON.
GltfContents read_gltf(std::string const& path, scene::Scene& scene, image::TextureCache& textures);

/// The same for a file already in memory; what it names is looked for in `folder`.
GltfContents read_gltf(std::string_view bytes, std::string const& name, std::string const& folder,
                       scene::Scene& scene, image::TextureCache& textures);

/// A glTF file as something to render: its first camera, or one that sees all of it; its lights,
/// and a studio's where they hardly light a room and no material shines brighter than white paper
/// (radiance 1). `textures` is as for `read_scene_file`. Throws InputError, also for a file that
/// shows nothing.
SceneFile read_gltf_scene(std::string const& path,
                          std::shared_ptr<image::TextureCache> textures = {});

} // namespace weft::io
