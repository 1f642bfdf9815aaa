// What is legal in a material and hardly meant: each with where it is written and what to do.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace weft::shading {

/// "file:line:column: what, and what to do about it", for all materials of a scene.
std::vector<std::string> material_warnings(scene::Scene const& scene);

} // namespace weft::shading
