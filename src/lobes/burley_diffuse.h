// Diffuse reflection with the retroreflection of rough surfaces, fitted to measured materials
// (Burley 2012, "Physically-based shading at Disney", 5.3). With a(c) = (1 - c)^5,
//     f = 1 / pi (1 + F a(cos_o)) (1 + F a(cos_i)),  F = F_D90 - 1 = 2 r cos^2 theta_d - 1/2.
// White; the tint is the list's weight.
//
// As published it gives back up to 1.56 times what it receives, at grazing angles and for great
// roughness. F = (r - 1/2) + r wo.wi makes its albedo A a polynomial in cos_o, and here the value
// is multiplied by
//     min(1, 1 / A(o), 1 / A(i)),
// so that no direction gives back more than it receives, and reciprocity holds. Two directions that
// both gave less keep the published value. (Lagarde and de Rousiers 2014 scale all directions
// by a linear function of r instead, which darkens rough surfaces by a third.)
#pragma once

#include "base/warp.h"
#include "lobes/lobe.h"

namespace weft::lobes {

/// The albedo of the limited model; cos_o and roughness in [0, 1]. From a table: mean error 0.001,
/// worst 0.013.
float burley_diffuse_albedo(float roughness, float cos_o);

/// The grid of that table; coordinates in [0, 1], roughness being its own.
namespace burley_grid {
inline constexpr int roughnesses = 16, cosines = 16;
inline float cosine_coordinate(float c) { return std::sqrt(c); }
inline float cosine_at(float coordinate) { return square(coordinate); }
} // namespace burley_grid

struct BurleyDiffuse {
    float roughness = 0.5f; ///< in [0, 1]

    static constexpr LobeFlags flags() { return {ScatteringKind::Diffuse, Sides::Reflection}; }
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }

    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        float const pdf = cosine_hemisphere_pdf(wi.z);
        float const grazing = roughness - 0.5f + roughness * dot(wo, wi);
        float const f = (1 + grazing * fifth(wo.z)) * (1 + grazing * fifth(wi.z));
        float const limit =
            std::max({1.f, unlimited_albedo(wo.z), unlimited_albedo(std::max(wi.z, 0.f))});
        return {Color(pdf * f / limit), pdf};
    }
    Vec3 sample(Vec3 const&, Vec3 const& u) const {
        return square_to_cosine_hemisphere({u.x, u.y});
    }
    Color albedo(Vec3 const& wo) const { return Color(burley_diffuse_albedo(roughness, wo.z)); }

    /// Of the model as published: the moments of c^k a(c) over the hemisphere, 1/42, 1/168 and
    /// 1/504 for k = 1, 2, 3, put together. cos_o in [0, 1].
    float unlimited_albedo(float cos_o) const {
        float const r = roughness, k = r - 0.5f, c = cos_o;
        float const once = k * (1 / 21.f) + r * c * (1 / 84.f);
        float const twice = k * k * (1 / 21.f) + k * r * c * (1 / 42.f) +
                            r * r * (c * c * (1 / 252.f) + (1 - c * c) * (11 / 504.f));
        return 1 + once + fifth(c) * (k + r * c * (2 / 3.f) + twice);
    }

  private:
    static float fifth(float c) {
        float const m = std::min(std::max(1 - c, 0.f), 1.f), m2 = m * m;
        return m2 * m2 * m;
    }
};

static_assert(SmoothLobe<BurleyDiffuse>);

} // namespace weft::lobes
