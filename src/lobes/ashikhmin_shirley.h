// The anisotropic Phong distribution of Ashikhmin and Shirley 2000 ("An anisotropic Phong BRDF
// model") as a microfacet distribution (see microfacet.h for what its members mean):
//     D(m) = m.z^(2 q - 2) / (pi alpha_x alpha_y),
//     q = (cos phi / alpha_x)^2 + (sin phi / alpha_y)^2,
// which turns alphas into Phong exponents as Walter et al. 2007 do (n = 2 / alpha^2 - 2), so that
// one roughness looks alike in all distributions. Its tail lies below Beckmann's.
//
// Smith's projected area has no closed form. Walter et al. borrow Beckmann's, which lets the
// surface reflect more than it receives as alpha nears 1; here the isotropic integral is
// tabulated. Anisotropic surfaces are not stretched isotropic ones: they take it at the greater
// alpha for its shape and at the alpha along the view for its scale, which shadows by up to a
// third too much at grazing angles, but never too little. This is Smith-like, not Smith.
//
// Normals are drawn by D(m) m.z, then swapped with their mirror image (-m.x, -m.y, m.z) as often
// as the view sees that side of the V between them (Heitz and d'Eon 2014, "Importance sampling
// microfacet-based BSDFs using the distribution of visible normals", on V-cavities): the density
// is D(m) min(wo.m / wo.z, 2 m.z), and none is wasted on normals that face away.
#pragma once

#include "lobes/microfacet.h"

namespace weft::lobes {

/// (sigma - cos) / (alpha sin) of the isotropic distribution, for alpha in [0, 1] and a = cos /
/// (alpha sin) >= 0, from a table (tools/make_albedo_tables.cpp). Error below 1e-3.
float ashikhmin_shirley_area(float alpha, float a);

struct AshikhminShirley {
    float alpha_x = 0.1f, alpha_y = 0.1f; ///< along local x and y
    Shadowing shadowing = Shadowing::Correlated;

    /// D(m) per solid angle of the unit normal m; 0 below the horizon.
    float density(Vec3 const& m) const {
        if (!(m.z > 0)) return 0;
        float const s2 = m.x * m.x + m.y * m.y;
        float const e = square(m.x / alpha_x) + square(m.y / alpha_y);
        // 2 log(m.z) / sin^2, from whichever of the two has the digits.
        float const ratio = s2 < 1e-8f  ? -1.f
                            : s2 < 0.5f ? std::log1p(-s2) / s2
                                        : 2 * std::log(m.z) / s2;
        return std::exp((e - s2) * ratio) / (kPi * alpha_x * alpha_y);
    }
    /// sigma(w) for w on either side (the surface is symmetric).
    float projected_area(Vec3 const& w) const {
        float const z = std::abs(w.z);
        float const t = std::sqrt(square(alpha_x * w.x) + square(alpha_y * w.y));
        return t > 0 ? z + t * ashikhmin_shirley_area(std::max(alpha_x, alpha_y), z / t) : z;
    }
    Vec3 sample_visible_normal(Vec3 const& wo, Vec2 u, float& spare) const {
        float const psi = 2 * kPi * u.x;
        float const x = alpha_x * std::cos(psi), y = alpha_y * std::sin(psi);
        float const r2 = x * x + y * y; // 1 / q
        float const log_z = 0.5f * r2 * std::log(1 - u.y);
        float const scale = safe_sqrt(-std::expm1(2 * log_z) / r2);
        Vec3 m{x * scale, y * scale, std::exp(log_z)};
        float const seen = dot(wo, m), mirror_seen = 2 * wo.z * m.z - seen;
        float const keep = mirror_seen > 0 ? std::max(seen, 0.f) / (2 * wo.z * m.z) : 1.f;
        bool const swap = spare >= keep;
        spare = swap ? (spare - keep) / (1 - keep) : spare / keep;
        spare = std::min(spare, kOneMinusEpsilon);
        return swap ? Vec3(-m.x, -m.y, m.z) : m;
    }
    float sampling_area(Vec3 const& wo, Vec3 const& m, float) const {
        return std::max(wo.z, 0.5f * dot(wo, m) / m.z);
    }
    Vec3 sample_reflecting_normal(Vec3 const& wo, Vec2 u, float& spare) const {
        return sample_visible_normal(wo, u, spare);
    }
    float reflecting_area(Vec3 const& wo, Vec3 const& m, float sigma_o) const {
        return sampling_area(wo, m, sigma_o);
    }
};

} // namespace weft::lobes
