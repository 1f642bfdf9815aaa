// Random functions of place. Their random numbers are hashes of integer cells, so there is no
// period and no table.
#pragma once

#include "base/vec.h"

namespace weft::shading {

/// Gradient noise in about [-1, 1], 0 at whole coordinates: Perlin 2002, "Improving noise", with
/// MaterialX's scale.
float perlin_noise(Vec2 p);
float perlin_noise(Vec3 const& p);

/// A random number in [0, 1) for the cell of whole coordinates that holds p.
float cell_noise(Vec2 p);
float cell_noise(Vec3 const& p);

/// Distances to the nearest and the second nearest of random points, one in each cell at its
/// centre + jitter * [-1/2, 1/2]^n: Worley 1996, "A cellular texture basis function". Points
/// farther than the neighbouring cells are not looked for, so that the second may be too large.
struct WorleyDistances {
    float f1, f2;
};
WorleyDistances worley_noise(Vec2 p, float jitter);
WorleyDistances worley_noise(Vec3 const& p, float jitter);

} // namespace weft::shading
