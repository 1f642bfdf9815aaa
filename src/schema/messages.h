// What messages say about parameters, so that all who refuse a value say it alike.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "schema/text.h"

namespace weft::schema {

/// Returns whether every number of a value lies in the parameter's range.
inline bool in_range(double v, Attr const& attr) { return v >= attr.min && v <= attr.max; }
inline bool in_range(Color const& c, Attr const& attr) {
    return in_range(c.r, attr) && in_range(c.g, attr) && in_range(c.b, attr);
}
inline bool in_range(Vec3 const& v, Attr const& attr) {
    return in_range(v.x, attr) && in_range(v.y, attr) && in_range(v.z, attr);
}
inline bool in_range(Vec2 const& v, Attr const& attr) {
    return in_range(v.x, attr) && in_range(v.y, attr);
}
inline bool in_range(AnyValue const& a, Attr const& attr) { return in_range(a.v, attr); }
template <class T>
bool in_range(Input<T> const& v, Attr const& attr) {
    return in_range(v.value, attr);
}

/// "at least 0 and at most 1"
inline std::string range_phrase(Attr const& attr) {
    std::string const low = "at least " + number_text(attr.min);
    std::string const high = "at most " + number_text(attr.max);
    if (!std::isfinite(attr.max)) return low;
    return std::isfinite(attr.min) ? low + " and " + high : high;
}

/// Returns what a parameter not given should have been: "'fov' (float)", or "an <instance>" where a
/// child tag of this category fills it.
inline std::string missing_phrase(std::string_view name, std::string_view kind,
                                  std::string_view category) {
    if (category.empty()) return "'" + std::string(name) + "' (" + std::string(kind) + ")";
    bool const vowel = category.front() == 'i' || category.front() == 'e';
    return (vowel ? "an <" : "a <") + std::string(category) + ">";
}

} // namespace weft::schema
