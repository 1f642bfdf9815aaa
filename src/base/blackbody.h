// The colour of what glows by its heat: Planck's law seen by the CIE 1931 2 degree observer, as
// fitted by Wyman, Sloan and Shirley 2013, "Simple analytic approximations to the CIE XYZ color
// matching functions" (multi-lobe fit).
#pragma once

#include "base/color.h"

namespace weft {

/// XYZ of the observer at `wavelength` nm.
Vec3d cie_xyz(double wavelength);

/// Chromaticity (x, y) of a black body of `kelvin` >= 500.
Imath::V2d planck_chromaticity(double kelvin);

/// Linear RGB of luminance 1 and that chromaticity, from a table over 1 / kelvin; its error in x
/// and y is below 1e-4. `kelvin` is clamped to 800 .. 40000 (below Draper's 798 K nothing glows
/// visibly). Below 1900 K the colour is beyond Rec. 709: white of the same luminance is mixed in
/// until no channel is negative, so that the hue stays.
Color blackbody_color(float kelvin);

} // namespace weft
