#include "io/mesh_text.h"

#include <charconv>
#include <limits>

namespace weft::io {

SourceLocation locate(std::string_view text, size_t offset, std::string const& name) {
    int line = 1;
    size_t start = 0;
    for (size_t i = 0; i < offset && i < text.size(); ++i) {
        bool const pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (!is_line_end(text[i]) || pair) continue;
        ++line;
        start = i + 1;
    }
    return {name, line, int(offset - start) + 1};
}

std::string quoted(std::string_view token) {
    constexpr size_t kMost = 40;
    constexpr char kHex[] = "0123456789abcdef";
    std::string s = "'";
    for (char c : token.substr(0, kMost)) {
        auto const byte = static_cast<unsigned char>(c);
        if (byte >= 0x20 && byte < 0x7f)
            s += c;
        else
            s += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    }
    return s + (token.size() > kMost ? "...'" : "'");
}

namespace {

char const* skip_plus(char const* p, char const* end) {
    return end - p > 1 && p[0] == '+' && p[1] != '-' ? p + 1 : p;
}

/// The decimal exponent's sign tells underflow from overflow, as no file writes either without.
float out_of_range(char const* p, char const* end) {
    bool const tiny = std::string_view(p, size_t(end - p)).find("e-") != std::string_view::npos ||
                      std::string_view(p, size_t(end - p)).find("E-") != std::string_view::npos;
    float const magnitude = tiny ? 0 : std::numeric_limits<float>::infinity();
    return *p == '-' ? -magnitude : magnitude;
}

} // namespace

char const* scan_float(char const* p, char const* end, float& value) {
    p = skip_plus(p, end);
    auto const [after, error] = std::from_chars(p, end, value);
    if (error == std::errc::invalid_argument) return nullptr;
    if (error == std::errc::result_out_of_range) {
        // A double tells on which side the number leaves the range of floats.
        double wide = 0;
        bool const known = std::from_chars(p, end, wide).ec == std::errc();
        value = known ? float(wide) : out_of_range(p, after);
    }
    return after;
}

char const* scan_integer(char const* p, char const* end, int64_t& value) {
    p = skip_plus(p, end);
    auto const [after, error] = std::from_chars(p, end, value);
    return error == std::errc() ? after : nullptr;
}

std::string_view token_at(char const* p, char const* end) {
    char const* q = p;
    while (q < end && !is_blank(*q) && !is_line_end(*q)) ++q;
    return {p, size_t(q - p)};
}

} // namespace weft::io
