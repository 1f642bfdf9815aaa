// A triangle as it is seen from a point, and directions towards it that are uniform in solid angle.
//
// Arvo 1995, "Stratified sampling of spherical triangles", without his angles: they cancel where
// the triangle is small or thin. With the unit vectors a, b, c to the corners and
//   g0 = |a . (b x c)|,   g1 = a . c + b . c,   g2 = 1 + a . b
// the solid angle W obeys tan(W / 2) = g0 / (g1 + g2) (Van Oosterom and Strackee 1983). The part of
// size w beside the edge ab ends at a point q of the arc from a to c; the same formula for (a, b,
// q) says that the vector halfway between a and q is along
//   m = (g0 cos(w / 2) - g1 sin(w / 2)) a + g2 sin(w / 2) c,   q = 2 (a . m) / (m . m) m - a.
// On the arc from b to q heights 1 - cos above b are uniform. The direction comes out as a positive
// sum of a, b and c, so that its barycentric coordinates need no intersection with the plane.
//
// Triangles that are small for their distance are sampled by area (area_sampling.h), which costs a
// fifth.
#pragma once

#include <algorithm>
#include <optional>

#include "base/vec.h"
#include "base/warp.h"
#include "lights/area_sampling.h"

namespace weft::lights {

/// A triangle from a to b to c with the shorter way around each side; less than a hemisphere.
class SphericalTriangle {
  public:
    /// A corner as seen from the reference point, and the edges from there to the other two.
    SphericalTriangle(Vec3d const& to_a, Vec3d const& ab, Vec3d const& ac) {
        Vec3d const to_b = to_a + ab, to_c = to_a + ac;
        double const aa = length_squared(to_a), bb = length_squared(to_b),
                     cc = length_squared(to_c);
        per_length_ = {1 / std::sqrt(aa), 1 / std::sqrt(bb), 1 / std::sqrt(cc)};
        a_ = to_a * per_length_.x;
        b_ = to_b * per_length_.y;
        c_ = to_c * per_length_.z;
        g0_ = std::abs(dot(to_a, cross(ab, ac))) * (per_length_.x * per_length_.y * per_length_.z);
        g1_ = dot(a_, c_) + dot(b_, c_);
        g2_ = 1 + dot(a_, b_);
        solid_angle_ = float(2 * std::atan2(g0_, g1_ + g2_));
    }

    float solid_angle() const { return solid_angle_; } ///< steradians in [0, 2 pi]

    /// Barycentric coordinates of b and c of the point seen in a direction uniform in solid angle.
    Vec2 sample(Vec2 u) const {
        double const half = 0.5 * double(u.x) * double(solid_angle_), sine = std::sin(half);
        double const x = g0_ * std::cos(half) - g1_ * sine, y = g2_ * sine;
        Vec3d const m = a_ * x + c_ * y;
        double const scale = 2 * dot(a_, m) / length_squared(m);
        Vec3d const q = m * scale - a_;
        double const end = 0.5 * length_squared(b_ - q); // 1 - cos from b to q
        double const height = double(u.y) * end;
        double const of_q = std::sqrt(double(u.y) * (2 - height) / (2 - end));
        double const of_b = 1 - height - of_q * (1 - end);
        Vec3d const w(std::max(of_q * (scale * x - 1), 0.0) * per_length_.x,
                      std::max(of_b, 0.0) * per_length_.y,
                      std::max(of_q * scale * y, 0.0) * per_length_.z);
        double const per_sum = 1 / (w.x + w.y + w.z);
        return {float(w.y * per_sum), float(w.z * per_sum)};
    }

  private:
    Vec3d a_, b_, c_, per_length_; ///< unit vectors to the corners; 1 / distance of each
    double g0_, g1_, g2_;
    float solid_angle_;
};

/// How a triangle is sampled from a point: by solid angle or by area, and with which density.
class TriangleView {
  public:
    TriangleView(Vec3d const& to_a, Vec3d const& ab, Vec3d const& ac) {
        Vec3d const to_b = to_a + ab, to_c = to_a + ac, bc = ac - ab;
        area_by_height_ = 0.5 * std::abs(dot(to_a, cross(ab, ac)));
        double const longest =
            std::max({length_squared(ab), length_squared(ac), length_squared(bc)});
        double const nearest =
            std::min({length_squared(to_a), length_squared(to_b), length_squared(to_c)});
        // The sphere around a triangle is at most that around an equilateral one of its longest
        // side.
        if (is_far(longest / 3, nearest)) return;
        near_.emplace(to_a, ab, ac);
        if (!(near_->solid_angle() >= kMinSolidAngle)) near_.reset();
    }

    /// Barycentric coordinates of corners b and c.
    Vec2 sample(Vec2 u) const { return near_ ? near_->sample(u) : square_to_triangle(u); }
    /// Per solid angle, at a point of the triangle at `distance`.
    float pdf(float distance) const {
        if (near_) return 1 / near_->solid_angle();
        return area_density(area_by_height_, double(distance) * double(distance));
    }

  private:
    std::optional<SphericalTriangle> near_;
    double area_by_height_; ///< the area times the distance of the plane
};

} // namespace weft::lights
