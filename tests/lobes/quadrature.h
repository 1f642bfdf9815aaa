// The albedo of a smooth lobe by its own samples, over a low-discrepancy sequence; and more
// precisely that of a microsurface by its facets.
#pragma once

#include "lobes/fresnel.h"
#include "lobes/lobe.h"
#include "lobes/microfacet.h"

namespace weft::lobes::testing {

/// u of a low-discrepancy sequence: M. Roberts 2018, the R3 sequence.
inline Vec3 r3(int i) {
    auto const part = [&](double a) { return float(std::fmod(0.5 + a * (i + 1), 1.0)); };
    Vec3 const u(part(0.8191725133961645), part(0.6710436067037893), part(0.5497004779019703));
    return {std::min(u.x, kOneMinusEpsilon), std::min(u.y, kOneMinusEpsilon),
            std::min(u.z, kOneMinusEpsilon)};
}

template <class L>
Color quadrature_albedo(L lobe, Vec3 const& wo, int samples) {
    look_up(lobe, wo);
    Vec3d sum(0);
    for (int i = 0; i < samples; ++i) {
        Vec3 const wi = lobe.sample(wo, r3(i));
        if (wi == Vec3(0)) continue;
        LobeValue const v = lobe.eval(wo, wi);
        if (!(v.pdf > 0)) continue;
        Color const w = v.f * (eta_scale_towards(lobe, wi) / v.pdf);
        sum += Vec3d(w.r, w.g, w.b);
    }
    return {float(sum.x / samples), float(sum.y / samples), float(sum.z / samples)};
}

/// Fractions of power that leave after one scattering off facets.
struct FacetAlbedo {
    double white = 0;                      ///< where all facets are mirrors
    double reflected = 0, transmitted = 0; ///< of a dielectric
};

/// The integral over facets by their slopes, at the points of a Fibonacci lattice: error below 3e-4
/// of the value. It asks the distribution for its density and its areas alone. `eta` 0: no
/// dielectric.
template <class Distribution>
FacetAlbedo facet_albedo(Distribution const& d, Vec3 const& wo, float eta, int samples = 17711) {
    FacetAlbedo sum;
    float const area_o = d.projected_area(wo);
    for (int i = 0; i < samples; ++i) {
        // Slopes in units of alpha: t / (1 - t) from the pole out.
        double const t = (i + 0.5) / samples, turn = 0.61803398874989484820 * i;
        double const phi = 2 * 3.14159265358979 * (turn - std::floor(turn)), slope = t / (1 - t);
        double const x = slope * std::cos(phi) * double(d.alpha_x),
                     y = slope * std::sin(phi) * double(d.alpha_y);
        double const z = 1 / std::sqrt(1 + x * x + y * y);
        Vec3 const m(float(x * z), float(y * z), float(z));
        float const cos_o = std::min(dot(wo, m), 1.f);
        if (!(cos_o > 0)) continue;
        // d omega = dx dy z^3.
        double const measure = 2 * 3.14159265358979 * slope / ((1 - t) * (1 - t)) *
                               double(d.alpha_x * d.alpha_y) * z * z * z / samples;
        double const share = measure * double(d.density(m) * cos_o / area_o);
        float cos_t = 0;
        double const fresnel = eta > 0 ? double(fresnel_dielectric(cos_o, eta, cos_t)) : 1.0;
        if (Vec3 const r = reflect(wo, m); r.z > 0) {
            double const w = share * double(shadowing_above(d.shadowing, wo.z, area_o, r.z,
                                                            d.projected_area(r)));
            sum.white += w;
            sum.reflected += w * fresnel;
        }
        if (!(fresnel < 1)) continue;
        if (Vec3 const b = refract(wo, m, cos_o, cos_t, eta); b.z < 0)
            sum.transmitted +=
                share * (1 - fresnel) *
                double(shadowing_across(d.shadowing, wo.z, area_o, -b.z, d.projected_area(b)));
    }
    return sum;
}

} // namespace weft::lobes::testing
