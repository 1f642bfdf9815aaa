// Directional albedo of microfacet lobes from precomputed tables: the fraction of power that a lobe
// scatters when it is seen along a direction. It decides how often lobes are picked, how much light
// the layers below get, and how much light a single-scattering lobe must be given back.
//
// tools/make_albedo_tables.cpp writes the tables (albedo_tables.h) on the grids declared here, for
// each distribution and each kind of shadowing. Between nodes they are interpolated by cubics, to
// 5e-4, or 2e-3 where much is transmitted through rough surfaces. Every index has its place. All is
// for equal alphas, but for the white albedo of anisotropic reflection, which has a table of its
// own; the lobes add up what else they need. tests/lobes measures and bounds the errors.
#pragma once

#include <array>
#include <cmath>

#include "lobes/ashikhmin_shirley.h"
#include "lobes/microfacet.h"

namespace weft::lobes {

namespace albedo_grid {
inline constexpr int cosines = 40, alphas = 22;
inline constexpr int indices = 24;         ///< up to the infinite one
inline constexpr float least_root = 0.15f; ///< of the contrast (eta - 1) / (eta + 1) at 1.001
// Anisotropic reflection: the greater alpha, the lesser over the greater, azimuth, cosine.
inline constexpr int greater_alphas = 12, alpha_ratios = 9, azimuths = 10, anisotropic_cosines = 18;
inline constexpr int area_alphas = 13, area_slopes = 33; ///< of ashikhmin_shirley_area
inline constexpr int moments = 3;                        ///< of ReflectionMoments
inline constexpr int sides = 3;                          ///< of a dielectric, see DielectricSide

// Each coordinate is in [0, 1], the nodes being equally spaced in it.

/// For alphas from 1e-3 to 1. The fourth root keeps nodes where a cosine of 0.01 is but some
/// alphas.
inline constexpr float least_alpha_root = 0.17782794f;
inline float alpha_coordinate(float alpha) {
    return (std::sqrt(std::sqrt(alpha)) - least_alpha_root) / (1 - least_alpha_root);
}
inline float alpha_at(float coordinate) {
    return square(square(lerp(least_alpha_root, 1.f, coordinate)));
}
/// For ratios of alphas from 0.01 to 1; smaller ones are taken at that bound.
inline float ratio_coordinate(float ratio) { return (std::sqrt(ratio) - 0.1f) / 0.9f; }
inline float ratio_at(float coordinate) { return square(lerp(0.1f, 1.f, coordinate)); }
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
/// Takes [0, 1] onto itself with half of it for x below scale / 3 or so.
inline float stretched(float x, float scale) { return std::sqrt(x * (1 + scale) / (x + scale)); }
/// Half of the nodes on the scale of alpha, on which all happens near grazing angles, half on that
/// of Fresnel's equations.
inline float cosine_coordinate(float c, float alpha) {
    return 0.5f * (std::sqrt(c) + stretched(c, alpha));
}
/// Of `coordinate_of`, which increases in [0, 1]: by bisection, for the table's maker.
template <class F>
double inverse(double coordinate, F&& coordinate_of) {
    double low = 0, high = 1;
    for (int i = 0; i < 40; ++i) {
        double const middle = 0.5 * (low + high);
        (double(coordinate_of(float(middle))) < coordinate ? low : high) = middle;
    }
    return high;
}
inline double cosine_at(double coordinate, float alpha) {
    return inverse(coordinate, [alpha](float c) { return cosine_coordinate(c, alpha); });
}

/// Where light comes from, for dielectrics. Tables end at the critical angle, where smooth glass
/// has a kink.
enum class DielectricSide : uint8_t {
    Entering,   ///< the denser medium; the coordinate is that of the cosine
    Refracting, ///< from the denser one within the critical angle: that of the refracted cosine
    Total       ///< beyond it: dense at both ends, on the scale of alpha
};
struct DielectricPlace {
    DielectricSide side;
    float coordinate;
};
inline float total_coordinate(float c, float critical, float alpha) {
    float const x = c / critical, scale = alpha / critical;
    return 0.5f * (stretched(x, scale) + 1 - stretched(1 - x, scale));
}
inline DielectricPlace dielectric_place(float c, float eta, float alpha) {
    if (eta >= 1) return {DielectricSide::Entering, cosine_coordinate(c, alpha)};
    float const k = (eta - 1) * (eta + 1) + c * c;
    if (k >= 0)
        return {DielectricSide::Refracting,
                cosine_coordinate(std::min(std::sqrt(k) / eta, 1.f), alpha)};
    float const critical = std::sqrt((1 - eta) * (1 + eta));
    return {DielectricSide::Total, total_coordinate(c, critical, alpha)};
}
/// The cosine at a coordinate of a side, for an index `ratio` >= 1.
inline double dielectric_cosine_at(DielectricSide side, double coordinate, float ratio,
                                   float alpha) {
    if (side == DielectricSide::Entering) return cosine_at(coordinate, alpha);
    double const eta = 1 / double(ratio), critical = std::sqrt((1 - eta) * (1 + eta));
    if (side == DielectricSide::Refracting)
        return std::hypot(critical, eta * cosine_at(coordinate, alpha));
    return critical * inverse(coordinate, [&](float x) {
               return total_coordinate(x * float(critical), float(critical), alpha);
           });
}
/// What leaves rough glass at grazing angles spans decades: its logarithm is tabulated.
inline float power_coordinate(float power) {
    return 1 + std::log(std::max(power, 1e-4f)) / 9.2104f;
}
inline float power_at(float coordinate) { return std::exp((coordinate - 1) * 9.2104f); }
/// From 0 along the axis of the greater alpha to 1 along the other; u, v >= 0 are the components
/// of wo along them. Half of it lies where the lesser alpha begins to count.
inline float azimuth_coordinate(float u, float v, float ratio) {
    float const across = std::sqrt(ratio) * v, sum = u + across;
    return sum > 0 ? across / sum : 0.5f;
}
inline float area_slope_coordinate(float a) { return a < 1e6f ? a / (1 + a) : 1.f; }
inline float area_slope_at(float coordinate) { return coordinate / (1 - coordinate); }
} // namespace albedo_grid

/// The white reflection's power and where it comes from: c is the cosine between wo and the half
/// vector, and means are over the power.
struct ReflectionMoments {
    float white = 0;   ///< the albedo
    float schlick = 0; ///< albedo times mean (1 - c)^5
    float edge = 0;    ///< albedo times mean c (1 - c)^6
};

struct DielectricAlbedo {
    float reflected = 0, transmitted = 0; ///< fractions of power; what lacks to 1 is lost
};

// For Ggx, Beckmann and AshikhminShirley; wo is a local unit vector, wo.z in [0, 1].

template <class Distribution>
float white_albedo(Distribution const& distribution, Vec3 const& wo);

/// For equal alphas.
template <class Distribution>
ReflectionMoments reflection_moments(Distribution const& distribution, Vec3 const& wo);

/// Of the untinted dielectric of equal alphas; `eta` as in MicrofacetDielectric.
template <class Distribution>
DielectricAlbedo dielectric_albedo(Distribution const& distribution, Vec3 const& wo, float eta);

} // namespace weft::lobes
