// The commands of the `weft` program. Each adds its options to the command line and says what to
// run; `run` returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace weft::apps {

/// 0 done; 1 a test or comparison failed; 2 the user's input was wrong; 3 internal error;
/// 130 stopped by Ctrl-C.
enum ExitCode { kDone = 0, kFailed = 1, kInputError = 2, kInternalError = 3, kInterrupted = 130 };

using Command = std::function<int()>;

/// Each registers one subcommand. The one that the user has named sets `chosen` to what is to be
/// run.
void add_render_command(CLI::App& app, Command& chosen);
void add_replay_command(CLI::App& app, Command& chosen);
void add_merge_command(CLI::App& app, Command& chosen);
void add_test_command(CLI::App& app, Command& chosen);
void add_convert_command(CLI::App& app, Command& chosen);
void add_info_command(CLI::App& app, Command& chosen);
void add_compare_command(CLI::App& app, Command& chosen);
void add_display_command(CLI::App& app, Command& chosen);
void add_bloom_command(CLI::App& app, Command& chosen);
void add_maketx_command(CLI::App& app, Command& chosen);
void add_denoise_command(CLI::App& app, Command& chosen);
void add_help_command(CLI::App& app, Command& chosen);
void add_schema_command(CLI::App& app, Command& chosen);
void add_docs_command(CLI::App& app, Command& chosen);
void add_completion_command(CLI::App& app, Command& chosen);

/// Returns all that `weft help` can be asked for: topics, types, categories and materials.
std::vector<std::string> help_topics();

} // namespace weft::apps
