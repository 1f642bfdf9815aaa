// A thin coat of varnish: the second specular lobe of Burley 2012, "Physically-based shading at
// Disney", 5.6 and appendix B.
//     f = F D G1(o) G1(i) / (4 cos_o cos_i)
// D is the generalised Trowbridge-Reitz distribution of exponent 1 (GTR1), whose tail is longer
// than that of GGX,
//     D(m) = (a^2 - 1) / (pi ln(a^2) (1 + (a^2 - 1) m.z^2)),
// G1 is Smith's shadowing of GGX with the fixed alpha 0.25 of the paper, and F Schlick's
// approximation from an index of refraction. White; the strength (a quarter, with Disney) is the
// list's weight. Half vectors are sampled by D m.z. Reciprocal.
#pragma once

#include "lobes/fresnel.h"
#include "lobes/lobe.h"

namespace weft::lobes {

/// The grid of the albedo tables; coordinates in [0, 1], of alphas from 1e-3.
namespace clearcoat_grid {
inline constexpr int alphas = 14, cosines = 24;
inline constexpr float max_alpha = 0.5f, least_root = 0.21147425f; ///< of 1e-3 / max_alpha
inline float alpha_coordinate(float alpha) {
    return (std::sqrt(std::sqrt(alpha / max_alpha)) - least_root) / (1 - least_root);
}
inline float alpha_at(float coordinate) {
    return square(square(lerp(least_root, 1.f, coordinate))) * max_alpha;
}
inline float cosine_coordinate(float c) { return std::sqrt(c); }
inline float cosine_at(float coordinate) { return square(coordinate); }
} // namespace clearcoat_grid

/// From a table, to 5e-4; cos_o in [0, 1].
float clearcoat_albedo(float alpha, float f0, float cos_o);

class Clearcoat {
  public:
    static constexpr float min_alpha = 1e-3f, max_alpha = clearcoat_grid::max_alpha;

    /// `alpha`: the width of D, clamped to [1e-3, 0.5]; Disney's run from 0.1 (satin) to 1e-3
    /// (gloss). `ior` in [1, 3] relative to what is outside: with the fixed shadowing, a wide D of
    /// ior about 4 would give back more than it receives.
    explicit Clearcoat(float alpha, float ior = 1.5f)
        : alpha2_(square(std::min(std::max(alpha, min_alpha), max_alpha))), f0_(fresnel_f0(ior)),
          log_alpha2_(std::log(alpha2_)) {}

    static constexpr LobeFlags flags() { return {ScatteringKind::Glossy, Sides::Reflection}; }
    /// The alpha of D, though half of its facets lean by more than its root.
    float width() const { return std::sqrt(alpha2_); }
    static constexpr float eta_scale() { return 1; }

    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        if (!(wi.z > 0)) return {};
        Vec3 const sum = wo + wi;
        float const l = length(sum); // 2 cos theta_d
        float const z = std::min(sum.z / l, 1.f);
        // 1 + (a^2 - 1) z^2 from the half vector's sine, which keeps the peak's digits.
        float const sin2 = (square(sum.x) + square(sum.y)) / (l * l);
        float const d = (alpha2_ - 1) / (kPi * log_alpha2_ * (sin2 + alpha2_ * z * z));
        return {Color(fresnel(0.5f * l) * d * masked(wo.z) * masked(wi.z) * wi.z * 0.25f),
                d * z / (2 * l)};
    }
    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        // D m.z integrates to ln(1 + (1 / a^2 - 1) sin^2) / -ln(a^2): inverted.
        float const sin2 = alpha2_ * std::expm1(-u.x * log_alpha2_) / (1 - alpha2_);
        float const s = std::sqrt(std::min(sin2, 1.f)), phi = 2 * kPi * u.y;
        Vec3 const m(s * std::cos(phi), s * std::sin(phi), safe_sqrt(1 - sin2));
        if (!(dot(wo, m) > 0)) return Vec3(0);
        Vec3 const wi = reflect(wo, m);
        return wi.z > 0 ? normalize(wi) : Vec3(0);
    }
    Color albedo(Vec3 const& wo) const {
        return Color(clearcoat_albedo(std::sqrt(alpha2_), f0_, wo.z));
    }

    float f0() const { return f0_; }

  private:
    float fresnel(float cos_d) const {
        float const m = std::max(1 - cos_d, 0.f), m2 = m * m;
        return f0_ + (1 - f0_) * (m2 * m2 * m);
    }
    /// G1(w) / w.z for GGX of alpha 0.25.
    static float masked(float c) {
        constexpr float a2 = 0.25f * 0.25f;
        return 2 / (c + std::sqrt(a2 + (1 - a2) * c * c));
    }

    float alpha2_, f0_, log_alpha2_;
};

static_assert(SmoothLobe<Clearcoat>);

} // namespace weft::lobes
