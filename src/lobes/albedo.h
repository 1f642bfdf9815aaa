// Directional albedo of microfacet lobes from precomputed tables: the power that leaves a lobe when
// it is seen along a direction. It picks lobes, dims what lies below them, and makes up for the
// light that the single-scattering model loses.
//
// tools/make_albedo_tables.cpp writes the tables (albedo_tables.h) on the grids declared here.
// Between nodes they are interpolated linearly. Alphas beyond 1 and indices beyond 4 (or below
// 1 / 4) are taken at that bound. The white albedo of anisotropic reflection has a table of its
// own, and scales the other moments, looked up at the root mean square of the alphas. Anisotropic
// dielectrics are looked up at about the alpha along the view. tests/lobes measures and bounds the
// errors.
#pragma once

#include <array>
#include <cmath>

#include "lobes/ashikhmin_shirley.h"
#include "lobes/microfacet.h"

namespace weft::lobes {

namespace albedo_grid {
inline constexpr int cosines = 33; ///< odd: the dielectrics put a node on the critical angle
inline constexpr int alphas = 15;
inline constexpr int indices = 13;
// Anisotropic reflection: the greater alpha, the lesser over the greater, azimuth, cosine.
inline constexpr int greater_alphas = 10, alpha_ratios = 7, azimuths = 7, anisotropic_cosines = 17;
inline constexpr int area_alphas = 13, area_slopes = 33; ///< of ashikhmin_shirley_area
inline constexpr float max_contrast = 0.6f;              ///< (eta - 1) / (eta + 1) at eta = 4

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
/// All happens on the scale of alpha near grazing angles: takes [0, 1] onto itself with half of it
/// for cosines below alpha / 3 or so.
inline float cosine_coordinate(float c, float alpha) {
    return std::sqrt(c * (1 + alpha) / (c + alpha));
}
inline float cosine_at(float coordinate, float alpha) {
    float const q = square(coordinate);
    return std::min(alpha * q / (1 + alpha - q), 1.f);
}
/// For dielectrics: half of the nodes on the scale of alpha, half on that of Fresnel's equations.
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

/// Of the untinted dielectric; `eta` as in MicrofacetDielectric.
template <class Distribution>
DielectricAlbedo dielectric_albedo(Distribution const& distribution, Vec3 const& wo, float eta);

} // namespace weft::lobes
