// Sheen: the soft glow of fibres that stand on a surface, and of dust (Zeltner, Burley, Chiang
// 2022, "Practical multiple-scattering sheen using linearly transformed cosines"). The model is
// light scattered any number of times inside a layer of unit thickness and density of white SGGX
// microflakes (Heitz et al. 2015), fibre-like along the normal with cross section roughness^2. Its
// reflection is fitted by
//     f cos = R(o) D(i),  D(i) = max(i.z, 0) a^2 / (pi |(a i.x + b i.z, a i.y, i.z)|^4)
// in the frame whose x-z plane holds wo: a linearly transformed cosine, sampled exactly.
// tools/make_layer_tables.cpp walks the layer and writes R, a and b over roughness and angle; a and
// b are the maximum-likelihood fit (the paper minimises a cubic loss), with a kept above 0.05.
// White; the tint is the list's weight.
//
// The layer lets 1 - albedo through to what lies below it, which is not this lobe's concern.
// As a fit, not reciprocal.
#pragma once

#include "base/warp.h"
#include "lobes/lobe.h"

namespace weft::lobes {

/// What the tables say about one direction.
struct SheenCoefficients {
    float albedo = 0, a = 0, b = 0; ///< R in [0, 1]; a > 0, or 0: not looked up
};

/// roughness and cos_o in [0, 1]. The albedo is that of the layer to 2e-3.
SheenCoefficients sheen_coefficients(float roughness, float cos_o);
float sheen_albedo(float roughness, float cos_o);

/// The grid of the tables; coordinates in [0, 1]. Light that grazes smooth fibres keeps its height
/// but for steps of roughness^2, so that it turns back below cosines of about roughness^(4/3): half
/// of the nodes are on that scale. Roughnesses are from 0.01; below, only the scale changes.
namespace sheen_grid {
inline constexpr int roughnesses = 20, cosines = 28;
inline float roughness_coordinate(float roughness) { return (std::sqrt(roughness) - 0.1f) / 0.9f; }
inline float roughness_at(float coordinate) { return square(lerp(0.1f, 1.f, coordinate)); }
inline float cosine_coordinate(float c, float roughness) {
    float const scale = std::max(roughness * std::cbrt(roughness), 1e-6f);
    return 0.5f * (std::sqrt(c) + std::sqrt(c * (1 + scale) / (c + scale)));
}
/// By bisection, for the table's maker.
inline float cosine_at(float coordinate, float roughness) {
    float low = 0, high = 1;
    for (int i = 0; i < 40; ++i) {
        float const middle = 0.5f * (low + high);
        (cosine_coordinate(middle, roughness) < coordinate ? low : high) = middle;
    }
    return high;
}
} // namespace sheen_grid

struct Sheen {
    float roughness = 0.5f;        ///< in [0, 1]; 0 vanishes
    SheenCoefficients looked_up{}; ///< for the wo of `look_up`

    static constexpr LobeFlags flags() { return {ScatteringKind::Diffuse, Sides::Reflection}; }
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }

    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        if (!(wi.z > 0)) return {};
        SheenCoefficients const k = coefficients(wo);
        Vec2 const along = direction(wo);
        float const x = k.a * (along.x * wi.x + along.y * wi.y) + k.b * wi.z;
        float const y = k.a * (along.x * wi.y - along.y * wi.x);
        float const pdf = wi.z * square(k.a / (x * x + y * y + wi.z * wi.z)) * kInvPi;
        return {Color(k.albedo * pdf), pdf};
    }
    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        SheenCoefficients const k = coefficients(wo);
        Vec2 const along = direction(wo);
        Vec3 const w = square_to_cosine_hemisphere({u.x, u.y});
        float const x = w.x - k.b * w.z;
        return normalize(Vec3(along.x * x - along.y * w.y, along.y * x + along.x * w.y, k.a * w.z));
    }
    Color albedo(Vec3 const& wo) const {
        return Color(looked_up.a > 0 ? looked_up.albedo : sheen_albedo(roughness, wo.z));
    }

  private:
    SheenCoefficients coefficients(Vec3 const& wo) const {
        return looked_up.a > 0 ? looked_up : sheen_coefficients(roughness, wo.z);
    }
    /// Of wo's projection; any where that vanishes.
    static Vec2 direction(Vec3 const& wo) {
        float const r = std::sqrt(wo.x * wo.x + wo.y * wo.y);
        return r > 0 ? Vec2(wo.x / r, wo.y / r) : Vec2(1, 0);
    }
};

inline void look_up(Sheen& lobe, Vec3 const& wo) {
    lobe.looked_up = sheen_coefficients(lobe.roughness, wo.z);
}
inline Color look_up_albedo(Sheen& lobe, Vec3 const& wo) {
    look_up(lobe, wo);
    return Color(lobe.looked_up.albedo);
}

static_assert(SmoothLobe<Sheen>);

} // namespace weft::lobes
