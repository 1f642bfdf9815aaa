// User errors: what was expected, what was found, and where (file:line:column).
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/shared_text.h"

namespace weft {

/// A place in a user's file. `line` and `column` count from 1; 0 where there is none (a binary
/// file, or the file as a whole).
struct SourceLocation {
    SharedText file;
    int line = 0;
    int column = 0;
};

/// "file:line:column", without the parts that are 0.
std::string to_string(SourceLocation const& where);

/// Something the user gave is wrong. `what()` is the whole message, location first. The command
/// line turns it into exit code 2. Thrown while loading, never while rendering.
class InputError : public std::runtime_error {
  public:
    explicit InputError(std::string const& message) : std::runtime_error(message) {}
    InputError(SourceLocation const& where, std::string const& message)
        : std::runtime_error(to_string(where) + ": " + message) {}
};

/// 'text' for a message: on one line, in quotes, cut where it is long.
std::string in_quotes(std::string_view text);

/// The candidate nearest to `name` by edit distance (case ignored), or "" where none is near
/// enough to be meant (further than a third of the length, at least 2 edits).
std::string nearest_name(std::string_view name, std::span<std::string const> candidates);

/// " (did you mean 'x'?)" or, where nothing is near, "; known: a, b, c" with at most 20 names.
std::string suggestion(std::string_view name, std::span<std::string const> candidates);

} // namespace weft
