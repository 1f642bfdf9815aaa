#include "io/gltf_json.h"

#include <cmath>

#include "base/error.h"
#include "io/mesh_text.h"
#include "schema/text.h"

namespace weft::io::gltf {

void Report::warn(std::string const& path, std::string const& message) {
    if (!told_.insert(path + "\n" + message).second) return;
    std::string place = path; // whatever the indices
    std::erase_if(place, [](char c) { return c >= '0' && c <= '9'; });
    auto const [it, fresh] = by_message_.emplace(place + "\n" + message, notes_.size());
    if (fresh)
        notes_.push_back({path, message, 1});
    else
        ++notes_[it->second].count;
}

std::vector<std::string> Report::warnings() const {
    std::vector<std::string> lines;
    for (Note const& n : notes_) {
        std::string more;
        if (n.count > 1)
            more = " (and at " + std::to_string(n.count - 1) + " more place" +
                   (n.count > 2 ? "s)" : ")");
        lines.push_back(to_string(at(n.path)) + ": " + n.message + more);
    }
    return lines;
}

std::string describe(Json const& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    if (value.is_string()) return in_quotes(value.get_ref<std::string const&>());
    return value.dump();
}

namespace {

std::string element(std::string const& path, size_t i) {
    return path + "[" + std::to_string(i) + "]";
}

std::optional<uint64_t> as_whole(Json const& value) {
    if (value.is_number_unsigned()) return value.get<uint64_t>();
    if (!value.is_number_float()) return {};
    double const x = value.get<double>();
    if (!(x >= 0 && x < 0x1p53 && x == std::floor(x))) return {};
    return uint64_t(x);
}

} // namespace

Object::Object(Report& report, Json const& value, std::string path)
    : report_(&report), json_(&value), path_(std::move(path)) {
    if (!value.is_object()) report.fail(path_, "expected an object, found " + describe(value));
}

std::string Object::path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

Json const* Object::take(std::string_view key) {
    taken_.emplace(key);
    auto const it = json_->find(key);
    return it == json_->end() ? nullptr : &*it;
}

void Object::wrong_type(std::string_view key, char const* expected, Json const& found) const {
    report_->fail(path_of(key), std::string("expected ") + expected + ", found " + describe(found));
}

double Object::number(std::string_view key, double fallback, Range range) {
    Json const* const value = take(key);
    if (!value) return fallback;
    if (!value->is_number()) wrong_type(key, "a number", *value);
    double const x = value->get<double>();
    double const inside = std::min(std::max(x, range.min), range.max);
    if (x != inside)
        report_->warn(path_of(key), "expected a number from " + schema::number_text(range.min) +
                                        " to " + schema::number_text(range.max) + ", found " +
                                        describe(*value) + ", read as the nearest of them");
    return inside;
}

std::optional<uint64_t> Object::whole(std::string_view key) {
    Json const* const value = take(key);
    if (!value) return {};
    auto const n = as_whole(*value);
    if (!n) wrong_type(key, "a whole number of at least 0", *value);
    return n;
}

bool Object::boolean(std::string_view key, bool fallback) {
    Json const* const value = take(key);
    if (!value) return fallback;
    if (!value->is_boolean()) wrong_type(key, "true or false", *value);
    return value->get<bool>();
}

std::string Object::text(std::string_view key, std::string fallback) {
    Json const* const value = take(key);
    if (!value) return fallback;
    if (!value->is_string()) wrong_type(key, "a text", *value);
    return value->get<std::string>();
}

std::vector<double> Object::numbers(std::string_view key, size_t size) {
    Json const* const value = take(key);
    if (!value) return {};
    std::string const expected = size ? "an array of " + std::to_string(size) + " numbers"
                                      : std::string("an array of numbers");
    if (!value->is_array() || (size && value->size() != size))
        wrong_type(key, expected.c_str(), *value);
    std::vector<double> numbers;
    for (Json const& x : *value) {
        if (!x.is_number()) {
            std::string const path = element(path_of(key), numbers.size());
            report_->fail(path, "expected a number, found " + describe(x));
        }
        numbers.push_back(x.get<double>());
        if (!std::isfinite(float(numbers.back())))
            report_->fail(element(path_of(key), numbers.size() - 1),
                          "expected a number that a float can hold, found " + describe(x));
    }
    return numbers;
}

Color Object::color(std::string_view key, Color const& fallback, Range range) {
    auto const v = numbers(key, 3);
    if (v.empty()) return fallback;
    auto clamped = [&](double x) { return float(std::min(std::max(x, range.min), range.max)); };
    Color const c(clamped(v[0]), clamped(v[1]), clamped(v[2]));
    if (c != Color(float(v[0]), float(v[1]), float(v[2])))
        report_->warn(path_of(key), "expected numbers from " + schema::number_text(range.min) +
                                        " to " + schema::number_text(range.max) +
                                        "; those outside are read as the nearest of them");
    return c;
}

size_t Object::to_index(Json const& value, std::string const& path, size_t count,
                        char const* what) const {
    auto const n = as_whole(value);
    if (n && *n < count) return size_t(*n);
    std::string const range =
        count == 0 ? std::string("; the file has none") : " from 0 to " + std::to_string(count - 1);
    report_->fail(path, std::string("expected an index into '") + what + "'" +
                            (count == 0 ? "" : range) + ", found " + describe(value) +
                            (count == 0 ? range : ""));
}

std::optional<size_t> Object::index(std::string_view key, size_t count, char const* what) {
    Json const* const value = take(key);
    if (!value) return {};
    return to_index(*value, path_of(key), count, what);
}

std::vector<size_t> Object::indices(std::string_view key, size_t count, char const* what) {
    Json const* const value = take(key);
    if (!value) return {};
    if (!value->is_array()) wrong_type(key, "an array of indices", *value);
    std::vector<size_t> list;
    for (Json const& i : *value)
        list.push_back(to_index(i, element(path_of(key), list.size()), count, what));
    return list;
}

std::optional<Object> Object::object(std::string_view key) {
    Json const* const value = take(key);
    if (!value) return {};
    return Object(*report_, *value, path_of(key));
}

std::vector<Object> Object::objects(std::string_view key) {
    Json const* const value = take(key);
    std::vector<Object> list;
    if (!value) return list;
    if (!value->is_array()) wrong_type(key, "an array of objects", *value);
    for (Json const& o : *value) list.emplace_back(*report_, o, element(path_of(key), list.size()));
    return list;
}

std::optional<Object> Object::extension(std::string_view name) {
    auto const all = json_->find("extensions");
    if (all == json_->end()) return {};
    taken_extensions_.emplace(name);
    return Object(*report_, *all, path_of("extensions")).object(name);
}

std::vector<std::string> Object::keys() const {
    std::vector<std::string> names;
    for (auto const& [key, value] : json_->items()) names.push_back(key);
    return names;
}

void Object::finish() {
    for (auto const& [key, value] : json_->items()) {
        if (key == "name" || key == "extras" || taken_.contains(key)) continue;
        if (key != "extensions") {
            std::string const shown = in_quotes(key);
            report_->warn(path_of(shown.substr(1, shown.size() - 2)), "is not known and left out");
            continue;
        }
        for (std::string const& name : Object(*report_, value, path_of(key)).keys())
            if (!taken_extensions_.contains(name))
                report_->warn(path_of(key), "the extension " + in_quotes(name) +
                                                " is not supported here and left out");
    }
}

Json parse_json(std::string_view text, std::string const& name) {
    constexpr int kDeepest = 100;
    auto limit_depth = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > kDeepest)
            throw InputError({name}, "expected JSON nested at most " + std::to_string(kDeepest) +
                                         " deep, found more");
        return true;
    };
    auto reason = [](char const* what) {
        // "[json.exception.parse_error.101] parse error at line 1, column 5: reason"
        std::string_view s = what;
        if (size_t const end = s.find("] "); end != s.npos) s.remove_prefix(end + 2);
        if (s.starts_with("parse error at"))
            if (size_t const end = s.find(": "); end != s.npos) s.remove_prefix(end + 2);
        std::string const q = in_quotes(s);
        return "malformed JSON: " + q.substr(1, q.size() - 2);
    };
    try {
        return Json::parse(text.begin(), text.end(), limit_depth);
    } catch (Json::parse_error const& e) {
        throw InputError(locate(text, e.byte > 0 ? e.byte - 1 : 0, name), reason(e.what()));
    } catch (Json::exception const& e) {
        throw InputError({name}, reason(e.what()));
    }
}

} // namespace weft::io::gltf
