#include "world/set_names.h"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace weft::world {

namespace {

std::vector<std::string> split(std::string const& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

} // namespace

uint64_t SetNames::declare(std::string const& names, SourceLocation const& where) {
    if (names.empty()) return 0;
    uint64_t bits = 0;
    for (std::string const& name : split(names)) {
        if (name[0] == '-')
            throw InputError(where, "'sets' expects names that do not start with '-', found '" +
                                        name + "'");
        auto it = std::find(names_.begin(), names_.end(), name);
        if (it == names_.end()) {
            if (names_.size() == 64)
                throw InputError(where, "expected at most 64 sets of instances, found another: '" +
                                            name + "'");
            it = names_.insert(names_.end(), name);
        }
        bits |= uint64_t(1) << (it - names_.begin());
    }
    return bits;
}

Links SetNames::find(std::string const& names, std::string const& parameter,
                     SourceLocation const& where) const {
    Links links;
    for (std::string name : split(names)) {
        bool const except = name[0] == '-';
        if (except) name.erase(0, 1);
        auto const it = std::find(names_.begin(), names_.end(), name);
        if (it == names_.end())
            throw InputError(
                where, "'" + parameter + "' expects sets that instances name in " +
                           "'sets', found '" + name + "'" +
                           (names_.empty() ? ": no instance names any" : suggestion(name, names_)));
        (except ? links.exclude : links.include) |= uint64_t(1) << (it - names_.begin());
    }
    return links;
}

} // namespace weft::world
