// A rough boundary between two dielectrics: Walter et al. 2007, "Microfacet models for refraction
// through rough surfaces", with visible-normal sampling. Reflection and transmission share one
// microsurface, whose facets share light out as dielectric_boundary.h says, each with a tint of its
// own. Radiance that crosses is scaled by 1 / eta^2 (see lobe.h).
//
// Where `compensated`, what single scattering loses comes back by the factor 1 / E(wo), E being
// the untinted boundary's albedo (Turquin 2019; see microfacet_reflection.h), so that untinted
// glass of any roughness keeps all light. Tints act once. E is rounded up by what tables and sums
// may lack, so that no light is gained.
//
// Plain isotropic boundaries look E up in tables, stretched ones and those with options in the
// lattice of boundary_albedo.h.
//
// A refracted lobe is about alpha |eta - 1| wide and its half vector about |eta - 1| long. Floats
// resolve directions to about 1e-7, so that `eta` is kept max(1e-3, 1e-5 / alpha) away from 1
// (0.01 at alpha = 1e-3). A material that means exactly matched indices uses SpecularDielectric.
#pragma once

#include "lobes/albedo.h"
#include "lobes/boundary_albedo.h"
#include "lobes/dielectric_boundary.h"
#include "lobes/lobe.h"
#include "lobes/microfacet.h"

namespace weft::lobes {

template <class Distribution>
class MicrofacetDielectric {
  public:
    /// `eta` = index on the far side / index on wo's side, > 0. Tints are in [0, 1].
    MicrofacetDielectric(Distribution const& distribution, float eta,
                         Color const& reflectance = Color(1), Color const& transmittance = Color(1),
                         BoundaryOptions const& options = {}, bool compensated = false)
        : distribution_(distribution), eta_(resolvable_eta(distribution, eta)),
          reflectance_(reflectance), transmittance_(transmittance), options_(options),
          compensated_(compensated) {}

