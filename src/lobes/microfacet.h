// Microfacet distributions with Smith shadowing: GGX (Trowbridge and Reitz 1975; Walter et al.
// 2007) and Beckmann (Beckmann and Spizzichino 1963), both anisotropic. ashikhmin_shirley.h has a
// third with the same members.
//
// The usual G1 divides by cosines that vanish at grazing angles. Here everything is written with
// the projected area of the microsurface, sigma(w) = w.z / G1(w) = w.z (1 + Lambda(w)) (Heitz
// 2014, "Understanding the masking-shadowing function"), which stays positive:
//     density of visible normals   D(m) max(0, wo.m) / sigma(wo)
//     its reflection               D(m) / (4 sigma(wo))
// and G2 / G1(wo) comes as one quotient: what a sampled visible normal's contribution weighs.
// `Shadowing` says what G2 is.
//
// Samplers need not follow visible normals exactly: a distribution draws m with the density
// D(m) max(0, wo.m) / sampling_area(wo, m, sigma(wo)), or, for lobes that only reflect, with
// reflecting_area in that place, which keeps off normals that reflect below the surface. It may
// decide by a third number, `spare` in [0, 1), and then stretches what is left of that again.
//
// Alphas are in [1e-3, 1], clamped by whoever makes them: float directions resolve no less.
// Left out: light that meets the microsurface more than once.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace weft::lobes {

/// What G2, the fraction of facets that both directions see, makes of both directions' own.
enum class Shadowing : uint8_t {
    /// G1(wo) G1(wi), as if being seen and being lit were independent (Walter et al. 2007, eq. 23).
    Separable,
    /// High facets are both seen and lit: 1 / (1 + Lo + Li) above the surface (Heitz 2014, eq. 99),
    /// B(1 + Lo, 1 + Li) across it (Heitz et al. 2016, "Multiple-scattering microfacet BSDFs with
    /// the Smith model"; B is the beta function). Brighter, above all at grazing angles.
    Correlated
};

/// G2 / G1(wo) for wi above the surface, in [0, 1]; the sigmas are projected areas.
inline float shadowing_above(Shadowing shadowing, float cos_o, float sigma_o, float cos_i,
                             float sigma_i) {
    if (shadowing == Shadowing::Separable)
        return sigma_i > 0 ? std::min(cos_i / sigma_i, 1.f) : 0.f;
    float const numerator = sigma_o * cos_i;
    float const denominator = numerator + (sigma_i - cos_i) * cos_o;
    return denominator > 0 ? std::min(numerator / denominator, 1.f) : 0.f;
}

/// Gamma(2 + a) Gamma(1 + b) / Gamma(2 + a + b) = (1 + a) B(1 + a, 1 + b) for a, b in [0, 1e5],
/// by Stirling's series three steps up; relative error below 1e-4.
inline float scaled_beta(float a, float b) {
    constexpr float sqrt_two_pi = 2.5066282746f;
    float const x = a + 5, y = b + 4, w = a + b + 5;
    auto const series = [](float z) {
        float const r = 1 / z;
        return r * (1 / 12.f - r * r * (1 / 360.f));
    };
    float const exponent = -(x - 0.5f) * std::log1p(b / x) - b * std::log1p((a + 1) / y) - 4 +
                           series(x) + series(y) - series(w);
    float const powers = y * y * y * std::sqrt(y) * sqrt_two_pi;
    float const steps_a = (a + b + 2) * (a + b + 3) * (a + b + 4) / ((a + 2) * (a + 3) * (a + 4));
    float const steps_b = powers / ((b + 1) * (b + 2) * (b + 3));
    return std::exp(exponent) * steps_a * steps_b;
}

/// G2 / G1(wo) for wi below the surface, in [0, 1]; both cosines as absolute values.
inline float shadowing_across(Shadowing shadowing, float cos_o, float sigma_o, float cos_i,
                              float sigma_i) {
    if (shadowing == Shadowing::Separable)
        return sigma_i > 0 ? std::min(cos_i / sigma_i, 1.f) : 0.f;
    // Beyond 1e5 the value is 0 for all that floats can tell; std::min also takes x / 0.
    float const lambda_o = std::min(std::max(sigma_o - cos_o, 0.f) / cos_o, 1e5f);
    float const lambda_i = std::min(std::max(sigma_i - cos_i, 0.f) / cos_i, 1e5f);
    if (!(lambda_i > 0)) return lambda_i == 0 ? 1.f : 0.f;
    return std::min(scaled_beta(lambda_o, lambda_i), 1.f);
}

