#include "apps/weft/progress_line.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace weft::apps {

ProgressStyle progress_style(std::string const& option) {
    if (option == "json") return ProgressStyle::Json;
    if (option == "none") return ProgressStyle::None;
    return isatty(STDERR_FILENO) ? ProgressStyle::Terminal : ProgressStyle::Lines;
}

std::string duration_text(double seconds) {
    if (seconds < 60) return fmt::format("{:.1f} s", seconds);
    int const s = int(seconds + 0.5);
    if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string count_text(double count) {
    if (count >= 1e6) return fmt::format("{:.1f} M", count / 1e6);
    if (count >= 1e4) return fmt::format("{:.0f} k", count / 1e3);
    return fmt::format("{:.0f}", count);
}

void ProgressLine::print(session::Progress const& p) {
    if (style_ == ProgressStyle::Json) {
        fmt::print(stderr,
                   "{{\"phase\":\"render\",\"percent\":{:.2f},\"samplesPerSecond\":{:.0f},"
                   "\"seconds\":{:.2f},\"secondsLeft\":{:.2f}}}\n",
                   100 * p.fraction, p.samples_per_second, p.seconds, p.seconds_left);
    } else if (style_ == ProgressStyle::Terminal) {
        fmt::print(stderr, "\r{:5.1f} %   {} samples/s   {} left   ", 100 * p.fraction,
                   count_text(p.samples_per_second), duration_text(p.seconds_left));
        if (p.fraction >= 1) fmt::print(stderr, "\n");
    } else if (style_ == ProgressStyle::Lines && p.seconds >= due_ && p.fraction < 1) {
        due_ = p.seconds + std::min(p.seconds, 10.0);
        fmt::print(stderr, "{:.1f} % after {}, {} samples/s, {} left\n", 100 * p.fraction,
                   duration_text(p.seconds), count_text(p.samples_per_second),
                   duration_text(p.seconds_left));
    }
    std::fflush(stderr);
}

void ProgressLine::stop() const {
    if (style_ == ProgressStyle::Terminal) fmt::print(stderr, "\n");
}

} // namespace weft::apps
