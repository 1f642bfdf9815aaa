// Whether geometries enclose a space.
#pragma once

#include "world/geometry.h"

namespace weft::world {

struct Solidity {
    size_t edges = 0, open_edges = 0; ///< open: an odd number of faces has them
    bool inwards = false;             ///< closed, with its normals pointing to its inside
    bool has_parts = false;           ///< of several shells, or of some that touch in an edge
};

/// Looks at all edges of a mesh; vertices at the same position, but for rounding, are one.
Solidity solidity(TriangleMesh const& mesh);
inline Solidity solidity(Sphere const&) { return {}; }
/// Its rim counts as one edge.
inline Solidity solidity(Disk const&) { return {1, 1}; }

} // namespace weft::world
