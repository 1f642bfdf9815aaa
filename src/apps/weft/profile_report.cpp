#include "apps/weft/profile_report.h"

#include <algorithm>
#include <fmt/format.h>

#include "apps/weft/progress_line.h"

namespace weft::apps {

namespace {

double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

/// All features, the longest first.
std::vector<Feature> by_time(Profile const& profile) {
    std::vector<Feature> features;
    for (size_t i = 0; i < kFeatures; ++i) features.push_back(Feature(i));
    std::stable_sort(features.begin(), features.end(), [&](Feature a, Feature b) {
        return profile.seconds[size_t(a)] > profile.seconds[size_t(b)];
    });
    return features;
}

std::string features_text(Profile const& p) {
    std::string text;
    for (Feature const f : by_time(p))
        if (double const seconds = p.seconds[size_t(f)]; seconds > 0)
            text += fmt::format("  {:<16}{:>10}{:>8.1f} %\n", feature_name(f),
                                duration_text(seconds), percent(seconds, p.processor_seconds));
    return text + fmt::format("  {:<16}{:>10}  of processor time, {:.0f} % of what all threads "
                              "together could have had; by {} samples\n",
                              "all features", duration_text(p.processor_seconds),
                              percent(p.processor_seconds, p.thread_seconds), p.samples);
}

} // namespace

std::string profile_text(PhaseTimes const& times, Profile const& profile) {
    std::string text;
    for (auto const& [name, seconds] : times.phases) {
        text += fmt::format("{:<8}{:>10}{:>8.1f} %\n", name, duration_text(seconds),
                            percent(seconds, times.all));
        if (name == "render") text += features_text(profile);
    }
    return text + fmt::format("{:<8}{:>10}\n", "total", duration_text(times.all));
}

std::string profile_json(PhaseTimes const& times, Profile const& p) {
    std::string phases, features;
    for (auto const& [name, seconds] : times.phases)
        phases += fmt::format("{}\"{}\":{:.3f}", phases.empty() ? "" : ",", name, seconds);
    for (Feature const f : by_time(p))
        features += fmt::format("{}{{\"name\":\"{}\",\"seconds\":{:.4f},\"percent\":{:.2f}}}",
                                features.empty() ? "" : ",", feature_name(f), p.seconds[size_t(f)],
                                percent(p.seconds[size_t(f)], p.processor_seconds));
    return fmt::format("\"seconds\":{:.3f},\"phases\":{{{}}},\"processorSeconds\":{:.4f},"
                       "\"threadSeconds\":{:.4f},\"profileSamples\":{},\"features\":[{}]",
                       times.all, phases, p.processor_seconds, p.thread_seconds, p.samples,
                       features);
}

} // namespace weft::apps
