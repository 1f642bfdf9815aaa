// A rough boundary between two dielectrics: Walter et al. 2007, "Microfacet models for refraction
// through rough surfaces", with visible-normal sampling and height-correlated shadowing on either
// side. Reflection and transmission share one microsurface and the exact Fresnel equations, each
// with a tint of its own. Radiance that crosses is scaled by 1 / eta^2 (see lobe.h).
//
// A refracted lobe is about alpha |eta - 1| wide and its half vector about |eta - 1| long. Floats
// resolve directions to about 1e-7, so that `eta` is kept max(1e-3, 1e-5 / alpha) away from 1
// (0.01 at alpha = 1e-3). A material that means exactly matched indices uses SpecularDielectric.
#pragma once

#include "lobes/albedo.h"
#include "lobes/fresnel.h"
#include "lobes/lobe.h"
#include "lobes/microfacet.h"

namespace weft::lobes {

template <class Distribution>
class MicrofacetDielectric {
  public:
    /// `eta` = index on the far side / index on wo's side, > 0. Tints are in [0, 1].
    MicrofacetDielectric(Distribution const& distribution, float eta,
                         Color const& reflectance = Color(1), Color const& transmittance = Color(1))
        : distribution_(distribution), eta_(resolvable_eta(distribution, eta)),
          reflectance_(reflectance), transmittance_(transmittance) {}

    static constexpr LobeFlags flags() {
        return LobeFlags::Reflection | LobeFlags::Transmission | LobeFlags::Glossy;
    }
    Distribution const& distribution() const { return distribution_; }
    float eta() const { return eta_; } ///< the one in use, off 1
    float eta_scale() const { return square(eta_); }
    Color const& reflectance() const { return reflectance_; }
    Color const& transmittance() const { return transmittance_; }

    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        return wi.z > 0   ? eval_reflection(wo, wi)
               : wi.z < 0 ? eval_transmission(wo, wi)
                          : LobeValue{};
    }

    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        float spare = u.z;
        Vec3 const m = distribution_.sample_visible_normal(wo, {u.x, u.y}, spare);
        float const cos_o = dot(wo, m);
        if (!(cos_o > 0)) return Vec3(0);
        float cos_t;
        float const fresnel = fresnel_dielectric(cos_o, eta_, cos_t);
        if (spare < reflect_probability(fresnel)) {
            Vec3 const wi = reflect(wo, m);
            return wi.z > 0 ? normalize(wi) : Vec3(0);
        }
        if (!(fresnel < 1)) return Vec3(0);
        Vec3 const wi = refract(wo, m, cos_o, cos_t, eta_);
        return wi.z < 0 ? wi : Vec3(0);
    }

    Color albedo(Vec3 const& wo) const {
        auto const [reflected, transmitted] = dielectric_albedo(distribution_, wo, eta_);
        return reflectance_ * reflected + transmittance_ * transmitted;
    }

  private:
    LobeValue eval_reflection(Vec3 const& wo, Vec3 const& wi) const {
        Vec3 const sum = wo + wi;
        float const sum_length = length(sum);
        Vec3 const h = sum * (1 / sum_length);
        // wo.h is half the length of the sum, and that is the same seen from wi.
        float const fresnel = fresnel_dielectric(0.5f * sum_length, eta_);
        float const sigma_o = distribution_.projected_area(wo);
        float const sigma_i = distribution_.projected_area(wi);
        float const quarter_density = 0.25f * distribution_.density(h);
        float const weight = shadowing_above(wo.z, sigma_o, wi.z, sigma_i);
        return {reflectance_ * (fresnel * quarter_density * weight / sigma_o),
                quarter_density / distribution_.sampling_area(wo, h, sigma_o) *
                    reflect_probability(fresnel)};
    }

    LobeValue eval_transmission(Vec3 const& wo, Vec3 const& wi) const {
        // Points to the side of the lower index; its length is also |wo.h + eta wi.h|.
        Vec3 const sum = wo + wi * eta_;
        float const sum2 = length_squared(sum);
        if (!(sum2 > 0)) return {};
        Vec3 const h = sum * ((eta_ > 1 ? -1.f : 1.f) / std::sqrt(sum2));
        float const cos_o = dot(wo, h), cos_i = dot(wi, h);
        if (!(cos_o > 0 && cos_i < 0)) return {};
        float const fresnel = fresnel_dielectric_cosines(cos_o, -cos_i, eta_);
        float const sigma_o = distribution_.projected_area(wo);
        float const sigma_i = distribution_.projected_area(wi);
        float const jacobian = -cos_i / sum2; // of h in wi, over eta^2
        float const density = distribution_.density(h) * cos_o * jacobian;
        float const weight = shadowing_across(wo.z, sigma_o, -wi.z, sigma_i);
        return {transmittance_ * ((1 - fresnel) * density * weight / sigma_o),
                density / distribution_.sampling_area(wo, h, sigma_o) * square(eta_) *
                    transmit_probability(fresnel)};
    }

    float reflect_probability(float fresnel) const {
        float const r = fresnel * average(reflectance_);
        float const t = (1 - fresnel) * average(transmittance_);
        return r > 0 ? r / (r + t) : 0.f;
    }
    float transmit_probability(float fresnel) const { return 1 - reflect_probability(fresnel); }

    static float resolvable_eta(Distribution const& d, float eta) {
        float const gap = std::max(1e-3f, 1e-5f / std::min(d.alpha_x, d.alpha_y));
        return eta >= 1 ? std::max(eta, 1 + gap) : std::min(eta, 1 / (1 + gap));
    }

    Distribution distribution_;
    float eta_;
    Color reflectance_, transmittance_;
};

using GgxDielectric = MicrofacetDielectric<Ggx>;
using BeckmannDielectric = MicrofacetDielectric<Beckmann>;
using AshikhminShirleyDielectric = MicrofacetDielectric<AshikhminShirley>;

static_assert(SmoothLobe<GgxDielectric> && SmoothLobe<BeckmannDielectric> &&
              SmoothLobe<AshikhminShirleyDielectric>);

} // namespace weft::lobes
