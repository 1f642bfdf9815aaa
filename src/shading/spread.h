// How a surface light is narrowed to a beam: the grid (honeycomb) in front of a soft box.
//
// As in Cycles: the slats hide a part of the light in proportion to the tangent of its angle a from
// the normal, and all of it beyond half of the spread, h; what is left is brighter, so that as much
// light leaves as without:
//   radiance(a) = emission (tan h - tan a) / (tan h - h)      for a < h, else 0
// since 2 int_0^h (tan h - tan a) cos a sin a da = tan h - h, where a Lambertian emitter has 1.
#pragma once

#include "base/vec.h"

namespace weft::shading {

class Spread {
  public:
    Spread() = default; ///< none: Lambertian
    /// `angle`: full, in degrees in (0, 180].
    explicit Spread(float angle) {
        if (angle >= 180) return;
        double const half = double(angle) * 3.14159265358979323846 / 360;
        half_angle_ = float(half);
        tangent_ = float(std::tan(half));
        // The difference for small angles, where the tangent has no digits to spare.
        double const rest =
            half < 0.01 ? half * half * half / 3 * (1 + 0.4 * half * half) : std::tan(half) - half;
        gain_ = float(1 / rest);
    }

    bool is_open() const { return tangent_ == kInfinity; }
    float half_angle() const { return half_angle_; } ///< radians in (0, pi / 2]
    float tangent() const { return tangent_; }       ///< of it; infinite without a spread
    /// Factor on the radiance towards unit `wo` on the side of unit normal `n`.
    float factor(Vec3 const& n, Vec3 const& wo) const {
        if (is_open()) return 1;
        float const cosine = dot(n, wo), sine = length(cross(n, wo));
        return cosine > 0 ? std::max(0.f, (tangent_ - sine / cosine) * gain_) : 0;
    }

  private:
    float half_angle_ = kPi / 2, tangent_ = kInfinity, gain_ = 1;
};

} // namespace weft::shading
