// The half of the lints that is about what objects enclose.
#include <fmt/format.h>
#include <map>
#include <set>

#include "base/match.h"
#include "lights/lints.h"
#include "world/solidity.h"

namespace weft::lights {

namespace {

/// Returns what is wrong with an object that has an inside; "" if nothing.
std::string complaint(world::Model const& m) {
    world::Solidity const s = match(m.geometry, [](auto const& g) { return world::solidity(g); });
    bool const glass = !m.is_null;
    char const* const what = glass ? "lets light in" : "has a medium";
    if (s.open_edges > 0)
        return fmt::format(
            "{} but does not enclose a space: {} of its {} edges are open (an odd "
            "number of faces has them), and what comes in there or gets out is lost "
            "track of; close the mesh{}",
            what, s.open_edges, s.edges,
            glass ? ", or say thinWalled=\"true\" in the bsdf of what is a mere sheet" : "");
    if (s.inwards)
        return fmt::format("{} but its normals point inwards, so that its inside is outside; turn "
                           "its faces around",
                           what);
    if (m.has_alpha && glass)
        return fmt::format("{} and is partly transparent (alpha): what comes in by a hole and "
                           "out by the glass, or the other way, is lost track of; use a <bsdf "
                           "type=\"mix\"> of the glass and `transparent`",
                           what);
    return {};
}

} // namespace

std::vector<std::string> solid_warnings(world::World const& world) {
    std::vector<std::string> warnings;
    std::map<world::Model const*, std::string> known;
    std::set<std::string> said;
    for (uint32_t i = 0; i < world.object_count(); ++i) {
        world::Model const& m = world.model(i);
        if (!m.has_interior) continue;
        auto const [it, fresh] = known.emplace(&m, std::string());
        if (fresh) it->second = complaint(m);
        if (it->second.empty()) continue;
        scene::InstanceId const instance{world.object(i).source_instance};
        std::string const name(scene::name_of(world.scene(), instance));
        std::string text = to_string(location_of(world.scene(), instance)) + ": " +
                           (name.empty() ? "" : "'" + name + "' ") + it->second;
        if (said.insert(text).second) warnings.push_back(std::move(text));
    }
    return warnings;
}

} // namespace weft::lights
