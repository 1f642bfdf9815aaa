#include "post/white_balance.h"

#include <Imath/ImathMatrix.h>

#include "base/blackbody.h"
#include "base/error.h"
#include "schema/text.h"

namespace weft::post {

namespace {

using Matrix = Imath::M33d; // m[row][column], for column vectors

Vec3d times(Matrix const& m, Vec3d const& v) {
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
            m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

/// Rec. 709 to XYZ (IEC 61966-2-1).
Matrix const& xyz_from_rgb() {
    static Matrix const m(0.4123908, 0.3575843, 0.1804808, 0.2126390, 0.7151687, 0.0721923,
                          0.0193308, 0.1191948, 0.9505322);
    return m;
}

Matrix const& bradford() {
    static Matrix const m(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685,
                          1.0296);
    return m;
}

Vec3d xyz_of(Imath::V2d const& xy) { return {xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y}; }

/// CIE 1960.
Imath::V2d uv_of(Imath::V2d const& xy) {
    double const d = -2 * xy.x + 12 * xy.y + 3;
    return {4 * xy.x / d, 6 * xy.y / d};
}
Imath::V2d xy_of(Imath::V2d const& uv) {
    double const d = 2 * uv.x - 8 * uv.y + 4;
    return {3 * uv.x / d, 2 * uv.y / d};
}

constexpr float kLowestTemperature = 1500; // what is redder lies far outside of Rec. 709

} // namespace

Imath::V2d light_chromaticity(double kelvin, double tint) {
    Imath::V2d const here = planck_chromaticity(kelvin);
    if (tint == 0) return here;
    Imath::V2d const tangent =
        (uv_of(planck_chromaticity(kelvin * 1.01)) - uv_of(planck_chromaticity(kelvin / 1.01)))
            .normalized();
    // Hotter is to the left, so that this points up, towards green.
    Imath::V2d const normal(tangent.y, -tangent.x);
    return xy_of(uv_of(here) + normal * (tint / 3000));
}

Imath::V2d chromaticity_of(Color const& color) {
    Vec3d const xyz = times(xyz_from_rgb(), Vec3d(color.r, color.g, color.b));
    double const sum = xyz.x + xyz.y + xyz.z;
    return {xyz.x / sum, xyz.y / sum};
}

ColorMatrix adapt_to_d65(Imath::V2d const& white) {
    // D65 as the matrix has it, so that a white of (1, 1, 1) moves nothing but by rounding.
    Vec3d const to = times(bradford(), times(xyz_from_rgb(), Vec3d(1)));
    Vec3d const from = times(bradford(), xyz_of(white));
    if (!(from.x > 0 && from.y > 0 && from.z > 0))
        throw InputError("expected a white near those of lamps and skies, found the chromaticity " +
                         schema::number_text(float(white.x)) + ", " +
                         schema::number_text(float(white.y)) +
                         ", which is beyond what eyes adapt to");
    Matrix scale;
    for (int i = 0; i < 3; ++i) scale[i][i] = to[i] / from[i];
    // Imath's product is that of the matrices as written, rows times columns.
    Matrix const to_cones = bradford() * xyz_from_rgb();
    Matrix const m = to_cones.inverse() * scale * to_cones;
    ColorMatrix result;
    for (int i = 0; i < 3; ++i)
        result.rows[size_t(i)] = {float(m[i][0]), float(m[i][1]), float(m[i][2])};
    return result;
}

bool balances_white(scene::Display const& display) {
    Color const& n = display.neutral;
    return display.temperature != 0 || n.r != n.g || n.g != n.b || n.r == 0;
}

ColorMatrix white_balance(scene::Display const& display) {
    if (display.temperature == 0 && display.tint != 0)
        throw InputError("'tint' moves the white that 'temperature' names: expected a temperature, "
                         "found none");
    if (!balances_white(display)) return {};
    if (display.temperature == 0) {
        if (is_black(display.neutral))
            throw InputError("'neutral' expects a colour that can become grey, found black");
        return adapt_to_d65(chromaticity_of(display.neutral));
    }
    if (!(display.neutral == Color(1)))
        throw InputError("'temperature' and 'neutral' both say what is white: expected one of "
                         "them, found both");
    if (display.temperature < kLowestTemperature)
        throw InputError("'temperature' expects at least 1500, or 0 for no white balance, found '" +
                         schema::number_text(display.temperature) + "'");
    return adapt_to_d65(light_chromaticity(display.temperature, display.tint));
}

} // namespace weft::post
