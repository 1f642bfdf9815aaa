// What several commands do with a scene: sizes, and the world to render.
#pragma once

#include <string>

#include "io/scene_file.h"
#include "world/world.h"

namespace weft::apps {

/// "WxH" or "P%" of the scene's size; (0, 0) for "". Throws InputError.
Vec2i parse_size(std::string const& text, scene::Scene const& scene);

/// The world that `job` is rendered in: every command that traces its paths makes this one. `isa`
/// and `size` as the options of these names.
std::unique_ptr<world::World const> commit_world(scene::RenderJob const& job,
                                                 std::string const& isa = "",
                                                 std::string const& size = "");

} // namespace weft::apps
