// A number for everything that a scene says, so that files and parts of pictures can tell whether
// they are of the same one.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace weft::scene {

/// A hash of all parameters and meshes, and of images: the contents of their files, which the first
/// call reads (image/source_file.h), or the texels of those that are of none. Not of where files
/// are, how the scene's is laid out, what its things are called, or whether texels lie in memory.
/// The same on every machine and from run to run.
uint64_t scene_hash(Scene const& scene);

} // namespace weft::scene
