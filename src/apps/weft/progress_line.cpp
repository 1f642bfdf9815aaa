#include "apps/weft/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <sys/resource.h>
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

namespace {

/// A JSON number, or null for what nobody knows.
std::string number(double v, int digits) {
    return std::isfinite(v) ? fmt::format("{:.{}f}", v, digits) : "null";
}

/// For people: "1:02 left", or nothing where nobody knows.
std::string left_text(double seconds) {
    return std::isfinite(seconds) ? duration_text(seconds) + " left" : "time left unknown";
}

std::string noise_text(std::optional<double> noise) {
    return noise ? fmt::format(", noise {:.3g}", *noise) : "";
}

} // namespace

double memory_now() {
    long pages = 0;
    if (std::ifstream in("/proc/self/statm"); !(in >> pages >> pages)) return 0;
    return double(pages) * double(sysconf(_SC_PAGE_SIZE));
}

double memory_peak() {
    rusage usage = {};
    return getrusage(RUSAGE_SELF, &usage) == 0 ? double(usage.ru_maxrss) * 1024 : 0;
}

PhaseTimes ProgressLine::phase_times() const {
    auto const seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    Clock::time_point const now = Clock::now();
    PhaseTimes times;
    times.all = seconds(now - start_);
    for (size_t i = 0; i < phases_.size(); ++i) {
        auto const& [name, begin] = phases_[i];
        double const took = seconds((i + 1 < phases_.size() ? phases_[i + 1].second : now) - begin);
        auto const same = std::find_if(times.phases.begin(), times.phases.end(),
                                       [&](auto const& p) { return p.first == phases_[i].first; });
        if (same == times.phases.end())
            times.phases.emplace_back(name, took);
        else
            same->second += took;
    }
    return times;
}

void ProgressLine::print_profile() const {
    if (style_ == ProgressStyle::Json)
        fmt::print(stderr, "{{\"phase\":\"profile\",\"percent\":100,\"memory\":{:.0f},{}}}\n",
                   memory_now(), profile_json(phase_times(), profile_));
    else
        fmt::print(stderr, "{}", profile_text(phase_times(), profile_));
    std::fflush(stderr);
}

void ProgressLine::phase(char const* name) {
    phases_.emplace_back(name, Clock::now());
    if (style_ != ProgressStyle::Json) return;
    fmt::print(stderr, "{{\"phase\":\"{}\",\"percent\":0,\"memory\":{:.0f}}}\n", name,
               memory_now());
    std::fflush(stderr);
}

void ProgressLine::done(session::RenderResult const& r) const {
    if (style_ != ProgressStyle::Json) return;
    fmt::print(stderr,
               "{{\"phase\":\"done\",\"percent\":{},\"samplesPerSecond\":{:.0f},\"seconds\":{:.2f},"
               "\"secondsLeft\":0,\"noise\":{},\"leastSamples\":{},\"pixelSamples\":{:.0f},"
               "\"complete\":{},\"badSamples\":{},\"memory\":{:.0f},\"peakMemory\":{:.0f}}}\n",
               100, r.samples_per_second, r.seconds, r.noise ? number(*r.noise, 5) : "null",
               r.least_samples, r.pixel_samples, !r.cancelled, r.bad_samples, memory_now(),
               memory_peak());
    std::fflush(stderr);
}

void report_bad_samples(uint64_t count, std::span<session::BadSample const> first,
                        std::string const& seed) {
    if (count == 0) return;
    fmt::print(
        stderr,
        "warning: {} samples were not finite or negative light and count as black; `weft replay` "
        "traces one again; the first:\n",
        count);
    for (auto const& b : first)
        fmt::print(stderr, "  pixel {},{} sample {} seed {}: {} {} {}\n", b.pixel.x, b.pixel.y,
                   b.sample, seed, b.value.r, b.value.g, b.value.b);
}

void print_summary(session::RenderResult const& r, session::Plan const& plan,
                   session::RenderOptions const& o) {
    double const pixels = double(plan.region.pixels()), mean = r.pixel_samples / pixels;
    double const wanted_noise = o.limits.noise;
    session::Part const& part = o.picture.part;
    bool const even = mean == r.least_samples;
    fmt::print(stderr, "{} x {} pixels, {}: {}, {} samples/s, {:.0f} MiB at most\n",
               plan.region.width(), plan.region.height(),
               !part.is_whole() ? to_string(part)
               : even           ? fmt::format("{} samples each", r.least_samples)
                                : fmt::format("{} samples or more each, {:.1f} on the average",
                                              r.least_samples, mean),
               duration_text(r.seconds), count_text(r.samples_per_second),
               memory_peak() / (1 << 20));
    if (r.stopped_by == session::StoppedBy::time)
        fmt::print(
            stderr, "the time was up{}\n",
            r.noise ? fmt::format(" at a noise of {:.3g}; wanted: {:.3g}", *r.noise, wanted_noise)
                    : "");
    else if (r.noise && r.stopped_by == session::StoppedBy::noise)
        fmt::print(stderr, "the noise is at most {:.3g}, by estimate\n", *r.noise);
    else if (r.noise && wanted_noise > 0 && !r.cancelled)
        fmt::print(stderr,
                   "the noise is {:.3g} where it is worst, not {:.3g}: some pixels have all of the "
                   "{} samples that --spp allows\n",
                   *r.noise, wanted_noise, plan.samples);
    if (r.cancelled)
        fmt::print(
            stderr,
            "stopped; what is done is written: {} of {} samples in each pixel, {:.1f} on the "
            "average\n",
            r.least_samples, plan.samples, mean);
}

void ProgressLine::print(session::Progress const& p) {
    if (style_ == ProgressStyle::Json) {
        fmt::print(stderr,
                   "{{\"phase\":\"render\",\"percent\":{:.2f},\"samplesPerSecond\":{:.0f},"
                   "\"seconds\":{:.2f},\"secondsLeft\":{},\"samples\":{},\"noise\":{},"
                   "\"memory\":{:.0f}}}\n",
                   100 * p.fraction, p.samples_per_second, p.seconds, number(p.seconds_left, 2),
                   p.samples_done, p.noise ? number(*p.noise, 5) : "null", memory_now());
    } else if (style_ == ProgressStyle::Terminal) {
        fmt::print(stderr, "\r{:5.1f} %   {} samples/s   {}{}   ", 100 * p.fraction,
                   count_text(p.samples_per_second), left_text(p.seconds_left),
                   noise_text(p.noise));
        if (p.fraction >= 1) fmt::print(stderr, "\n");
    } else if (style_ == ProgressStyle::Lines && p.seconds >= due_ && p.fraction < 1) {
        due_ = p.seconds + std::min(p.seconds, 10.0);
        fmt::print(stderr, "{:.1f} % after {}, {} samples/s, {}{}\n", 100 * p.fraction,
                   duration_text(p.seconds), count_text(p.samples_per_second),
                   left_text(p.seconds_left), noise_text(p.noise));
    }
    std::fflush(stderr);
}

void ProgressLine::stop() const {
    if (style_ == ProgressStyle::Terminal) fmt::print(stderr, "\n");
}

} // namespace weft::apps
