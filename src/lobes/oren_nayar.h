// Diffuse reflection off rough clay, stone or cloth: the energy-preserving Oren-Nayar model (EON;
// Portsmouth, Kutz, Hill 2024, "EON: A practical energy-preserving rough diffuse BRDF"; after Oren
// and Nayar 1994 and Fujii's reparametrisation of it). With A = 1 / (1 + c1 r), c1 = 1/2 - 2/(3
// pi),
//     f = rho A / pi (1 + r s / t) + rho_ms / pi (1 - E(o)) (1 - E(i)) / (1 - E_avg),
// where s = cos phi sin theta_o sin theta_i and t = max(cos_o, cos_i) where s > 0, else 1. E is the
// albedo of the first, singly scattered term for rho = 1 and E_avg its cosine-weighted mean; in
//     E(c) = A (1 + r g(c)),  E_avg = A (1 + r g_avg)
// g has a closed form, so that 1 - E = A r (c1 - g) keeps its digits as r vanishes. The second term
// returns what multiple scattering would: a white surface reflects all light. Reciprocal.
//
// Sampled as the paper does, by a clipped linearly transformed cosine mixed with the uniform
// hemisphere; the fits only steer the sampling, the density is exact.
#pragma once

#include "base/warp.h"
#include "lobes/lobe.h"

namespace weft::lobes {

class OrenNayar {
  public:
    /// `rho`: the colour of a single bounce, each channel in [0, 1]; with roughness 0 the albedo,
    /// and little more saturated than it otherwise. `roughness` in [0, 1]; 0 is Lambert.
    OrenNayar(Color const& rho, float roughness)
        : rho_(rho), roughness_(roughness), scale_(1 / (1 + kC1 * roughness)),
          uniform_(std::pow(roughness, 0.1f)) {}

    static constexpr LobeFlags flags() { return {ScatteringKind::Diffuse, Sides::Reflection}; }
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }

    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        if (!(wi.z > 0)) return {};
        float const s = wo.x * wi.x + wo.y * wi.y;
        // cos_i s / t, in the order that cannot overflow.
        float const retro = s * (s > 0 ? wi.z / std::max(wo.z, wi.z) : wi.z);
        float const single = scale_ * kInvPi * (wi.z + roughness_ * retro);
        float const multiple =
            scale_ * roughness_ * lack(wo.z) * lack(wi.z) * (kInvPi / (kC1 - kMeanG)) * wi.z;
        return {rho_ * std::max(single, 0.f) + multiple_color() * multiple,
                density(Steering(wo, roughness_, uniform_), wi)};
    }

    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        Steering const st(wo, roughness_, uniform_);
        if (u.z < st.uniform) {
            float const r = safe_sqrt(1 - u.x * u.x), phi = 2 * kPi * u.y;
            return {r * std::cos(phi), r * std::sin(phi), u.x};
        }
        float const r = std::sqrt(u.x), phi = 2 * kPi * u.y;
        float const y = r * std::sin(phi);
        float const x = -lerp(safe_sqrt(1 - y * y), r * std::cos(phi), st.clip);
        float const z = safe_sqrt(1 - x * x - y * y);
        Vec3 const w(st.a * x + st.b * z, st.c * y, std::max(st.d * x + z, 0.f));
        return normalize(
            Vec3(st.cos_phi * w.x - st.sin_phi * w.y, st.sin_phi * w.x + st.cos_phi * w.y, w.z));
    }

    /// Exact.
    Color albedo(Vec3 const& wo) const {
        float const lost = scale_ * roughness_ * lack(wo.z);
        return rho_ * (1 - lost) + multiple_color() * lost;
    }

  private:
    static constexpr float kC1 = 0.5f - 2 / 3.f * kInvPi;
    static constexpr float kMeanG = 2 / 3.f - 28 / 15.f * kInvPi; ///< of g, cosine-weighted

    /// c1 - g(c) >= 0, c in [0, 1].
    static float lack(float c) {
        float const s = safe_sqrt(1 - c * c);
        float const g = s * (std::acos(std::min(c, 1.f)) - s * c) +
                        2 / 3.f * s * (c * (1 + s + s * s) / (1 + s) - 1);
        return std::max(kC1 - kInvPi * g, 0.f);
    }

    /// rho_ms: light that bounced twice or more.
    Color multiple_color() const {
        float const mean = scale_ * (1 + roughness_ * kMeanG);
        return rho_ * rho_ * mean / (Color(1) - rho_ * (1 - mean));
    }

    /// The matrix ((a, 0, b), (0, c, 0), (d, 0, 1)), in the frame whose x-z plane holds wo, that
    /// maps clipped cosine directions to wi, and the share of uniform sampling (paper, listing 2).
    struct Steering {
        float a, b, c, d, clip, uniform, cos_phi, sin_phi;
        Steering(Vec3 const& wo, float r, float uniform_scale) {
            float const m = wo.z;
            a = 1 + r * (0.303392f + (-0.518982f + 0.111709f * m) * m +
                         (-0.276266f + 0.335918f * m) * r);
            b = r * (-1.16407f + 1.15859f * m + (0.150815f - 0.150105f * m) * r) /
                (m * m * m - 1.43545f);
            c = 1 + (0.20013f + (-0.506373f + 0.261777f * m) * m) * r;
            // The fit ends a rounding above 0; what is clipped assumes d <= 0.
            d = std::min((0.540852f + (-1.01625f + 0.475392f * m) * m) * r /
                             (-1.0743f + m * (0.0725628f + m)),
                         0.f);
            // The part of the unit disk whose image lies above the horizon.
            clip = 0.5f * (1 + 1 / std::sqrt(d * d + 1));
            uniform =
                uniform_scale * (0.162925f + m * (-0.372058f + (0.538233f - 0.290822f * m) * m));
            float const s = std::sqrt(wo.x * wo.x + wo.y * wo.y);
            cos_phi = s > 0 ? wo.x / s : 1.f;
            sin_phi = s > 0 ? wo.y / s : 0.f;
        }
    };

    static float density(Steering const& st, Vec3 const& wi) {
        float const x = st.cos_phi * wi.x + st.sin_phi * wi.y;
        float const y = st.cos_phi * wi.y - st.sin_phi * wi.x;
        // The adjugate maps wi back up to a factor of the determinant.
        float const minor = st.a - st.b * st.d, determinant = st.c * minor;
        Vec3 const h(st.c * (x - st.b * wi.z), minor * y, st.c * (st.a * wi.z - st.d * x));
        float const cosine = square(determinant / length_squared(h)) * std::max(h.z, 0.f);
        return lerp(kInvPi / st.clip * cosine, 0.5f * kInvPi, st.uniform);
    }

    Color rho_;
    float roughness_;
    float scale_;   ///< A
    float uniform_; ///< roughness^0.1
};

static_assert(SmoothLobe<OrenNayar>);

} // namespace weft::lobes
