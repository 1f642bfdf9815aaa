#include "session/tiles.h"

#include <algorithm>
#include <fmt/format.h>

namespace weft::session {

std::string to_string(Part const& part) {
    if (part.is_whole()) return "the whole picture";
    std::string const shard =
        part.shards > 1 ? fmt::format("shard {}/{}", part.shard, part.shards) : "";
    if (part.first == 0 && part.last == 0) return shard;
    std::string const samples = fmt::format("samples {}:{}", part.first, part.last);
    return shard.empty() ? samples : shard + " of " + samples;
}

std::vector<film::Region> make_tiles(film::Region const& region, int size) {
    return make_tiles(region, size, {});
}

std::vector<film::Region> make_tiles(film::Region const& region, int size, Part const& part) {
    std::vector<film::Region> tiles;
    int number = 0;
    for (int y = region.from.y; y < region.to.y; y += size)
        for (int x = region.from.x; x < region.to.x; x += size)
            if (number++ % part.shards == part.shard - 1)
                tiles.push_back(
                    {{x, y}, {std::min(x + size, region.to.x), std::min(y + size, region.to.y)}});
    return tiles;
}

} // namespace weft::session
