// Diffuse reflection with the retroreflection of rough surfaces, fitted to measured materials
// (Burley 2012, "Physically-based shading at Disney", 5.3). With a(c) = (1 - c)^5,
//     f = 1 / (pi A(o)) (1 + F a(cos_o)) (1 + F a(cos_i)),  F = F_D90 - 1 = 2 r cos^2 theta_d -
//     1/2.
// White; the tint is the list's weight.
//
// As published, with A = 1, it gives back from 0.49 to 1.56 times what it receives at grazing
// angles: smooth surfaces lose light, rough ones gain some. F = (r - 1/2) + r wo.wi makes that
// albedo A a polynomial in cos_o. Divided by it the surface is white from everywhere, as
// compensated microfacets are (microfacet_reflection.h), and like them not reciprocal.
#pragma once

#include "base/warp.h"
#include "lobes/lobe.h"

namespace weft::lobes {

struct BurleyDiffuse {
    float roughness = 0.5f; ///< in [0, 1]

    static constexpr LobeFlags flags() { return {ScatteringKind::Diffuse, Sides::Reflection}; }
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }

    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        float const pdf = cosine_hemisphere_pdf(wi.z);
        float const grazing = roughness - 0.5f + roughness * dot(wo, wi);
        float const f = (1 + grazing * fifth(wo.z)) * (1 + grazing * fifth(wi.z));
        return {Color(pdf * f / published_albedo(wo.z)), pdf};
    }
    Vec3 sample(Vec3 const&, Vec3 const& u) const {
        return square_to_cosine_hemisphere({u.x, u.y});
    }
    static Color albedo(Vec3 const&) { return Color(1); }

    /// A, of the model as published: the moments of c^k a(c) over the hemisphere, 1/42, 1/168 and
    /// 1/504 for k = 1, 2, 3, put together. cos_o in [0, 1].
    float published_albedo(float cos_o) const {
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
