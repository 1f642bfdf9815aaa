// What several commands do with a scene: sizes, and the stage to render.
#pragma once

#include <string>

#include "io/scene_file.h"
#include "lights/stage.h"
#include "post/run.h"

namespace weft::apps {

/// Reads a size: "WxH" in pixels, or "P%" of the scene's; (0, 0) for "". Throws InputError.
Vec2i parse_size(std::string const& text, scene::Scene const& scene);

/// Makes the stage that `job` is rendered on, the same for all commands. `isa` and `size` are the
/// texts of the options of these names.
std::unique_ptr<lights::Stage const> commit_stage(scene::RenderJob const& job,
                                                  std::string const& isa = "",
                                                  std::string const& size = "");

/// Tells on stderr what the reader has to say of a file: warnings, and notes on other dialects.
void print_messages(io::SceneFile const& file);

/// Reads the files among the pictures that a postprocess reads into `pictures`. Throws InputError.
void read_picture_files(io::SceneFile const& file, scene::PostprocessJob const& job,
                        post::Pictures& pictures);

} // namespace weft::apps
