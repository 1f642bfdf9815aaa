#include "io/gltf.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/file_bytes.h"
#include "io/gltf_nodes.h"
#include "io/gltf_view.h"
#include "scene/scene_vectors.h"

namespace weft::io {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

/// Extensions that are read; KHR_mesh_quantization only allows more types of numbers, all known.
constexpr std::array kExtensions{"EXT_mesh_gpu_instancing"sv,
                                 "KHR_lights_punctual"sv,
                                 "KHR_materials_anisotropy"sv,
                                 "KHR_materials_clearcoat"sv,
                                 "KHR_materials_emissive_strength"sv,
                                 "KHR_materials_ior"sv,
                                 "KHR_materials_iridescence"sv,
                                 "KHR_materials_sheen"sv,
                                 "KHR_materials_specular"sv,
                                 "KHR_materials_transmission"sv,
                                 "KHR_materials_unlit"sv,
                                 "KHR_materials_volume"sv,
                                 "KHR_mesh_quantization"sv,
                                 "KHR_texture_transform"sv};

/// The strings of a list at the root.
std::vector<std::string> names(gltf::File& file, gltf::Json const& root, char const* list) {
    std::vector<std::string> result;
    auto const it = root.find(list);
    if (it == root.end()) return result;
    bool strings = it->is_array();
    if (strings)
        for (gltf::Json const& name : *it) strings = strings && name.is_string();
    if (!strings)
        file.report().fail(list, "expected an array of texts, found " + gltf::describe(*it));
    for (gltf::Json const& name : *it) result.push_back(name.get<std::string>());
    return result;
}

void check_extensions(gltf::File& file) {
    auto known = [](std::string const& name) {
        return std::find(kExtensions.begin(), kExtensions.end(), name) != kExtensions.end();
    };
    std::vector<std::string> const all(kExtensions.begin(), kExtensions.end());
    auto const required = names(file, file.json(), "extensionsRequired");
    for (size_t i = 0; i < required.size(); ++i)
        if (!known(required[i]))
            file.report().fail(
                "extensionsRequired[" + std::to_string(i) + "]",
                "the file cannot be understood without the extension " + in_quotes(required[i]) +
                    ", which is not supported" +
                    (nearest_name(required[i], all).empty() ? "" : suggestion(required[i], all)));
    auto const used = names(file, file.json(), "extensionsUsed");
    for (size_t i = 0; i < used.size(); ++i)
        if (!known(used[i]))
            file.report().warn("extensionsUsed[" + std::to_string(i) + "]",
                               "the extension " + in_quotes(used[i]) +
                                   " is not supported and left out");
}

/// What the whole file has and a picture of it has not.
void check_rest(gltf::File& file) {
    gltf::Object& root = file.root();
    for (auto const& [list, why] : {std::pair("animations", "are left out: the pose is that of "
                                                            "the nodes"),
                                    std::pair("skins", "are left out: meshes stand as they were "
                                                       "modelled")}) {
        if (!root.objects(list).empty()) file.report().warn(list, why);
    }
    root.extension("KHR_lights_punctual");
    for (char const* key : {"extensionsUsed", "extensionsRequired"}) root.ignore(key);
    root.finish();
}

} // namespace

bool is_gltf(std::string_view path) {
    std::string ending = fs::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return ending == ".gltf" || ending == ".glb";
}

GltfContents read_gltf(std::string_view bytes, std::string const& name, std::string const& folder,
                       scene::Scene& scene, image::TextureCache& textures) {
    gltf::File file(bytes, name, folder);
    check_extensions(file);
    GltfContents contents = gltf::NodeReader(file, scene, textures).read();
    check_rest(file);
    contents.warnings = file.report().warnings();
    return contents;
}

GltfContents read_gltf(std::string const& path, scene::Scene& scene,
                       image::TextureCache& textures) {
    FileBytes const bytes = read_file(path);
    return read_gltf(bytes.view(), path, fs::path(path).parent_path().string(), scene, textures);
}

SceneFile read_gltf_scene(std::string const& path, std::shared_ptr<image::TextureCache> textures) {
    if (!textures) textures = std::make_shared<image::TextureCache>();
    auto scene = std::make_shared<scene::Scene>();
    GltfContents contents = read_gltf(path, *scene, *textures);
    scene::SceneContents& to = scene->contents;
    if (contents.instances.empty())
        throw InputError({path}, "expected a mesh in the default scene, found none");
    if (contents.cameras.empty()) {
        contents.cameras.push_back(scene::add(*scene, scene::CameraKind{},
                                              gltf::frame_all(*scene, contents.instances, {path})));
    }
    to.camera = contents.cameras.front();
    if (contents.cameras.size() > 1)
        contents.warnings.push_back(path + ": the first of " +
                                    std::to_string(contents.cameras.size()) + " cameras is used");
    to.instances = contents.instances;
    to.lights = contents.lights;
    auto add_light = [&](scene::Light light, SourceLocation const& where) {
        to.lights.push_back(scene::add(*scene, scene::LightKind{}, std::move(light), where));
    };
    auto add_lamps = [&](std::vector<scene::InstanceId> const& lamps, float weight) {
        for (scene::InstanceId id : lamps)
            add_light(scene::AreaLight{.instance = id, .controls = {.weight = weight}},
                      location_of(*scene, id));
    };
    add_lamps(contents.emissive, 1);
    add_lamps(contents.unlit, 0);
    if (contents.radiance <= 1 &&
        !gltf::light_a_room(*scene, contents.lights, contents.instances)) {
        add_light(gltf::make_studio(*scene, scene->cameras[size_t(to.camera.index)]), {path});
        if (!contents.lights.empty())
            contents.warnings.push_back(path + ": its lamps give less light than a dim room has: "
                                               "a studio is added");
    }
    scene::RenderJob job;
    job.integrator = scene::PathIntegrator{};
    job.scene = std::move(scene);
    job.folder = fs::path(path).parent_path().string();
    job.where = {path};
    SceneFile result;
    result.jobs.push_back(std::move(job));
    result.warnings = std::move(contents.warnings);
    for (std::string& warning : textures->take_warnings())
        result.warnings.push_back(std::move(warning));
    result.textures = std::move(textures);
    return result;
}

} // namespace weft::io
