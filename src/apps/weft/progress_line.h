// The line that tells how far a render is: for people, for programs, or not at all.
#pragma once

#include <string>

#include "session/render.h"

namespace weft::apps {

enum class ProgressStyle { None, Lines, Terminal, Json };

/// From the option's text; `auto` is one line that changes where stderr is a terminal, and else a
/// plain line now and then.
ProgressStyle progress_style(std::string const& option);

/// Prints to stderr. Plain lines come after 2, 4, 8 and 16 seconds, and then every ten.
class ProgressLine {
  public:
    explicit ProgressLine(ProgressStyle style) : style_(style) {}
    void print(session::Progress const& progress);
    /// Leaves the terminal's line where the render stopped early.
    void stop() const;

  private:
    ProgressStyle style_;
    double due_ = 2; ///< seconds since the start, of the next plain line
};

/// "1:02:03", "2:05" or "12.3 s".
std::string duration_text(double seconds);
/// "12.3 M", "456 k", "78".
std::string count_text(double count);

} // namespace weft::apps
