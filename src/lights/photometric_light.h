// A point that shines as a measured lamp does: luminous intensity over vertical and horizontal
// angles (LM-63-2002, type C). Vertical angle 0 is the frame's normal, straight down for a lamp
// under a ceiling; horizontal angle 0 is its s axis, and horizontal angles grow counter-clockwise
// as seen from above.
#pragma once

#include <memory>

#include "base/frame.h"
#include "lights/delta_lights.h"
#include "scene/photometry.h"

namespace weft::lights {

/// Candela at angles in degrees: `vertical` in [0, 180], `horizontal` in [0, 360]. Bilinear
/// between the angles of the grid, 0 beyond its vertical angles.
float candela(scene::Photometry const& lamp, float vertical, float horizontal);

/// The integral over all directions, in lumens: exact for the bilinear interpolation.
double luminous_flux(scene::Photometry const& lamp);

struct PhotometricLight {
    Vec3 position{0, 0, 0};
    Frame frame;                                   ///< n: vertical angle 0, s: horizontal angle 0
    Color intensity{1};                            ///< power per solid angle for each candela
    std::shared_ptr<scene::Photometry const> lamp; ///< not null

    /// Candela along `d` (any length but 0).
    float attenuation(Vec3 const& d) const;
    LightSample sample(Vec3 const& ref) const {
        LightSample s = PointLight{position, intensity}.sample(ref);
        if (s.pdf > 0) s.radiance *= attenuation(-s.wi);
        return s;
    }
    Color power() const { return intensity * float(luminous_flux(*lamp)); }
};

} // namespace weft::lights
