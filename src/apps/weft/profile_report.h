// What `weft render --profile` says: how long each phase took, and what the processors did while
// rendering.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/profiler.h"

namespace weft::apps {

struct PhaseTimes {
    std::vector<std::pair<std::string, double>> phases; ///< seconds, in the order of their begins
    double all = 0;                                     ///< seconds since the start
};

/// Returns a table of the phases. Under the render stand the features that took any time, the
/// longest first, in processor time of all threads together.
std::string profile_text(PhaseTimes const& times, Profile const& profile);

/// Returns the same, with all features, as the members of a JSON object without its braces.
std::string profile_json(PhaseTimes const& times, Profile const& profile);

} // namespace weft::apps