/// The greater alpha of a distribution: its width where it is widest.
template <class Distribution>
float widest_alpha(Distribution const& d) {
    return std::max(d.alpha_x, d.alpha_y);
}

struct Ggx {
    float alpha_x = 0.1f, alpha_y = 0.1f; ///< along local x and y
    Shadowing shadowing = Shadowing::Correlated;

    /// D(m) per solid angle of the unit normal m; 0 below the horizon.
    float density(Vec3 const& m) const {
        if (!(m.z > 0)) return 0;
        float const e = square(m.x / alpha_x) + square(m.y / alpha_y) + square(m.z);
        return 1 / (kPi * alpha_x * alpha_y * e * e);
    }
    /// sigma(w) for w on either side (the surface is symmetric).
    float projected_area(Vec3 const& w) const {
        float const z = std::abs(w.z);
        return 0.5f * (z + std::sqrt(square(alpha_x * w.x) + square(alpha_y * w.y) + z * z));
    }
    Vec3 sample_visible_normal(Vec3 const& wo, Vec2 u, float&) const {
        return sample_cap(wo, u, 0);
    }
    float sampling_area(Vec3 const&, Vec3 const&, float sigma_o) const { return sigma_o; }

    /// Of the visible normals mostly those that reflect to above the surface: Eto and Tokuyoshi
    /// 2023, "Bounded VNDF sampling for Smith-GGX reflections".
    Vec3 sample_reflecting_normal(Vec3 const& wo, Vec2 u, float&) const {
        return sample_cap(wo, u, cap_shrinkage(wo));
    }
    float reflecting_area(Vec3 const& wo, Vec3 const&, float sigma_o) const {
        return sigma_o - 0.5f * cap_shrinkage(wo) * wo.z;
    }

  private:
    /// 1 - k, where the bounded cap ends at the height -k w.z (eq. 5 there; k without its
    /// cancellation).
    float cap_shrinkage(Vec3 const& wo) const {
        float const a2 = square(std::min(alpha_x, alpha_y)), z2 = square(wo.z);
        float const s2 = square(1 + std::sqrt(wo.x * wo.x + wo.y * wo.y));
        return a2 * (s2 + z2) / (s2 + a2 * z2);
    }
    /// A visible normal by spherical caps: Dupuy and Benyoub 2023, "Sampling visible GGX normals
    /// with spherical caps". The cap holds z in ((shrinkage - 1) w.z, 1].
    Vec3 sample_cap(Vec3 const& wo, Vec2 u, float shrinkage) const {
        Vec3 const w = normalize(Vec3(alpha_x * wo.x, alpha_y * wo.y, wo.z));
        float const phi = 2 * kPi * u.x;
        // Heights are kept relative to w's and to the pole's antipode, where the subtraction
        // would eat the tail of the distribution.
        float const cut = shrinkage * w.z;
        float const above = (1 - u.y) * (1 + w.z - cut) + cut;
        float const one_plus_z = above + (w.x * w.x + w.y * w.y) / (1 + w.z);
        float const r = safe_sqrt(one_plus_z * (2 - one_plus_z));
        return normalize(
            Vec3(alpha_x * (r * std::cos(phi) + w.x), alpha_y * (r * std::sin(phi) + w.y), above));
    }
};

/// The inverse error function for |x| < 1: M. Giles 2010, "Approximating the erfinv function",
/// single precision. Arguments at or beyond +-1 are taken as the nearest float inside.
inline float erf_inverse(float x) {
    x = std::min(std::max(x, -kOneMinusEpsilon), kOneMinusEpsilon);
    float w = -std::log((1 - x) * (1 + x)), p;
    auto const horner = [&p, &w](auto... c) { ((p = p * w + c), ...); };
    if (w < 5) {
        w -= 2.5f;
        p = 2.81022636e-08f;
        horner(3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f, 0.00021858087f, -0.00125372503f,
               -0.00417768164f, 0.246640727f, 1.50140941f);
    } else {
        w = std::sqrt(w) - 3;
        p = -0.000200214257f;
        horner(0.000100950558f, 0.00134934322f, -0.00367342844f, 0.00573950773f, -0.0076224613f,
               0.00943887047f, 1.00167406f, 2.83297682f);
    }
    return p * x;
}

struct Beckmann {
    float alpha_x = 0.1f, alpha_y = 0.1f; ///< along local x and y
    Shadowing shadowing = Shadowing::Correlated;

