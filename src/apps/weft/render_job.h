// One picture of a scene file, rendered as the user asked for: what `weft render` does for each.
#pragma once

#include <string>
#include <vector>

#include "apps/weft/checkpoint.h"
#include "apps/weft/display_options.h"
#include "apps/weft/progress_line.h"
#include "apps/weft/texture_options.h"
#include "post/run.h"
#include "session/render_state.h"

namespace weft::apps {

struct RenderArguments {
    std::string scene;
    std::vector<std::string> outputs;
    std::string size, crop;
    std::string progress = "auto";
    std::vector<std::string> overrides, aovs;
    std::string isa;
    TextureArguments textures;
    CheckpointArguments checkpoint;
    std::string shard, samples, time, watch, tev;
    bool preview = false, profile = false;
    OptionTexts display;
    session::RenderOptions options;
};

/// Where a picture goes: NAME.exr beside the scene or in the folders that the user asked for; files
/// that the user asked for get the `final` picture alone, so that others may go nowhere.
std::vector<std::string> output_paths(RenderArguments const& a, scene::PictureName const& picture,
                                      bool final);

/// "K/N" of --shard and "A:B" of --samples, either of which may be empty. Throws InputError.
session::Part parse_part(std::string const& shard, std::string const& samples);

/// Renders and writes `job`; `made` becomes the picture. `final`: files of -o are for this picture;
/// `only_picture`: the scene makes no other. Returns the program's exit code.
int render_job(RenderArguments const& a, scene::RenderJob const& job, bool final, bool only_picture,
               image::TextureCache const& textures, post::DisplayChain const& chain,
               ProgressLine& progress, post::Picture& made);

} // namespace weft::apps
