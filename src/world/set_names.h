// The named sets of instances that lights link to, as bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"

namespace weft::world {

/// Of named sets, as bits: those that are meant and those that are excepted.
struct Links {
    uint64_t include = 0, exclude = 0; ///< include 0: all

    friend bool operator==(Links const&, Links const&) = default;
    explicit operator bool() const { return (include | exclude) != 0; }
    bool accept(uint64_t sets) const {
        return (include == 0 || (include & sets) != 0) && (exclude & sets) == 0;
    }
};

class SetNames {
  public:
    /// The sets of an instance, "hero cast": names apart by blanks. Throws InputError for more than
    /// 64 different ones in a scene.
    uint64_t declare(std::string const& names, SourceLocation const& where);
    /// Reads what a light says of sets: "-name" excepts one. Throws InputError for a name that no
    /// instance has, with the nearest; `parameter` is whose value `names` is.
    Links find(std::string const& names, std::string const& parameter,
               SourceLocation const& where) const;

  private:
    std::vector<std::string> names_;
};

} // namespace weft::world
