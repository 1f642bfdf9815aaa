// When an emitter is sampled by area rather than by solid angle, and with which density.
//
// Seen from afar, points uniform in area are nearly uniform in solid angle: the density
// d^3 / (area x height), where height is the distance of the plane, varies as the cube of the
// distance d alone. Sample and density then take 26 ns for a rectangle and 40 ns for a disk in
// place of 200 and 290 ns. At the border, kFarRadius2, this adds 0.12 of the squared mean to the
// variance of what an unshadowed rectangle sends to a point, 0.18 for a disk; a third of that at a
// third of kFarRadius2. Shadows and bounces make far more noise in a picture.
//
// Both `sample` and `pdf` of an emitter must decide by the same numbers.
#pragma once

#include <cmath>

namespace weft::lights {

/// Square of the radius of the sphere around a far emitter, over that of its distance.
inline constexpr double kFarRadius2 = 0.15;

/// Steradians. What is near but seen as edge-on as this is sampled by area, too: there sampling by
/// solid angle has no digits left.
inline constexpr float kMinSolidAngle = 1e-6f;

/// Returns whether an emitter is sampled by area: `radius2` is the square of the radius of a sphere
/// around it, `distance2` that of the distance of the sphere's centre from the reference point.
inline bool is_far(double radius2, double distance2) { return radius2 < kFarRadius2 * distance2; }

/// The density per solid angle of a point chosen uniformly by area, at a squared distance; 0 where
/// the surface is seen edge-on. `area_by_height`: the area times the distance of its plane.
inline float area_density(double area_by_height, double distance2) {
    return area_by_height > 0 ? float(distance2 * std::sqrt(distance2) / area_by_height) : 0.f;
}

} // namespace weft::lights