    static constexpr LobeFlags flags() { return {ScatteringKind::Glossy, Sides::Both}; }
    float width() const { return widest_alpha(distribution_); }
    float eta_scale() const { return square(eta_); }
    Distribution const& distribution() const { return distribution_; }
    float eta() const { return eta_; } ///< the one in use, off 1
    Color const& reflectance() const { return reflectance_; }
    Color const& transmittance() const { return transmittance_; }
    BoundaryOptions const& options() const { return options_; }
    bool compensated() const { return compensated_; }

    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        LobeValue v = wi.z > 0   ? eval_reflection(wo, wi)
                      : wi.z < 0 ? eval_transmission(wo, wi)
                                 : LobeValue{};
        if (compensated_ && v.pdf > 0)
            v.f *= boost_.r > 0 ? boost_ : compensation(single_scattering(wo));
        return v;
    }

    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        float spare = u.z;
        Vec3 const m = distribution_.sample_visible_normal(wo, {u.x, u.y}, spare);
        float const cos_o = dot(wo, m);
        if (!(cos_o > 0)) return Vec3(0);
        float cos_t;
        float const fresnel = fresnel_dielectric(cos_o, eta_, cos_t);
        if (spare < reflect_probability(tinted(fresnel, cos_o, cos_t))) {
            Vec3 const wi = reflect(wo, m);
            return wi.z > 0 ? normalize(wi) : Vec3(0);
        }
        if (!(fresnel < 1)) return Vec3(0);
        Vec3 const wi = refract(wo, m, cos_o, cos_t, eta_);
        return wi.z < 0 ? wi : Vec3(0);
    }

    Color albedo(Vec3 const& wo) const { return albedo(single_scattering(wo)); }

    /// See lobe.h.
    void look_up(Vec3 const& wo) {
        if (compensated_) boost_ = compensation(single_scattering(wo));
    }
    Color look_up_albedo(Vec3 const& wo) {
        BoundarySplit const once = single_scattering(wo);
        if (compensated_) boost_ = compensation(once);
        return albedo(once);
    }

  private:
    Color albedo(BoundarySplit const& once) const {
        Color const sum = reflectance_ * once.reflected + transmittance_ * once.transmitted;
        return min(compensated_ ? sum * compensation(once) : sum, 1);
    }
    LobeValue eval_reflection(Vec3 const& wo, Vec3 const& wi) const {
        Vec3 const sum = wo + wi;
        float const sum_length = length(sum);
        Vec3 const h = sum * (1 / sum_length);
        float const quarter_density = 0.25f * distribution_.density(h);
        if (!(quarter_density > 0)) return {};
        // wo.h is half the length of the sum, and that is the same seen from wi.
        float const cos_o = 0.5f * sum_length;
        float cos_t;
        float const fresnel = fresnel_dielectric(cos_o, eta_, cos_t);
        BoundarySplit const split = tinted(fresnel, cos_o, cos_t);
        float const sigma_o = distribution_.projected_area(wo);
        float const sigma_i = distribution_.projected_area(wi);
        float const weight = shadowing_above(distribution_.shadowing, wo.z, sigma_o, wi.z, sigma_i);
        return {split.reflected * (quarter_density * weight / sigma_o),
                quarter_density / distribution_.sampling_area(wo, h, sigma_o) *
                    reflect_probability(split)};
    }

    LobeValue eval_transmission(Vec3 const& wo, Vec3 const& wi) const {
        // Points to the side of the lower index; its length is also |wo.h + eta wi.h|.
        Vec3 const sum = wo + wi * eta_;
        float const sum2 = length_squared(sum);
        if (!(sum2 > 0)) return {};
        Vec3 const h = sum * ((eta_ > 1 ? -1.f : 1.f) / std::sqrt(sum2));
        float const cos_o = dot(wo, h), cos_i = dot(wi, h);
        if (!(cos_o > 0 && cos_i < 0)) return {};
        float const jacobian = -cos_i / sum2; // of h in wi, over eta^2
        float const density = distribution_.density(h) * cos_o * jacobian;
        if (!(density > 0)) return {};
        float const fresnel = fresnel_dielectric_cosines(cos_o, -cos_i, eta_);
        BoundarySplit const split = tinted(fresnel, cos_o, -cos_i);
        float const sigma_o = distribution_.projected_area(wo);
        float const sigma_i = distribution_.projected_area(wi);
        float const weight =
            shadowing_across(distribution_.shadowing, wo.z, sigma_o, -wi.z, sigma_i);
        return {split.transmitted * (density * weight / sigma_o),
                density / distribution_.sampling_area(wo, h, sigma_o) * square(eta_) *
                    (1 - reflect_probability(split))};
    }

    BoundarySplit tinted(float fresnel, float cos_o, float cos_t) const {
        BoundarySplit const s = split_light(options_, eta_, fresnel, cos_o, cos_t);
        return {reflectance_ * s.reflected, transmittance_ * s.transmitted};
    }
    static float reflect_probability(BoundarySplit const& split) {
        float const r = average(split.reflected), t = average(split.transmitted);
        return r > 0 ? r / (r + t) : 0.f;
    }
    bool is_tabulated() const {
        return distribution_.alpha_x == distribution_.alpha_y && !options_.film &&
               !(options_.reflection_eta > 0);
    }
    /// The fractions that leave after one scattering, untinted.
    BoundarySplit single_scattering(Vec3 const& wo) const {
        if (!is_tabulated()) return boundary_albedo(distribution_, eta_, options_, wo);
        DielectricAlbedo const once = dielectric_albedo(distribution_, wo, eta_);
        return {Color(once.reflected), Color(once.transmitted)};
    }
    /// 1 / E, E being rounded up.
    Color compensation(BoundarySplit const& once) const {
        float const margin = is_tabulated() ? 1.0015f : 1.01f;
        Color const all = max(min((once.reflected + once.transmitted) * margin, 1), 1e-4f);
        return {1 / all.r, 1 / all.g, 1 / all.b};
    }

    static float resolvable_eta(Distribution const& d, float eta) {
        float const gap = std::max(1e-3f, 1e-5f / std::min(d.alpha_x, d.alpha_y));
        return eta >= 1 ? std::max(eta, 1 + gap) : std::min(eta, 1 / (1 + gap));
    }

    Distribution distribution_;
    float eta_;
    Color reflectance_, transmittance_;
    BoundaryOptions options_;
    bool compensated_;
    Color boost_{}; ///< the factor of compensation for the wo of `look_up`; 0: not looked up
};

template <class D>
void look_up(MicrofacetDielectric<D>& lobe, Vec3 const& wo) {
    lobe.look_up(wo);
}
template <class D>
Color look_up_albedo(MicrofacetDielectric<D>& lobe, Vec3 const& wo) {
    return lobe.look_up_albedo(wo);
}

using GgxDielectric = MicrofacetDielectric<Ggx>;
using BeckmannDielectric = MicrofacetDielectric<Beckmann>;
using AshikhminShirleyDielectric = MicrofacetDielectric<AshikhminShirley>;

static_assert(SmoothLobe<GgxDielectric> && SmoothLobe<BeckmannDielectric> &&
              SmoothLobe<AshikhminShirleyDielectric>);

} // namespace weft::lobes
