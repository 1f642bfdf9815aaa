// JSON with its places: every value read knows its path ("meshes[0].primitives[1].indices"), every
// mistake is told with it, and what nobody asked for is told in the end. JSON itself is
// nlohmann-json's business.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/color.h"
#include "base/error.h"

namespace weft::io::gltf {

using Json = nlohmann::json;

/// The file's name, and what of it could not be taken over.
class Report {
  public:
    explicit Report(std::string file) : file_(std::move(file)) {}

    SourceLocation at(std::string const& path) const {
        return {path.empty() ? file_ : file_ + ": " + path, 0, 0};
    }
    [[noreturn]] void fail(std::string const& path, std::string const& message) const {
        throw InputError(at(path), message);
    }
    /// Notes `message` about `path`. The same about another element of a list is only
    /// counted; about the same path again is not.
    void warn(std::string const& path, std::string const& message);
    /// One line per message, in the order in which they came up.
    std::vector<std::string> warnings() const;
    std::string const& file() const { return file_; }

  private:
    struct Note {
        std::string path, message;
        size_t count;
    };
    std::string file_;
    std::vector<Note> notes_;
    std::map<std::string, size_t> by_message_; ///< and path without its indices
    std::set<std::string> told_;               ///< paths and messages
};

/// An interval of numbers; what lies outside is moved to its end, with a warning.
struct Range {
    double min = -std::numeric_limits<float>::max(), max = std::numeric_limits<float>::max();
};
inline constexpr Range kUnit{0, 1};
inline constexpr Range kNotNegative{0};

/// A JSON object while it is read: `finish` tells the members that nobody took.
class Object {
  public:
    /// Throws InputError where `value` is no object.
    Object(Report& report, Json const& value, std::string path);

    std::string const& path() const { return path_; }
    std::string path_of(std::string_view key) const;
    Report& report() const { return *report_; }
    bool has(std::string_view key) const { return json_->contains(key); }

    /// The members; where absent, the fallback. A value of another type is an InputError.
    double number(std::string_view key, double fallback, Range range = {});
    /// A whole number of at least 0.
    std::optional<uint64_t> whole(std::string_view key);
    bool boolean(std::string_view key, bool fallback);
    std::string text(std::string_view key, std::string fallback = "");
    Color color(std::string_view key, Color const& fallback, Range range);
    /// Empty where absent. `size` is the number of elements that it must have; 0: any.
    std::vector<double> numbers(std::string_view key, size_t size = 0);
    /// Indices into the file's list `what`, of which it has `count`.
    std::optional<size_t> index(std::string_view key, size_t count, char const* what);
    std::vector<size_t> indices(std::string_view key, size_t count, char const* what);
    std::optional<Object> object(std::string_view key);
    std::vector<Object> objects(std::string_view key);
    /// The object below "extensions".
    std::optional<Object> extension(std::string_view name);

    /// The member names; for objects whose keys are data.
    std::vector<std::string> keys() const;
    /// Takes a member without looking at it.
    void ignore(std::string_view key) { taken_.emplace(key); }
    /// Warns of every member and extension that nobody took; "name" and "extras" need no taker.
    void finish();

  private:
    Json const* take(std::string_view key);
    [[noreturn]] void wrong_type(std::string_view key, char const* expected,
                                 Json const& found) const;
    size_t to_index(Json const& value, std::string const& path, size_t count,
                    char const* what) const;

    Report* report_;
    Json const* json_;
    std::string path_;
    std::set<std::string, std::less<>> taken_, taken_extensions_;
};

/// "an object", "the text 'x'", "7": a value for a message.
std::string describe(Json const& value);

/// Parses JSON text. Throws InputError with line and column of `name` for text that is malformed,
/// whose numbers overflow, or that nests deeper than any glTF file does.
Json parse_json(std::string_view text, std::string const& name);

} // namespace weft::io::gltf
