// The line that tells how far a render is: for people, for programs, or not at all.
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/weft/profile_report.h"
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
    /// Says to programs that a phase begins: read, commit, render, write.
    void phase(char const* name);
    /// What a render that is done spent its time on; `print_profile` tells of all together.
    void add_profile(Profile const& profile) { profile_ += profile; }
    /// How long each phase took, and where the render's time went, to stderr.
    void print_profile() const;
    /// Says to programs what was reached; the last line of a picture.
    void done(session::RenderResult const& result) const;
    void print(session::Progress const& progress);
    /// Leaves the terminal's line where the render stopped early.
    void stop() const;

  private:
    using Clock = std::chrono::steady_clock;

    PhaseTimes phase_times() const;

    ProgressStyle style_;
    Clock::time_point start_ = Clock::now();
    std::vector<std::pair<std::string, Clock::time_point>> phases_; ///< and when each began
    Profile profile_;
    double due_ = 2; ///< seconds since the start, of the next plain line
};

/// Says how many samples count as black, and how to look at the first of them; nothing where there
/// are none. `seed`: of the render.
void report_bad_samples(uint64_t count, std::span<session::BadSample const> first,
                        std::string const& seed);

/// For people: size, samples, time, speed, memory, and what the render was after and reached.
void print_summary(session::RenderResult const& result, session::Plan const& plan,
                   session::RenderOptions const& options);

/// Bytes of memory that the process holds now, and at most so far; 0 where the system does not say.
double memory_now();
double memory_peak();

/// "1:02:03", "2:05" or "12.3 s".
std::string duration_text(double seconds);
/// "12.3 M", "456 k", "78".
std::string count_text(double count);

} // namespace weft::apps
