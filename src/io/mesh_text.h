// Scanning text for the mesh readers: numbers, places and quotations.
//
// Numbers are read by std::from_chars: no locale, correctly rounded. A sign '+' is allowed.
#pragma once

#include "base/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace weft::io {

/// The place of byte `offset` in `text`. Lines end with LF, CR LF or CR. Takes time in
/// proportion to `offset`: for errors only.
SourceLocation locate(std::string_view text, size_t offset, std::string const& name);

/// 'token' for a message: at most 40 bytes, what is not printable ASCII as \xNN.
std::string quoted(std::string_view token);

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// The number that starts at `p`; nullptr where there is none, else one past its last character.
/// A decimal too small for a float gives 0, one too large gives infinity.
char const* scan_float(char const* p, char const* end, float& value);
char const* scan_integer(char const* p, char const* end, int64_t& value);

/// The characters from `p` up to the next blank or line end.
std::string_view token_at(char const* p, char const* end);

} // namespace weft::io
