// Directional albedo of microfacet lobes from precomputed tables: the power that leaves a white
// lobe when it is seen along a cosine. Used to pick lobes, so that it trades digits for speed.
//
// tools/make_albedo_tables.cpp writes the tables (albedo_tables.h) on the grids declared here.
// Between nodes they are interpolated linearly. Anisotropic distributions are looked up at the
// root mean square of their alphas, which forgets the azimuth of wo. Alphas beyond 1 and indices
// beyond 4 (or below 1 / 4) are taken at that bound. Mean absolute error: 0.002 for reflection and
// 0.005 for dielectrics (worst about 0.1, at grazing angles); 0.03 where alphas differ (worst 0.2,
// at 0.8 by 0.002; the geometric mean would be four times off).
#pragma once

#include <array>
#include <cmath>

#include "lobes/microfacet.h"

namespace weft::lobes {

namespace albedo_grid {
inline constexpr int cosines = 17; ///< odd: the dielectrics put a node on the critical angle
inline constexpr int alphas = 10;
inline constexpr int indices = 8;
inline constexpr float max_contrast = 0.6f; ///< (eta - 1) / (eta + 1) at eta = 4

// Each coordinate is in [0, 1], the nodes being equally spaced in it.

inline float alpha_coordinate(float alpha) { return std::sqrt(alpha); }
inline float alpha_at(float coordinate) { return square(coordinate); }
/// `ratio` >= 1 is the greater index over the smaller one. The root of the contrast is about
/// linear in the critical angle's cosine, which sets the scale of all that happens.
inline float index_coordinate(float ratio) {
    return std::sqrt((ratio - 1) / ((ratio + 1) * max_contrast));
}
inline float index_at(float coordinate) {
    float const c = square(coordinate) * max_contrast;
    return (1 + c) / (1 - c);
}
inline float cosine_coordinate(float c) { return std::sqrt(c); }
inline float cosine_at(float coordinate) { return square(coordinate); }
/// Leaving the denser medium: the lower half holds total reflection, densest at the critical
/// angle; the upper half is linear in the refracted cosine, in which Fresnel reflectance has no
/// kink. eta <= 1.
inline float leaving_cosine_coordinate(float c, float eta) {
    float const k = (eta - 1) * (eta + 1) + c * c, critical = std::sqrt((1 - eta) * (1 + eta));
    if (k >= 0) return 0.5f + 0.5f * std::sqrt(k) / eta;
    return 0.5f - 0.5f * safe_sqrt(1 - c / critical);
}
inline float leaving_cosine_at(float coordinate, float eta) {
    float const critical2 = (1 - eta) * (1 + eta);
    if (coordinate < 0.5f) return std::sqrt(critical2) * (1 - square(1 - 2 * coordinate));
    return std::sqrt(critical2 + square(eta * (2 * coordinate - 1)));
}
} // namespace albedo_grid

struct DielectricAlbedo {
    float reflected = 0, transmitted = 0; ///< fractions of power; what lacks to 1 is lost
};

/// Of the white reflection; cos_o in [0, 1].
float reflection_albedo(Ggx const& distribution, float cos_o);
float reflection_albedo(Beckmann const& distribution, float cos_o);

/// Of the untinted dielectric; cos_o in [0, 1], `eta` as in MicrofacetDielectric.
DielectricAlbedo dielectric_albedo(Ggx const& distribution, float cos_o, float eta);
DielectricAlbedo dielectric_albedo(Beckmann const& distribution, float cos_o, float eta);

} // namespace weft::lobes
