// Sampling the light of a lat-long environment map in proportion to its brightness.
//
// The sphere is cut into width x height cells of the lat-long square (lat_long.h); a cell is
// chosen in proportion to the brightness given for it times its solid angle, and a direction
// uniformly in solid angle inside it. The density is thus constant over a cell and bounded at the
// poles, where a density that is constant in uv would grow as 1 / sin theta.
#pragma once

#include <span>

#include "base/distribution.h"
#include "lights/lat_long.h"

namespace weft::lights {

class EnvironmentSampler {
  public:
    struct Sample {
        Vec2 uv;        ///< lat-long coordinates of the direction
        Vec3 direction; ///< unit, towards the light, in the map's own space
        float pdf;      ///< per solid angle
    };

    /// `luminance`: one value per cell, row by row from v = 0 (+y), from u = 0. A value that is
    /// not positive and finite counts as 0. It must be positive wherever the map, as it is
    /// filtered when looked up, is not black in the cell: give the mean or maximum over the
    /// footprint of the filter. A map of only 0 is sampled over all directions.
    EnvironmentSampler(std::span<float const> luminance, uint32_t width, uint32_t height);

    Sample sample(Vec2 u) const;
    /// Per solid angle, of the unit direction `d` in the map's own space.
    float pdf(Vec3 const& d) const;
    /// The integral of the luminance over the sphere of directions.
    float total() const { return cells_.total(); }

  private:
    float density(float uv_density, uint32_t row) const;

    Distribution2D cells_;
    /// sin^2(theta / 2) at the upper edges of the rows, and one more: height + 1 values. Measured
    /// from the nearer pole it has digits at both.
    std::vector<float> haversine_;
    std::vector<float> band_; ///< cos theta at the upper edge less that at the lower, per row
    uint32_t height_;
};

} // namespace weft::lights
