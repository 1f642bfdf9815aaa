// Which light to sample: by power, wherever the point to be lit is. The interface takes that
// point because a light tree, which does look at it, has the same one.
//
// Left out: geometry. A weak lamp near the point is chosen no more often than one far away, and
// so no positive weight may be negligible: each counts as at least a thousandth of the mean of
// the positive ones.
#pragma once

#include <span>

#include "base/distribution.h"

namespace weft::lights {

class LightChoice {
  public:
    struct Choice {
        uint32_t index = 0;    ///< into the weights
        float probability = 0; ///< 0: there is no light
        float u_rest = 0;      ///< the random number, stretched back to [0, 1)
    };

    LightChoice() = default;
    /// One weight per light, >= 0 and finite: its power times what the user asks for. A light of
    /// weight 0 is never chosen.
    explicit LightChoice(std::span<float const> weights);

    /// No light of positive weight.
    bool empty() const { return count_ == 0; }
    /// `ref`: the point to be lit; `normal`: its normal, or 0 in a medium; u in [0, 1).
    Choice choose(Vec3 const& ref, Vec3 const& normal, float u) const;
    /// That `choose` gives the light `index`.
    float probability(Vec3 const& ref, Vec3 const& normal, uint32_t index) const;

  private:
    Distribution1D by_weight_;
    uint32_t count_ = 0; ///< weights, if any is positive
};

} // namespace weft::lights
