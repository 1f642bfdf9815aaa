// The named sets of instances that lights link to, as bits.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "world/light_rules.h"

namespace weft::world {

class SetNames {
  public:
    /// The sets of an instance, "hero cast": names apart by blanks. Throws InputError for more than
    /// 64 different ones in a scene.
    uint64_t declare(std::string const& names, SourceLocation const& where);
    /// What a light says of sets: "-name" excepts one. Throws InputError for a name that no
    /// instance has, with the nearest; `parameter` is whose value `names` is.
    Links find(std::string const& names, std::string const& parameter,
               SourceLocation const& where) const;

  private:
    std::vector<std::string> names_;
};

} // namespace weft::world
