// What a light tree knows of a light, or of several: where it is, which way it shines, how much.
//
// Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".
// Directions are bounded by two angles: the surface normals lie within theta_o of `axis`, and each
// shines up to theta_e from its normal, roughly as the cosine. Points and spheres have normals all
// around. Beyond theta_o + theta_e of all directions to the light it must be dark: there it may
// never be sampled.
#pragma once

#include <span>

#include "lights/delta_lights.h"
#include "lights/emitter_geometry.h"
#include "lights/luminaire.h"

namespace weft::lights {

struct LightBounds {
    Vec3 low{0, 0, 0}, high{0, 0, 0}; ///< corners of the box; of no meaning at infinity
    Vec3 axis{0, 0, 1};               ///< unit
    float theta_o = kPi;              ///< radians in [0, pi]
    float theta_e = kPi / 2;          ///< radians in [0, pi / 2]
    float power = 0;                  ///< luminance times the user's weight, finite and >= 0
    float weight = 1;                 ///< the user's, > 0 where the power is
    bool at_infinity = false;         ///< light comes from a direction, not from a place

    Vec3 centre() const { return (low + high) * 0.5f; }
    float diagonal_squared() const { return length_squared(high - low); }
};

/// Boxes and directions; `power` is 0, for the caller to set.
LightBounds bounds_of(PointLight const& light);
LightBounds bounds_of(SpotLight const& light);
LightBounds bounds_of(PhotometricLight const& light);
LightBounds bounds_of(Luminaire const& lamp);
LightBounds bounds_of(RectangleEmitter const& emitter, uint32_t primitive = 0);
LightBounds bounds_of(SphereEmitter const& emitter, uint32_t primitive = 0);
LightBounds bounds_of(DiskEmitter const& emitter, uint32_t primitive = 0);
LightBounds bounds_of(MeshEmitter const& emitter, uint32_t primitive);

/// Returns what bounds both, which are at finite places. Powers add up.
LightBounds unite(LightBounds const& a, LightBounds const& b);
/// Returns what bounds all of at least one: tighter, around the mean of the axes.
LightBounds unite(std::span<LightBounds const> all);

/// M_Omega of the paper: the integral of cos(max(0, theta - theta_o)) over the directions up to
/// theta_o + theta_e from the axis. Power over this is the intensity within theta_o: exactly for
/// points (4 pi), spheres (4 pi) and flat emitters (pi).
float orientation_measure(LightBounds const& bounds);

} // namespace weft::lights
