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

/// Returns the style that an option's text names. `auto` is a line that changes where stderr is a
/// terminal, and plain lines now and then elsewhere.
ProgressStyle progress_style(std::string const& option);

/// Prints to stderr. Plain lines come after 2, 4, 8 and 16 seconds, and then every ten.
class ProgressLine {
  public:
    explicit ProgressLine(ProgressStyle style) : style_(style) {}
    /// Says to programs that a phase begins: read, commit, render, write.
    void phase(char const* name);
    /// Adds the profile of a render that is done to what `print_profile` tells.
    void add_profile(Profile const& profile) { profile_ += profile; }
    /// Prints how long each phase took, and where the render's time went.
    void print_profile() const;
    /// Says to programs what was reached, as the last line of a picture.
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

/// Says to people what was made and reached: size, samples, time, speed, memory, and why it ended.
void print_summary(session::RenderResult const& result, session::Plan const& plan,
                   session::RenderOptions const& options);

/// Return the bytes of memory that the process holds now, and the most that it has held; 0 where
/// the system does not say.
double memory_now();
double memory_peak();

/// Returns a time as "1:02:03", "2:05" or "12.3 s".
std::string duration_text(double seconds);
/// Returns a number as "12.3 M", "456 k" or "78".
std::string count_text(double count);

} // namespace weft::apps
