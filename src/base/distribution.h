// Piecewise constant distributions, sampled by inverting their cumulative sums (which, unlike
// alias tables, keeps the stratification of the random number).
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"

namespace weft {

/// A density over [0, 1) from n >= 1 non-negative weights; all-zero weights give the uniform one.
class Distribution1D {
  public:
    struct Sample {
        float x;      ///< in [0, 1)
        float pdf;    ///< density at x
        uint32_t bin; ///< floor(x n)
    };
    struct Choice {
        uint32_t index;
        float probability;
        float u; ///< the random number, stretched back to [0, 1) for use again
    };

    Distribution1D() = default;
    explicit Distribution1D(std::span<float const> weights);

    uint32_t size() const { return uint32_t(cdf_.size()) - 1; }
    float total() const { return total_; } ///< the sum of the weights
    Sample sample(float u) const;
    Choice choose(float u) const;
    float probability(uint32_t index) const { return cdf_[index + 1] - cdf_[index]; }

  private:
    uint32_t find(float u) const;

    std::vector<float> cdf_; ///< n + 1 values from 0 to 1
    /// Where the search for u begins (Chen and Asau 1974): for a power of two of equal parts of
    /// [0, 1], the bin at the beginning of each, and at the end of the last.
    std::vector<uint32_t> guide_;
    float total_ = 0;
};

/// A density over [0, 1)^2 from `width` x `height` weights, row by row: p(y) p(x | y).
class Distribution2D {
  public:
    struct Sample {
        Vec2 p;
        float pdf; ///< density over the unit square
    };
    struct Choice {
        uint32_t x, y;
        float probability;
        Vec2 u; ///< the random numbers, stretched back to [0, 1) for use again
    };

    Distribution2D() = default;
    Distribution2D(std::span<float const> weights, uint32_t width, uint32_t height);

    Sample sample(Vec2 u) const;
    float pdf(Vec2 p) const;
    Choice choose(Vec2 u) const;
    /// Of `choose`, column x and row y.
    float probability(uint32_t x, uint32_t y) const {
        return marginal_.probability(y) * conditional_[y].probability(x);
    }
    float total() const { return marginal_.total(); } ///< the sum of the weights

  private:
    Distribution1D marginal_;
    std::vector<Distribution1D> conditional_;
};

} // namespace weft
