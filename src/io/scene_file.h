// The native scene format: a superset of lightwave's XML (docs/scene-format.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/texture_cache.h"
#include "scene/display.h"
#include "scene/postprocess.h"
#include "scene/scene.h"
#include "schema/schema.h"

namespace weft::io {

/// One integrator of a file, with the scene that it renders.
struct RenderJob {
    scene::Integrator integrator;
    scene::RenderTarget target;
    scene::Sampler sampler;
    std::shared_ptr<scene::Scene const> scene;
    std::string image_name; ///< the id of its <image>, of its <test>, or ""
    std::string folder;     ///< of the file; "" is the current one
    std::optional<scene::ImageTest> test;
    SourceLocation where;
};

/// One postprocess of a file. Its ImageIds and those of the jobs' targets are indices into
/// `SceneFile::pictures`; what it reads is made by a job or postprocess that comes before it.
struct PostprocessJob {
    scene::Postprocess postprocess;
    size_t jobs_before = 0; ///< how many of the file's jobs come before it
    SourceLocation where;
};

/// What an <image> of a file is called, which folder it goes to, and how it is shown.
struct PictureName {
    std::string name;             ///< the id
    std::string folder;           ///< of the file; "" is the current one
    scene::Display display;       ///< the default one where the file has none
    SourceLocation display_where; ///< of its <display>; empty where there is none
};

struct SceneFile {
    std::vector<RenderJob> jobs;               ///< in file order
    std::vector<PostprocessJob> postprocesses; ///< in file order
    std::vector<PictureName> pictures;
    std::vector<std::string> warnings;
    std::shared_ptr<image::TextureCache> textures; ///< through which the scenes' images were read
};

/// Reads a scene file and everything that it names. Each override "PATH.PARAM=VALUE" sets a
/// parameter of the objects that PATH (ids or tags, outermost first) leads to, as if the file
/// said so. A file with a scene and no integrator gives one job: `path` with its defaults.
/// Images are read through `textures`, or through a cache of the default size where it is null.
/// A glTF file (.gltf, .glb) is a scene as io/gltf.h says, and takes no overrides.
/// Throws InputError.
SceneFile read_scene_file(std::string const& path, std::vector<std::string> const& overrides = {},
                          std::shared_ptr<image::TextureCache> textures = {});

/// As read_scene_file, for text in memory.
SceneFile parse_scene(std::string_view text, std::string const& name, std::string const& folder,
                      std::vector<std::string> const& overrides = {},
                      std::shared_ptr<image::TextureCache> textures = {});

/// The schemas of every type that a file may name, by category.
std::vector<schema::Schema> all_schemas();

} // namespace weft::io
