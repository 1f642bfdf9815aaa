// A disk of light infinitely far away: the sun, and any directional light with an angular size.
//
// All directions within an angular radius of an axis. With x in [0, 1] the share of the cone's
// solid angle that is nearer to the axis, its radiance is, channel by channel,
//
//   L(x) = L_0 mu^alpha,  mu = sqrt(1 - x)
//
// the limb darkening of Hestroffer and Magnan 1998, "Wavelength dependency of the Solar limb
// darkening" (their u = 1), where mu is the cosine at which a ray leaves the sphere that is seen:
// sin(theta)^2 = x sin(radius)^2 but for a term of the order of radius^2. alpha = 0 is a uniform
// disk. Directions are sampled in proportion to the least darkened channel, so that no ratio of
// radiance to density exceeds its value at the centre.
#pragma once

#include "base/frame.h"
#include "base/warp.h"
#include "lights/light_sample.h"

namespace weft::lights {

/// The sun's diameter as seen from the earth at its mean distance, in degrees.
inline constexpr float kSunDiameter = 0.533f;
/// alpha = -0.023 + 0.292 / lambda, lambda in um, at 610, 550 and 465 nm.
inline constexpr Color kSunLimb{0.456f, 0.508f, 0.605f};

/// Radians. Directions of floats do not tell the points of a smaller disk apart, and below 1e-19
/// its solid angle is none of a float.
inline constexpr float kLeastSunRadius = 1e-6f;

struct SunDisk {
    static constexpr FoundAs found_as = FoundAs::Background;
    static constexpr bool at_infinity = true;

    Vec3 direction{0, 1, 0}; ///< unit, towards the centre
    float one_minus_cos = 1; ///< of the angular radius, in (0, 2]: 2 is the whole sphere
    Color centre{1};         ///< L_0
    Color limb{Color(0)};    ///< alpha per channel, >= 0

    static constexpr bool has_size() { return true; }
    /// Samples uniformly in u over what it emits; the same for all points.
    LightSample sample(Vec2 u) const;
    LightSample sample(LightContext const&, Vec3 const&, Vec2 u, uint32_t) const {
        return sample(u);
    }
    LightSeen seen(LightContext const&, Vec3 const&, Vec3 const& d) const {
        return {radiance(d), pdf(d)};
    }
    /// Returns the density with which `sample` gives unit `d`; 0 off the disk.
    float pdf(Vec3 const& d) const;
    /// Returns the radiance from unit `d`, towards the light; black off the disk.
    Color radiance(Vec3 const& d) const;
    /// Returns the irradiance on a surface that faces the centre; at most a hemisphere.
    Color irradiance() const;
};

/// The disk of that irradiance on a surface that faces it. `radius`: radians in (0, pi / 2], and
/// best above 1e-3: directions of floats cut the rim of a smaller one into steps.
SunDisk make_sun_disk(Vec3 const& direction, float radius, Color const& irradiance,
                      Color const& limb = Color(0));

} // namespace weft::lights
