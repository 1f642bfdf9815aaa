// The file from which a render that died goes on: written now and then, gone when the render is
// done.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "session/render_state.h"

namespace weft::apps {

struct CheckpointArguments {
    std::string interval; ///< "60s"; empty: no checkpoints unless another option asks for them
    std::string file;
    bool resume = false, restart = false;

    bool wanted() const { return !interval.empty() || !file.empty() || resume || restart; }
};

void add_checkpoint_options(CLI::App& command, CheckpointArguments& arguments);

/// Reads "90", "90s", "1.5m" or "2h" and returns the seconds. Throws InputError naming `option`.
double parse_duration(std::string const& text, std::string const& option);

/// The checkpoint of one job. Nothing is written over before it is known to be of the same render.
class Checkpoint {
  public:
    /// Finds the checkpoint of a render whose first output is `output`, and proves that the disk
    /// takes one. Throws InputError where there is one of another render, or none to resume, and
    /// IoError where none can be written.
    Checkpoint(CheckpointArguments const& arguments, std::string const& output,
               session::RenderState const& start);

    /// Returns the state that was found; null where there was none.
    session::RenderState const* found() const { return found_ ? &*found_ : nullptr; }
    /// Returns what keeps the checkpoint up to date while the render goes on.
    session::Watcher watcher() const;
    /// Writes the state of a render; warns where it cannot, and keeps the one before.
    void save(session::RenderState const& state) const;
    void remove() const;
    std::string const& path() const { return path_; }

  private:
    std::string path_;
    double interval_;
    std::optional<session::RenderState> found_;
};

} // namespace weft::apps
