// One picture of a scene file, rendered as the user asked for: what `weft render` does for each.
#pragma once

#include <string>
#include <vector>

#include "apps/weft/checkpoint.h"
#include "apps/weft/display_options.h"
#include "apps/weft/live_view.h"
#include "apps/weft/progress_line.h"
#include "apps/weft/texture_options.h"
#include "post/run.h"
#include "session/render_state.h"

namespace weft::apps {

/// A part of a picture, as the user names it: "K/N" and "A:B".
struct PartArguments {
    std::string shard, samples;
};

struct RenderArguments {
    std::string scene;
    std::vector<std::string> outputs, overrides, aovs;
    std::string size, crop, isa, time;
    std::string progress = "auto";
    bool preview = false, profile = false;
    PartArguments part;
    CheckpointArguments checkpoint;
    LiveArguments live;
    TextureArguments textures;
    OptionTexts display;
    session::RenderOptions options; ///< all of the above that needs no scene, once it is parsed
};

/// Returns where a picture goes: to NAME.exr beside the scene or in the folders that the user asked
/// for. Files that the user asked for get the `final` picture alone, so that others may go nowhere.
std::vector<std::string> output_paths(RenderArguments const& a, scene::PictureName const& picture,
                                      bool final);

/// Reads the part that the texts name, either of which may be empty. Throws InputError.
session::Part parse_part(PartArguments const& texts);

/// One job of a scene file, and what of the file it needs.
struct JobTask {
    scene::RenderJob const& job;
    image::TextureCache const& textures;
    post::DisplayChain const& chain; ///< how its picture is shown
    bool is_final;                   ///< files of -o are for this picture
    bool is_only;                    ///< the scene makes no other picture
    /// Files of the pictures that postprocesses make of it, with its AOVs.
    std::vector<std::string> later;
};

struct JobResult {
    int code; ///< the program's exit code
    post::Picture picture;
};

/// Renders a job and writes its picture.
JobResult render_job(RenderArguments const& a, JobTask const& task, ProgressLine& progress);

} // namespace weft::apps
