// Colours of heat against a direct integration of Planck's law.
#include "base/blackbody.h"

#include <gtest/gtest.h>

using namespace weft;

namespace {

double piece(double w, double mean, double below, double above) {
    double const s = w < mean ? below : above;
    return std::exp(-(w - mean) * (w - mean) / (2 * s * s));
}

/// x and y of a black body, 1 nm apart, in SI units.
Imath::V2d chromaticity(double kelvin) {
    double X = 0, Y = 0, Z = 0;
    for (int nm = 380; nm <= 780; ++nm) {
        double const l = nm * 1e-9, h = 6.62607015e-34, c = 299792458, k = 1.380649e-23;
        double const L = 2 * h * c * c / std::pow(l, 5) / (std::exp(h * c / (l * k * kelvin)) - 1);
        X += L * (1.056 * piece(nm, 599.8, 37.9, 31.0) + 0.362 * piece(nm, 442.0, 16.0, 26.7) -
                  0.065 * piece(nm, 501.1, 20.4, 26.2));
        Y += L * (0.821 * piece(nm, 568.8, 46.9, 40.5) + 0.286 * piece(nm, 530.9, 16.3, 31.1));
        Z += L * (1.217 * piece(nm, 437.0, 11.8, 36.0) + 0.681 * piece(nm, 459.0, 26.0, 13.8));
    }
    return {X / (X + Y + Z), Y / (X + Y + Z)};
}

Imath::V2d chromaticity(Color const& c) {
    double const X = 0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b;
    double const Y = 0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b;
    double const Z = 0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b;
    return {X / (X + Y + Z), Y / (X + Y + Z)};
}

TEST(Blackbody, HasPlancksChromaticity) {
    for (float kelvin = 2000; kelvin <= 30000; kelvin *= 1.03f) {
        Imath::V2d const found = chromaticity(blackbody_color(kelvin)),
                         expected = chromaticity(double(kelvin));
        EXPECT_NEAR(found.x, expected.x, 1e-3) << kelvin;
        EXPECT_NEAR(found.y, expected.y, 1e-3) << kelvin;
        EXPECT_NEAR(luminance(blackbody_color(kelvin)), 1, 1e-3) << kelvin;
    }
}

TEST(Blackbody, LooksAsItIsKnown) {
    // The published locus: 2856 K is illuminant A, 0.4476, 0.4074; the fits are good to 0.01.
    Imath::V2d const a = planck_chromaticity(2856);
    EXPECT_NEAR(a.x, 0.4476, 0.01);
    EXPECT_NEAR(a.y, 0.4074, 0.01);
}

TEST(Blackbody, BeyondTheScreenIsNeverNegative) {
    float before = kInfinity;
    for (float kelvin = 400; kelvin < 50000; kelvin *= 1.05f) {
        Color const c = blackbody_color(kelvin);
        EXPECT_TRUE(is_finite(c));
        EXPECT_GE(min_component(c), 0) << kelvin;
        EXPECT_NEAR(luminance(c), 1, 2e-3) << kelvin;
        EXPECT_LE(c.r, before + 1e-5f) << "hotter is less red: " << kelvin;
        before = c.r;
    }
}

} // namespace
