// A number for everything that a scene says, so that files and parts of pictures can tell whether
// they are of the same one.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace weft::scene {

/// A hash of all parameters and meshes, and of the images' sizes, kinds and, where they lie in
/// memory, texels. Not of where the file is, how it is laid out, or what its things are called. The
/// same on every machine and from run to run.
uint64_t scene_hash(Scene const& scene);

} // namespace weft::scene
