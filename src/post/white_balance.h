// White balance: adapts a picture to the light that it was lit by.
//
// The white of that light becomes the display's neutral (1, 1, 1) by a von Kries scaling of
// Bradford's sharpened cone responses (Lam 1985; the linear form of ICC.1:2010 annex E).
// Temperature and tint are coordinates along and beside the Planckian locus: tint is 3000 Duv,
// along the normal of the locus in the CIE 1960 (u, v) plane (the scale is that of Adobe's DNG
// specification).
//
// Left out: several lights at once (one white for the whole picture), and guesses of the white
// from the picture's statistics.
#pragma once

#include <array>

#include "base/color.h"
#include "scene/display.h"

namespace weft::post {

/// A linear map of RGB, by rows.
struct ColorMatrix {
    std::array<Vec3, 3> rows{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

    Color operator*(Color const& c) const {
        Vec3 const v(c.r, c.g, c.b);
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
    friend bool operator==(ColorMatrix const&, ColorMatrix const&) = default;
};

/// Chromaticity (x, y) of the light; `kelvin` in [1500, 40000], `tint` in [-150, 150].
Imath::V2d light_chromaticity(double kelvin, double tint);

/// Chromaticity (x, y) of a linear RGB colour; not finite for black.
Imath::V2d chromaticity_of(Color const& color);

/// Maps linear RGB of chromaticity `white` to grey of the same luminance. Throws InputError where
/// a cone response to `white` is not positive.
ColorMatrix adapt_to_d65(Imath::V2d const& white);

/// Whether `display` asks for any white balance.
bool balances_white(scene::Display const& display);

/// What `display` asks for: exactly the identity where that is none. Throws InputError where the
/// temperature is below 1500 K, the neutral colour is black, both are given, or a tint alone.
ColorMatrix white_balance(scene::Display const& display);

} // namespace weft::post
