// The picture cut into tiles, and the part of a picture that one render makes: every N-th tile, a
// range of the samples, or both.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "film/film.h"

namespace weft::session {

/// Tiles K, K + N, K + 2N, ... of a picture (K from 1), and of each pixel the samples
/// [first, last); `last` 0 is all.
struct Part {
    int shard = 1, shards = 1;
    uint32_t first = 0, last = 0;

    bool is_whole() const { return shards == 1 && first == 0 && last == 0; }
    friend bool operator==(Part const&, Part const&) = default;
};

/// Returns "shard 2/4", "samples 0:32", "shard 2/4 of samples 0:32", or "the whole picture".
std::string to_string(Part const& part);

/// Cuts a region into tiles of `size` pixels, row by row. Those at the right and lower edge may be
/// smaller.
std::vector<film::Region> make_tiles(film::Region const& region, int size);

/// Returns those tiles that are of `part`.
std::vector<film::Region> make_tiles(film::Region const& region, int size, Part const& part);

} // namespace weft::session
