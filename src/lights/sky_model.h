// The light of a clear sky and of the sun through it.
//
// Sky: Hosek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", eqs. 8 to
// 11, with the authors' coefficients for CIE XYZ (hosek_wilkie_tables.h), turned into RGB; what
// lies beyond Rec. 709 is clamped.
//
// Sun: a black body of 5772 K (the IAU's nominal solar temperature), by the solid angle that the
// sun has, through the atmosphere of Preetham, Shirley and Smits 1999, "A Practical Analytic Model
// for Daylight", A.1: Rayleigh scattering, aerosols by the turbidity and ozone, over the air mass
// of Kasten and Young 1989. Water vapour and mixed gases absorb next to nothing that is seen. Hosek
// and Wilkie's own solar radiance (2013) is published for spectra only.
//
// Units: both models give luminances. A radiance is a luminance over 110 lm/W, about the luminous
// efficacy of daylight (Littlefair 1985: 105 to 130, sunlight to clear sky), so that irradiances
// come out as those of the whole spectrum do: close to 1000 W/m^2 under a high sun.
//
// Below the horizon the models end. A sun that is there gives nothing, and the sky keeps the
// colours of sunset while it dims by 10^(-0.35 per degree), as illuminances do from about 500 lx at
// sunset to 3.4 lx at the end of civil twilight (6 degrees).
#pragma once

#include <vector>

#include "base/color.h"

namespace weft::lights {

inline constexpr double kDaylightEfficacy = 110; ///< lm/W

class SkyModel {
  public:
    /// `turbidity`: 1 (pure air) to 10 (haze). `albedo` of the ground, 0 to 1. `elevation` of the
    /// sun, radians.
    SkyModel(double turbidity, double albedo, double elevation);
    /// Returns the light from a direction `theta` from the zenith, at most pi / 2, and `gamma` from
    /// the sun, in radians; W/(m^2 sr).
    Color radiance(double theta, double gamma) const;

  private:
    struct Channel {
        double shape[9], scale;
    };
    Channel channels_[3]; ///< X, Y, Z
};

/// Returns the irradiance on a surface that faces the sun, W/m^2.
Color sun_irradiance(double turbidity, double elevation);

/// Returns what shines from the sky and back from the ground, over the lat-long square
/// (lat_long.h).
struct SkyTable {
    int width = 1, height = 1;
    std::vector<Color> texels; ///< row by row from v = 0 (+y, the zenith)

    /// Bilinear between the centres of texels, around u = 0 as well.
    Color at(Vec2 uv) const;
};

struct SkyParameters {
    Vec3 sun{0, 1, 0}; ///< unit, towards it; y is up
    float turbidity = 3;
    Color ground{0.2f}; ///< its albedo
    float sky = 1, sun_factor = 1;
};

/// Ground that is lit by both is below the horizon. `height` is even, so that the horizon lies
/// between texels.
SkyTable make_sky_table(SkyParameters const& p, int width, int height);

} // namespace weft::lights
