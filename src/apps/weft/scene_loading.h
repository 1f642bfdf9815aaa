// What several commands do with a scene: sizes, and the stage to render.
#pragma once

#include <string>

#include "io/scene_file.h"
#include "lights/stage.h"

namespace weft::apps {

/// "WxH" or "P%" of the scene's size; (0, 0) for "". Throws InputError.
Vec2i parse_size(std::string const& text, scene::Scene const& scene);

/// The stage that `job` is rendered on: every command that traces its paths makes this one. `isa`
/// and `size` as the options of these names.
std::unique_ptr<lights::Stage const> commit_stage(scene::RenderJob const& job,
                                                  std::string const& isa = "",
                                                  std::string const& size = "");

} // namespace weft::apps
