// Reflectance of a base under a thin film: iridescence (soap, oil, oxide, coatings).
//
// The Airy summation, integrated over the visible spectrum as by Belcour and Barla 2017, "A
// practical extension to microfacet theory for the modeling of varying iridescence": reflectance
// is a Fourier series in the phase between successive reflections, so that a colour channel needs
// just the Fourier transform S of its sensitivity at multiples of the optical path difference D.
// With r12 and r23 the amplitudes of the film's two sides and q = r12 r23, per polarisation
//     R = 1 - K (1 + 2 Re sum over m >= 1 of (-q)^m S(m D)),
//     K = (1 - |r12|^2) (1 - |r23|^2) / (1 - |q|^2).
// Where they take S from a fit of Gaussians, here it is tabulated (tools/
// make_thin_film_tables.cpp) from the CIE 1931 curves under D65, the white of the pictures, and the
// series goes on until what is left does not matter. Against the spectral integral: error below
// 0.02 (tests/lobes/thin_film.cpp).
//
// Where the film totally reflects (its index below that of wo's side) light still tunnels through
// a film thinner than a wavelength; that falls off without oscillating, and a sum over a few
// wavelengths will do.
//
// Colours outside of the gamut are cut to [0, 1]. Left out: dispersion, absorption in the film,
// films too thick or sources too narrow for a 1931 observer's S.
#pragma once

#include "base/color.h"

namespace weft::lobes {

namespace thin_film_grid {
inline constexpr int nodes = 482;
inline constexpr float spacing = 25;  ///< of path differences, nm; S is 0 beyond the last
inline constexpr int wavelengths = 9; ///< 400 to 720 nm
inline constexpr float wavelength(int i) { return 400.f + 40.f * float(i); }
} // namespace thin_film_grid

struct ThinFilm {
    float thickness = 0; ///< nm; 0 means no film
    float ior = 1.33f;   ///< of the film, absolute
    float outer_ior = 1; ///< on wo's side of it, absolute
    explicit operator bool() const { return thickness > 0; }
};

/// Over a conductor of index eta + i k relative to wo's side; cos_o in [0, 1] on wo's side.
Color thin_film_reflectance(ThinFilm const& film, float cos_o, Color const& eta, Color const& k);

/// Over a dielectric of index `eta` relative to wo's side. The same along a ray from either side.
Color thin_film_reflectance(ThinFilm const& film, float cos_o, float eta);

} // namespace weft::lobes