    /// D(m) per solid angle of the unit normal m; 0 below the horizon.
    float density(Vec3 const& m) const {
        float const z2 = m.z * m.z;
        float const e = (square(m.x / alpha_x) + square(m.y / alpha_y)) / z2;
        if (!(m.z > 0) || !(e < 80)) return 0;
        return std::exp(-e) / (kPi * alpha_x * alpha_y * z2 * z2);
    }
    /// sigma(w) for w on either side (the surface is symmetric).
    float projected_area(Vec3 const& w) const {
        float const z = std::abs(w.z);
        float const s = std::sqrt(square(alpha_x * w.x) + square(alpha_y * w.y));
        if (z > 4 * s) return z; // the rest is below 1e-9 of z
        float const a = z / s;
        return 0.5f * (z * (1 + std::erf(a)) + s * (kInvSqrtPi * std::exp(-a * a)));
    }
    /// A visible normal by its slopes: Heitz and d'Eon 2014, "Importance sampling microfacet-based
    /// BSDFs using the distribution of visible normals".
    Vec3 sample_visible_normal(Vec3 const& wo, Vec2 u, float&) const {
        Vec3 const w = normalize(Vec3(alpha_x * wo.x, alpha_y * wo.y, wo.z));
        float const s = std::sqrt(w.x * w.x + w.y * w.y);
        float const along = visible_slope(w.z, s, u.x), across = erf_inverse(2 * u.y - 1);
        float const cos_phi = s > 0 ? w.x / s : 1.f, sin_phi = s > 0 ? w.y / s : 0.f;
        return normalize(Vec3(-alpha_x * (along * cos_phi - across * sin_phi),
                              -alpha_y * (along * sin_phi + across * cos_phi), 1));
    }
    Vec3 sample_reflecting_normal(Vec3 const& wo, Vec2 u, float& spare) const {
        return sample_visible_normal(wo, u, spare);
    }
    float sampling_area(Vec3 const&, Vec3 const&, float sigma_o) const { return sigma_o; }
    float reflecting_area(Vec3 const&, Vec3 const&, float sigma_o) const { return sigma_o; }

  private:
    static constexpr float kInvSqrtPi = 0.56418958354775628695f;

    /// Inverts the distribution of the slope x along the view, density proportional to
    /// (c - s x) exp(-x^2) for x < c / s, (s, c) being the view's sine and cosine. Its integral
    /// g(x) = c erfc(-x) + s exp(-x^2) / sqrt(pi) is log-concave, so that Newton's method on
    /// log g climbs to the root from the left after at most one step.
    static float visible_slope(float c, float s, float u) {
        float const at_normal = erf_inverse(2 * u - 1);
        if (s < 1e-6f * c) return at_normal;
        float const cot = c / s, tail = s * kInvSqrtPi;
        float const total = c * (1 + std::erf(cot)) + tail * std::exp(-cot * cot);
        float const p = std::max(u, 0x1p-26f), target = p * total;
        float const at_grazing = -std::sqrt(-std::log(p));
        float x = std::min(lerp(at_grazing, at_normal, c), cot);
        for (int i = 0; i < 12; ++i) {
            float const e = std::exp(-x * x);
            float const g = c * std::erfc(-x) + tail * e;
            float const slope = 2 * kInvSqrtPi * (c - s * x) * e;
            if (!(slope > 1e-6f * g)) { // near the end of the range: start again from the left
                x -= 0.1f;
                continue;
            }
            float const step = std::min(g / slope * std::log(target / g), 1.f);
            x = std::min(std::max(x + step, -6.f), cot);
            if (std::abs(step) < 1e-4f) break; // converges quadratically: the error is its square
        }
        return x;
    }
};

/// Calls f(m, share) for n fixed visible normals m, the points of a lattice; the mean of what is
/// scattered off visible normals is about the sum of that times the shares.
template <class Distribution, class F>
void for_visible_normals(Distribution const& d, Vec3 const& wo, float sigma_o, int n, F&& f) {
    for (int i = 0; i < n; ++i) {
        // By the golden ratio; what only decides goes by the plastic number.
        float const turn = 0.61803399f * float(i), spin = 0.75487767f * float(i);
        float spare = spin - std::floor(spin);
        Vec2 const u(turn - std::floor(turn), (float(i) + 0.5f) / float(n));
        Vec3 const m = d.sample_visible_normal(wo, u, spare);
        f(m, d.sampling_area(wo, m, sigma_o) / (sigma_o * float(n)));
    }
}

} // namespace weft::lobes
