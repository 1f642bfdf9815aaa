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
    float albedo, a, b; ///< R in [0, 1]; a > 0
};

/// roughness and cos_o in [0, 1].
SheenCoefficients sheen_coefficients(float roughness, float cos_o);
float sheen_albedo(float roughness, float cos_o);

/// The grid of the tables; coordinates in [0, 1], roughness being its own.
namespace sheen_grid {
inline constexpr int roughnesses = 16, cosines = 16;
inline float cosine_coordinate(float c) { return std::sqrt(c); }
inline float cosine_at(float coordinate) { return square(coordinate); }
} // namespace sheen_grid

struct Sheen {
    float roughness = 0.5f; ///< in [0, 1]; 0 vanishes

    static constexpr LobeFlags flags() { return {ScatteringKind::Diffuse, Sides::Reflection}; }
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }

    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        if (!(wi.z > 0)) return {};
        SheenCoefficients const k = sheen_coefficients(roughness, wo.z);
        Vec2 const along = direction(wo);
        float const x = k.a * (along.x * wi.x + along.y * wi.y) + k.b * wi.z;
        float const y = k.a * (along.x * wi.y - along.y * wi.x);
        float const pdf = wi.z * square(k.a / (x * x + y * y + wi.z * wi.z)) * kInvPi;
        return {Color(k.albedo * pdf), pdf};
    }
    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        SheenCoefficients const k = sheen_coefficients(roughness, wo.z);
        Vec2 const along = direction(wo);
        Vec3 const w = square_to_cosine_hemisphere({u.x, u.y});
        float const x = w.x - k.b * w.z;
        return normalize(Vec3(along.x * x - along.y * w.y, along.y * x + along.x * w.y, k.a * w.z));
    }
    Color albedo(Vec3 const& wo) const { return Color(sheen_albedo(roughness, wo.z)); }

  private:
    /// Of wo's projection; any where that vanishes.
    static Vec2 direction(Vec3 const& wo) {
        float const r = std::sqrt(wo.x * wo.x + wo.y * wo.y);
        return r > 0 ? Vec2(wo.x / r, wo.y / r) : Vec2(1, 0);
    }
};

static_assert(SmoothLobe<Sheen>);

} // namespace weft::lobes
