// The dialects of the scene format: what other programs that write it call otherwise, declared
// beside what it is called here. The reader rewrites a file by these rules before it looks at any
// parameter (io/modernise.h), so nobody else knows of them; help and reference pages list them, and
// `weft convert` writes what comes of them.
//
// Most of them are spellings of lightwave, the course renderer, and of its students' teams.
#pragma once

#include <array>
#include <concepts>
#include <string>
#include <string_view>

#include "schema/element.h"

namespace weft::schema {

/// What a parameter's text means today, where it is measured otherwise; nothing where the text is
/// none that the dialect could mean.
using ConvertText = std::optional<std::string> (*)(std::string_view text);

/// Another name of a parameter, in its `Attr`.
struct Alias {
    std::string_view name;
    std::string_view note = {}; ///< what one must know beyond today's name; no full stop
    ConvertText convert = nullptr;

    constexpr Alias() = default;
    constexpr Alias(char const* n) : name(n) {}
    constexpr Alias(std::string_view n, std::string_view about, ConvertText c = nullptr)
        : name(n), note(about), convert(c) {}
};

/// The other names of one parameter: `.aliases = {"radius", "aperture"}`.
class Aliases {
  public:
    static constexpr size_t kMost = 4;
    constexpr Aliases() = default;
    template <std::convertible_to<Alias>... A>
    constexpr Aliases(A... aliases) : items_{Alias(aliases)...}, count_(sizeof...(A)) {
        static_assert(sizeof...(A) <= kMost);
    }
    constexpr Alias const* begin() const { return items_.data(); }
    constexpr Alias const* end() const { return items_.data() + count_; }

  private:
    std::array<Alias, kMost> items_{};
    size_t count_ = 0;
};

/// What a rewriting rule may ask beyond its element.
class Surroundings {
  public:
    virtual ~Surroundings() = default;
    /// What a `<ref>` refers to, if there is exactly one such element; any other element is
    /// returned as it is. Null where nothing has that id.
    virtual Element* resolve(Element& element) const = 0;
    /// How much longer lengths become by the `transform` of an instance; nothing where that depends
    /// on their direction. Throws InputError for a transform that cannot be read.
    virtual std::optional<double> scale_of(Element& instance) const = 0;
};

/// Makes an object mean today what its dialect meant. Returns whether there was anything to do.
using Rewrite = bool (*)(Element&, Surroundings const&);

/// Another spelling of the objects of a type, in its `TypeInfo`: what takes more than another name
/// of one parameter. It applies to elements of this `type` ("": that of the TypeInfo itself) that
/// have this `parameter` ("": whatever they have).
struct Spelling {
    std::string_view type = {}, parameter = {};
    std::string_view today; ///< what it is today, as in "'depth' of <...> ..."; no full stop
    /// Null: the element gets today's type and loses the parameter, which nothing here listens to.
    Rewrite rewrite = nullptr;
};

/// `type="normals"` or `nee`: how help and reference pages show a spelling.
std::string spelling_text(Spelling const& spelling);
/// "is called `lensRadius` today: ..."
std::string alias_text(Alias const& alias, std::string_view today);

} // namespace weft::schema
