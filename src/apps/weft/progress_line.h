// The line that tells how far a render is: for people, for programs, or not at all.
#pragma once

#include <string>

#include "session/render.h"

namespace weft::apps {

enum class ProgressStyle { None, Terminal, Json };

/// From the option's text; `auto` is the terminal's line where stderr is one.
ProgressStyle progress_style(std::string const& option);

/// Prints `progress` to stderr; `last` ends the line.
void print_progress(ProgressStyle style, session::Progress const& progress, bool last);

/// "1:02:03", "2:05" or "12.3 s".
std::string duration_text(double seconds);
/// "12.3 M", "456 k", "78".
std::string count_text(double count);

} // namespace weft::apps
