// The native scene format: a superset of lightwave's XML (docs/scene-format.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "image/texture_cache.h"
#include "scene/job.h"
#include "schema/schema.h"

namespace weft::io {

struct SceneFile {
    std::vector<scene::RenderJob> jobs;               ///< in file order
    std::vector<scene::PostprocessJob> postprocesses; ///< in file order
    std::vector<scene::PictureName> pictures;
    std::vector<std::string> warnings;
    std::vector<std::string> notes; ///< on what other dialects call otherwise: see io/modernise.h
    std::shared_ptr<image::TextureCache> textures; ///< through which the scenes' images were read
};

/// Reads a scene file and everything that it names. Each override "PATH.PARAM=VALUE" sets a
/// parameter of the objects that PATH (ids or tags, outermost first) leads to, as if the file
/// said so. A file with a scene and neither an integrator nor a postprocess gives one job: `path`
/// with its defaults. Files of other dialects are taken as they are meant.
/// Images are read through `textures`, or through a cache of the default size where it is null.
/// A glTF file (.gltf, .glb) is a scene as io/gltf.h says, and takes no overrides.
/// Throws InputError.
SceneFile read_scene_file(std::string const& path, std::vector<std::string> const& overrides = {},
                          std::shared_ptr<image::TextureCache> textures = {});

/// Does what read_scene_file does, for text in memory.
SceneFile parse_scene(std::string_view text, std::string const& name, std::string const& folder,
                      std::vector<std::string> const& overrides = {},
                      std::shared_ptr<image::TextureCache> textures = {});

/// The schemas of every type that a file may name, by category.
std::vector<schema::Schema> all_schemas();

} // namespace weft::io
