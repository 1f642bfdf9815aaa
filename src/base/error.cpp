#include "base/error.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace weft {

std::string to_string(SourceLocation const& where) {
    std::string s = where.file.str();
    if (where.line > 0) s += ":" + std::to_string(where.line);
    if (where.line > 0 && where.column > 0) s += ":" + std::to_string(where.column);
    return s;
}

namespace {

/// Levenshtein distance with two rows, case ignored.
int edit_distance(std::string_view a, std::string_view b) {
    auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<int> previous(b.size() + 1), current(b.size() + 1);
    std::iota(previous.begin(), previous.end(), 0);
    for (size_t i = 1; i <= a.size(); ++i) {
        current[0] = int(i);
        for (size_t j = 1; j <= b.size(); ++j) {
            int const substitute = previous[j - 1] + (lower(a[i - 1]) != lower(b[j - 1]));
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, substitute});
        }
        std::swap(previous, current);
    }
    return previous[b.size()];
}

} // namespace

std::string nearest_name(std::string_view name, std::span<std::string const> candidates) {
    int best = std::max(2, int(name.size()) / 3) + 1;
    std::string nearest;
    constexpr size_t longest = 100; // nobody means a longer name, and the search is quadratic
    if (name.size() > longest) return nearest;
    for (std::string const& c : candidates) {
        if (c.size() > longest) continue;
        int const d = edit_distance(name, c);
        if (d < best && d < int(std::max(name.size(), c.size()))) {
            best = d;
            nearest = c;
        }
    }
    return nearest;
}

std::string suggestion(std::string_view name, std::span<std::string const> candidates) {
    if (std::string const near = nearest_name(name, candidates); !near.empty())
        return " (did you mean '" + near + "'?)";
    constexpr size_t most = 20;
    std::string list;
    for (std::string const& c : candidates.first(std::min(most, candidates.size())))
        list += (list.empty() ? "" : ", ") + c.substr(0, 100);
    if (candidates.size() > most) list += ", ...";
    return list.empty() ? "" : "; known: " + list;
}

std::string in_quotes(std::string_view text) {
    constexpr size_t longest = 200;
    bool const cut = text.size() > longest;
    size_t end = cut ? longest : text.size();
    // Not inside of a character, which has at most four bytes.
    while (cut && end > longest - 4 && (text[end] & 0xc0) == 0x80) --end;
    std::string result = "'";
    for (char c : text.substr(0, end)) result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    return result + (cut ? "...'" : "'");
}

} // namespace weft
