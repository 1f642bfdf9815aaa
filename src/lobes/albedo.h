// Directional albedo of microfacet lobes from precomputed tables: the fraction of power that a lobe
// scatters when it is seen along a direction. It decides how often lobes are picked, how much light
// the layers below get, and how much light a single-scattering lobe must be given back.
//
// tools/make_albedo_tables.cpp writes the tables (albedo_tables.h) on the grids declared here.
// Between nodes they are interpolated linearly. Alphas beyond 1 are taken at that
// bound; every index has its place. The white albedo of anisotropic reflection has a table of its
// own, and scales the other moments and what dielectrics reflect, looked up at the root mean square
// of the alphas. Where they transmit, anisotropic dielectrics are looked up at about the alpha
// along the view. tests/lobes measures and bounds the errors.
#pragma once

#include <array>
#include <cmath>

#include "lobes/ashikhmin_shirley.h"
#include "lobes/microfacet.h"

namespace weft::lobes {

namespace albedo_grid {
inline constexpr int cosines = 33; ///< odd: the dielectrics put a node on the critical angle
inline constexpr int alphas = 15;
inline constexpr int reflection_cosines = 65;
inline constexpr int dielectric_alphas = 21;
inline constexpr int indices = 29;         ///< up to the infinite one
inline constexpr float least_root = 0.15f; ///< of the contrast (eta - 1) / (eta + 1) at 1.001
// Anisotropic reflection: the greater alpha, the lesser over the greater, azimuth, cosine.
inline constexpr int greater_alphas = 10, alpha_ratios = 7, azimuths = 7, anisotropic_cosines = 17;
inline constexpr int area_alphas = 13, area_slopes = 33; ///< of ashikhmin_shirley_area

// Each coordinate is in [0, 1], the nodes being equally spaced in it.

inline float alpha_coordinate(float alpha) { return std::sqrt(alpha); }
inline float alpha_at(float coordinate) { return square(coordinate); }
/// `ratio` >= 1 is the greater index over the smaller one. The contrast's root is about linear in
/// the critical angle's cosine, which sets the scale of all that happens; its fourth root puts more
/// nodes where the indices nearly match and the critical angle is a grazing one.
inline float index_coordinate(float ratio) {
    float const contrast = (ratio - 1) / (ratio + 1);
    return (std::sqrt(std::sqrt(contrast)) - least_root) / (1 - least_root);
}
/// The last node stands for all that is beyond 1e4.
inline float index_at(float coordinate) {
    float const c = std::min(square(square(lerp(least_root, 1.f, coordinate))), 0.9998f);
    return (1 + c) / (1 - c);
}
/// All happens on the scale of alpha near grazing angles: takes [0, 1] onto itself with half of it
/// for cosines below alpha / 3 or so.
inline float cosine_coordinate(float c, float alpha) {
    return std::sqrt(c * (1 + alpha) / (c + alpha));
}
inline float cosine_at(float coordinate, float alpha) {
    float const q = square(coordinate);
    return std::min(alpha * q / (1 + alpha - q), 1.f);
}
/// Half of the nodes on the scale of alpha, half on that of Fresnel's equations.
inline float fresnel_cosine_coordinate(float c, float alpha) {
    return 0.5f * (std::sqrt(c) + cosine_coordinate(c, alpha));
}
/// By bisection: for the table's maker.
inline float fresnel_cosine_at(float coordinate, float alpha) {
    float low = 0, high = 1;
    for (int i = 0; i < 40; ++i) {
        float const middle = 0.5f * (low + high);
        (fresnel_cosine_coordinate(middle, alpha) < coordinate ? low : high) = middle;
    }
    return high;
}
/// Leaving the denser medium: the lower half holds total reflection, dense at both of its ends;
/// the upper half follows the refracted cosine, in which Fresnel reflectance has no kink. eta <= 1.
inline float leaving_cosine_coordinate(float c, float eta, float alpha) {
    float const k = (eta - 1) * (eta + 1) + c * c, critical = std::sqrt((1 - eta) * (1 + eta));
    if (k >= 0)
        return 0.5f + 0.5f * fresnel_cosine_coordinate(std::min(std::sqrt(k) / eta, 1.f), alpha);
    return 0.5f * fresnel_cosine_coordinate(1 - safe_sqrt(1 - c / critical), alpha);
}
inline float leaving_cosine_at(float coordinate, float eta, float alpha) {
    float const critical2 = (1 - eta) * (1 + eta);
    if (coordinate >= 0.5f)
        return std::sqrt(critical2 + square(eta * fresnel_cosine_at(2 * coordinate - 1, alpha)));
    return std::sqrt(critical2) * (1 - square(1 - fresnel_cosine_at(2 * coordinate, alpha)));
}
/// What leaves rough glass at grazing angles spans decades: its logarithm is tabulated.
inline float power_coordinate(float power) {
    return 1 + std::log(std::max(power, 1e-4f)) / 9.2104f;
}
inline float power_at(float coordinate) { return std::exp((coordinate - 1) * 9.2104f); }
/// From 0 along the axis of the greater alpha to 1 along the other; u, v >= 0 are the components
/// of wo along them.
inline float azimuth_coordinate(float u, float v) {
    float const sum = u + v;
    return sum > 0 ? v / sum : 0.5f;
}
inline float area_slope_coordinate(float a) { return a < 1e6f ? a / (1 + a) : 1.f; }
inline float area_slope_at(float coordinate) { return coordinate / (1 - coordinate); }
} // namespace albedo_grid

/// The white reflection's power and where it comes from: c is the cosine between wo and the half
/// vector, and means are over the power.
struct ReflectionMoments {
    float white = 0;     ///< the albedo
    float schlick = 0;   ///< albedo times mean (1 - c)^5
    float edge = 0;      ///< albedo times mean c (1 - c)^6
    float mean = 0;      ///< of c
    float deviation = 0; ///< standard deviation of c
};

struct DielectricAlbedo {
    float reflected = 0, transmitted = 0; ///< fractions of power; what lacks to 1 is lost
};

// For Ggx, Beckmann and AshikhminShirley; wo is a local unit vector, wo.z in [0, 1].

template <class Distribution>
float white_albedo(Distribution const& distribution, Vec3 const& wo);

template <class Distribution>
ReflectionMoments reflection_moments(Distribution const& distribution, Vec3 const& wo);

/// What a dielectric reflects, be it stretched or not: `eta` as in MicrofacetDielectric.
template <class Distribution>
float dielectric_reflection(Distribution const& distribution, Vec3 const& wo, float eta);

/// Of the untinted dielectric; `eta` as in MicrofacetDielectric.
template <class Distribution>
DielectricAlbedo dielectric_albedo(Distribution const& distribution, Vec3 const& wo, float eta);

} // namespace weft::lobes
