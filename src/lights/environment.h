// Sampling the light of a lat-long environment map in proportion to its brightness.
//
// The sphere is cut into cells of the lat-long square (lat_long.h). One is chosen in proportion to
// its mean brightness times its solid angle; within it the density is bilinear in u and in the
// cosine of theta, between the brightness at its corners. So a bilinear texture is sampled as it is
// looked up: cells lie between the centres of its texels, their corners are texels, and no light
// that the filter spreads over the border of a texel is missed or weighs more there.
//
// Where light sampling is combined with BSDF sampling, it need not find what that finds well
// already: `compensated` samples max(f - mean, 0) instead of f (Karlik, Sik, Vevoda, Skrivan and
// Krivanek 2019, "MIS Compensation: Optimizing Sampling Techniques in Multiple Importance
// Sampling", 5.1, for two strategies of one sample each). Nothing then samples what is darker than
// the mean but BSDFs, so this is not for light sampling alone.
//
// Left out: the product with the BSDF or the cosine. Random numbers have 24 bits, and so have the
// probabilities of cells: what is a 10^7th of a row's light is not sampled.
#pragma once

#include <span>

#include "base/distribution.h"
#include "base/lat_long.h"

namespace weft::lights {

/// How bright the sphere is, on a grid over the lat-long square.
struct EnvironmentGrid {
    /// Values at the centres of texels and bilinear between them, around u = 0 as well; or
    /// constant over texels.
    enum class Filter { bilinear, nearest };

    Filter filter = Filter::nearest;
    uint32_t width = 1, height = 1; ///< texels
    /// Row by row from v = 0 (+y), from u = 0. Where bilinear, a first and a last row more, for the
    /// poles. A value that is not positive and finite counts as 0.
    std::vector<float> values;

    uint32_t rows() const { return filter == Filter::bilinear ? height + 2 : height; }
    /// Where the values of column x and row y belong.
    Vec2 uv(uint32_t x, uint32_t y) const;
};

class EnvironmentSampler {
  public:
    struct Sample {
        Vec2 uv;        ///< lat-long coordinates of the direction
        Vec3 direction; ///< unit, towards the light, in the map's own space
        float pdf;      ///< per solid angle
    };

    /// The values of `grid` must be such that whatever is not black lies in a cell with a corner
    /// that is not. A grid of only 0 is sampled over all directions.
    explicit EnvironmentSampler(EnvironmentGrid grid, bool compensated = false);

    Sample sample(Vec2 u) const;
    /// Per solid angle, of the unit direction `d` in the map's own space.
    float pdf(Vec3 const& d) const;
    /// The integral of the brightness over the sphere of directions, as it was given.
    float total() const { return total_; }
    uint32_t columns() const { return grid_.width; }

  private:
    using Corners = float[4];
    void corners(uint32_t x, uint32_t y, Corners& c) const;
    float solid_angle(uint32_t row) const;
    float density(float probability, uint32_t row, Corners const& c, Vec2 place) const;
    /// Gives every cell its weight; their sum.
    double weigh();

    EnvironmentGrid grid_;
    Distribution2D cells_;
    /// sin^2(theta / 2) at the upper edges of the rows of cells, and one more. Measured from the
    /// nearer pole it has digits at both.
    std::vector<float> haversine_;
    std::vector<float> band_; ///< cos theta at the upper edge less that at the lower, per row
    uint32_t rows_;           ///< of cells
    float total_ = 0;
};

} // namespace weft::lights
