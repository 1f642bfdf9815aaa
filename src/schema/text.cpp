#include "schema/text.h"

#include <charconv>
#include <cmath>

namespace weft::schema {

namespace {

template <class T>
std::string shortest(T value) {
    char buffer[64];
    auto const end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return {buffer, end};
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string_view trimmed(std::string_view s) {
    while (!s.empty() && is_space(s.front())) s.remove_prefix(1);
    while (!s.empty() && is_space(s.back())) s.remove_suffix(1);
    return s;
}

/// Whether a double rounds to a finite float: from half a step beyond the largest on it does not.
bool fits_float(double v) { return std::abs(v) < 0x1.ffffffp127; }

} // namespace

std::string number_text(float value) { return shortest(value); }
std::string number_text(double value) { return shortest(value); }

std::string xml_text(std::string_view text) {
    std::string result;
    for (char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '"')
            result += "&quot;";
        else if (static_cast<unsigned char>(c) < 32)
            result += "&#" + std::to_string(int(c)) + ";";
        else
            result += c;
    }
    return result;
}

std::string numbers_text(std::span<float const> values) {
    std::string text;
    for (float v : values) text += (text.empty() ? "" : ",") + number_text(v);
    return text;
}

std::optional<std::vector<double>> read_numbers(std::string_view text) {
    std::vector<double> values;
    text = trimmed(text);
    while (!text.empty()) {
        if (text.front() == '+' && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
        double value = 0;
        auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || !std::isfinite(value)) return {};
        values.push_back(value);
        std::string_view const rest(end, size_t(text.data() + text.size() - end));
        text = trimmed(rest);
        if (text.empty()) break;
        bool const comma = text.front() == ',';
        if (!comma && text.size() == rest.size()) return {}; // "1.5abc"
        if (comma) text = trimmed(text.substr(1));
        if (text.empty()) return {}; // a comma with nothing behind it
    }
    return values;
}

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    for (text = trimmed(text); !text.empty();) {
        size_t end = 0;
        while (end < text.size() && text[end] != ',' && !is_space(text[end])) ++end;
        words.push_back(text.substr(0, end));
        text = trimmed(text.substr(end));
        if (text.empty() || text.front() != ',') continue;
        text = trimmed(text.substr(1));
        if (text.empty()) words.push_back(text); // a comma with nothing behind it
    }
    return words;
}

std::optional<std::vector<double>> read_components(std::string_view text, int count) {
    auto values = read_numbers(text);
    if (!values) return {};
    if (values->size() == 1) values->resize(size_t(count), values->front());
    if (values->size() != size_t(count)) return {};
    for (double v : *values)
        if (!fits_float(v)) return {};
    return values;
}

bool TextForm<int>::read(std::string_view text, int& v) {
    text = trimmed(text);
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    int value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return false;
    v = value;
    return true;
}

bool TextForm<float>::read(std::string_view text, float& v) {
    auto const values = read_components(text, 1);
    if (!values) return false;
    v = float(values->front());
    return true;
}

std::string TextForm<Color>::write(Color const& v) {
    if (v.r == v.g && v.g == v.b) return number_text(v.r);
    return numbers_text(std::array{v.r, v.g, v.b});
}

bool TextForm<Color>::read(std::string_view text, Color& v) {
    auto const c = read_components(text, 3);
    if (!c) return false;
    v = {float((*c)[0]), float((*c)[1]), float((*c)[2])};
    return true;
}

std::string TextForm<Vec3>::write(Vec3 const& v) { return numbers_text(std::array{v.x, v.y, v.z}); }

bool TextForm<Vec3>::read(std::string_view text, Vec3& v) {
    auto const c = read_components(text, 3);
    if (!c) return false;
    v = {float((*c)[0]), float((*c)[1]), float((*c)[2])};
    return true;
}

std::string TextForm<Vec2>::write(Vec2 const& v) { return numbers_text(std::array{v.x, v.y}); }

bool TextForm<Vec2>::read(std::string_view text, Vec2& v) {
    auto const c = read_components(text, 2);
    if (!c) return false;
    v = {float((*c)[0]), float((*c)[1])};
    return true;
}

std::string TextForm<AnyValue>::write(AnyValue const& a) {
    return numbers_text(std::span(&a.v.x, size_t(a.count)));
}

bool TextForm<AnyValue>::read(std::string_view text, AnyValue& a) {
    auto const numbers = read_numbers(text);
    if (!numbers || numbers->empty() || numbers->size() > 3) return false;
    auto const c = read_components(text, int(numbers->size()));
    if (!c) return false;
    a.count = int(c->size());
    auto at = [&](size_t i) { return i < c->size() ? float((*c)[i]) : 0.f; };
    a.v = a.count == 1 ? Vec3(at(0)) : Vec3(at(0), at(1), at(2));
    return true;
}

std::string TextForm<ColorStops>::write(ColorStops const& v) {
    std::string text;
    for (ColorStop const& s : v.stops)
        text += (text.empty() ? "" : "; ") + number_text(s.position) + ": " +
                TextForm<Color>::write(s.color);
    return text;
}

bool TextForm<ColorStops>::read(std::string_view text, ColorStops& v) {
    std::vector<ColorStop> stops;
    while (true) {
        size_t const end = text.find(';');
        std::string_view const one = text.substr(0, end);
        size_t const colon = one.find(':');
        if (colon == std::string_view::npos) return false;
        ColorStop stop;
        if (!TextForm<float>::read(one.substr(0, colon), stop.position) ||
            !TextForm<Color>::read(one.substr(colon + 1), stop.color))
            return false;
        if (!stops.empty() && !(stop.position > stops.back().position)) return false;
        stops.push_back(stop);
        if (end == std::string_view::npos) break;
        text.remove_prefix(end + 1);
        if (trimmed(text).empty()) break; // a semicolon at the end
    }
    v.stops = std::move(stops);
    return true;
}

std::string TextForm<Affined>::write(Affined const& m) {
    if (m == Affined()) return "";
    std::string text;
    for (int row = 0; row < 3; ++row)
        for (Vec3d const& column : {m.x, m.y, m.z, m.origin})
            text += number_text(column[row]) + ",";
    return text + "0,0,0,1";
}

bool TextForm<Affined>::read(std::string_view text, Affined& m) {
    auto const read = read_numbers(text);
    if (!read || read->size() != 16) return false;
    auto const& v = *read;
    if (v[12] != 0 || v[13] != 0 || v[14] != 0 || v[15] == 0) return false; // a projection
    auto column = [&](int c) {
        return Vec3d(v[size_t(c)], v[size_t(4 + c)], v[size_t(8 + c)]) / v[15];
    };
    m = {column(0), column(1), column(2), column(3)};
    return true;
}

} // namespace weft::schema
