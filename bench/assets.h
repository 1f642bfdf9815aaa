// The files that the benchmark scenes name: meshes, textures and a sky, made by formulas so that
// nothing need be fetched and every machine measures the same.
#pragma once

#include <string>

namespace weft::bench {

/// Writes all of them into `folder`, which is made where it is missing; about 80 MB.
void make_assets(std::string const& folder);

} // namespace weft::bench
