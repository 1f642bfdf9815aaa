// Meshes written as binary PLY files.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/vec.h"

namespace weft::bench {

/// The surface p(u, v) over the unit square as columns * rows * 2 triangles with normals and uvs.
/// Its front is where dp/du x dp/dv points. Throws std::runtime_error where the file cannot be
/// written.
void write_grid(std::string const& path, uint32_t columns, uint32_t rows, Vec3 (*p)(Vec2));

/// Single quadrilaterals without normals or uvs. Throws like `write_grid`.
void write_quads(std::string const& path, std::vector<std::array<Vec3, 4>> const& quads);

} // namespace weft::bench
