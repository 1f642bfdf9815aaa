// What several commands do with a scene: sizes.
#pragma once

#include <string>

#include "world/world.h"

namespace weft::apps {

/// "WxH" or "P%" of the scene's size; (0, 0) for "". Throws InputError.
Vec2i parse_size(std::string const& text, scene::Scene const& scene);

} // namespace weft::apps
