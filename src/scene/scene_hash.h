// A number for everything that a scene says. Pictures and parts of pictures carry it, so that parts
// of different scenes are never mixed.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace weft::scene {

/// Returns a hash of all objects and of all that files hold (every vector of scene_vectors.h but
/// the notes). Of an image, the contents of its file count, which the first call reads
/// (image/source_file.h), or its texels where it has no file. It does not depend on where files
/// are, how the scene's is laid out, what its things are called, or whether texels lie in memory.
/// It is the same on every machine and from run to run.
uint64_t scene_hash(Scene const& scene);

} // namespace weft::scene
