// What several commands do with a scene: sizes and lint warnings.
#pragma once

#include <string>
#include <vector>

#include "world/world.h"

namespace weft::apps {

/// "WxH" or "P%" of the scene's size; (0, 0) for "". Throws InputError.
Vec2i parse_size(std::string const& text, scene::Scene const& scene);

/// What in a world is likely to be a mistake, each with what to do about it.
std::vector<std::string> lint_warnings(world::World const& world);

} // namespace weft::apps
