// Rough reflection off a microsurface (Cook and Torrance 1982; Heitz 2014):
//     f cos = F D G2 / (4 wo.z),
// sampled by normals that reflect to above the surface where the distribution can tell, else by
// visible normals: the density is D / (4 reflecting_area).
//
// Light that would leave after several bounces is missing. Where `compensated`, it is given back by
// a factor that depends on wo (Turquin 2019, "Practical multiple scattering compensation for
// microfacet models"): with E the white albedo and Fm the mean reflectance,
//     1 / (1 - Fm (1 - E)),
// the sum over bounces that each leave by E. A white surface then reflects exactly all. Kulla and
// Conty's extra lobe (2017) is reciprocal, which this is not, but needs sampling of its own, adds
// noise, and has no counterpart for anisotropic surfaces; paths are only traced from the eye.
#pragma once

#include "lobes/fresnel_model.h"
#include "lobes/lobe.h"

namespace weft::lobes {

template <class Distribution>
struct MicrofacetReflection {
    Distribution distribution;
    Fresnel fresnel{};
    bool compensated = false; ///< for multiple scattering
    float white = 0;          ///< the white albedo for the wo of `look_up`; 0: not looked up

    static constexpr LobeFlags flags() { return {ScatteringKind::Glossy, Sides::Reflection}; }
    float width() const { return widest_alpha(distribution); }
    static constexpr float eta_scale() { return 1; }
    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        if (!(wi.z > 0)) return {};
        Vec3 const h = normalize(wo + wi); // not 0: both have positive z
        float const sigma_o = distribution.projected_area(wo);
        float const sigma_i = distribution.projected_area(wi);
        float const quarter_density = 0.25f * distribution.density(h);
        if (!(quarter_density > 0)) return {};
        float const value = quarter_density *
                            shadowing_above(distribution.shadowing, wo.z, sigma_o, wi.z, sigma_i) /
                            sigma_o;
        Color f = reflectance(fresnel, dot(wo, h)) * value;
        if (compensated) f *= compensation(white > 0 ? white : white_albedo(distribution, wo));
        return {f, quarter_density / distribution.reflecting_area(wo, h, sigma_o)};
    }
    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        float spare = u.z;
        Vec3 const m = distribution.sample_reflecting_normal(wo, {u.x, u.y}, spare);
        Vec3 const wi = reflect(wo, m);
        return wi.z > 0 ? normalize(wi) : Vec3(0);
    }
    Color albedo(Vec3 const& wo) const { return albedo(wo, white_albedo(distribution, wo)); }
    /// The same from the white albedo for wo.
    Color albedo(Vec3 const& wo, float e) const {
        if (!compensated) return single_scattering(wo, e);
        if (std::holds_alternative<WhiteFresnel>(fresnel)) return Color(1);
        return single_scattering(wo, e) * compensation(e);
    }

  private:
    Color single_scattering(Vec3 const& wo, float e) const {
        bool const is_white = std::holds_alternative<WhiteFresnel>(fresnel);
        if (distribution.alpha_x != distribution.alpha_y && !is_white)
            return mean_over_normals(wo, e);
        return match(fresnel,
                     Overloaded{
                         [&](WhiteFresnel const&) { return Color(e); },
                         [&](DielectricFresnel const& f) {
                             return Color(dielectric_albedo(distribution, wo, f.eta).reflected);
                         },
                         [&](ThinFilmFresnel const&) { return mean_over_normals(wo, e); },
                         [&](ThinWallFresnel const&) { return mean_over_normals(wo, e); },
                         [&](auto const& f) {
                             return rough_reflectance(f, reflection_moments(distribution, wo));
                         },
                     });
    }
    /// What has no table: the mean reflectance of some normals times the white albedo, rounded up
    /// by what that may lack, so that with the layers below no light is gained.
    Color mean_over_normals(Vec3 const& wo, float e) const {
        float const sigma_o = distribution.projected_area(wo);
        float total = 0;
        Color sum;
        for_visible_normals(distribution, wo, sigma_o, 48, [&](Vec3 const& m, float share) {
            Vec3 const r = reflect(wo, m);
            if (!(r.z > 0)) return;
            float const w = share * shadowing_above(distribution.shadowing, wo.z, sigma_o, r.z,
                                                    distribution.projected_area(r));
            total += w;
            sum += reflectance(fresnel, dot(wo, m)) * w;
        });
        constexpr float margin = 0.008f;
        return total > 0 ? min(sum * (e / total) + Color(margin), e) : Color(e);
    }
    Color compensation(float e) const {
        Color const lost = mean_reflectance(fresnel) * (1 - e);
        return {1 / (1 - lost.r), 1 / (1 - lost.g), 1 / (1 - lost.b)};
    }
};

template <class D>
void look_up(MicrofacetReflection<D>& lobe, Vec3 const& wo) {
    if (lobe.compensated) lobe.white = white_albedo(lobe.distribution, wo);
}
template <class D>
Color look_up_albedo(MicrofacetReflection<D>& lobe, Vec3 const& wo) {
    lobe.white = white_albedo(lobe.distribution, wo);
    return lobe.albedo(wo, lobe.white);
}

using GgxReflection = MicrofacetReflection<Ggx>;
using BeckmannReflection = MicrofacetReflection<Beckmann>;
using AshikhminShirleyReflection = MicrofacetReflection<AshikhminShirley>;

static_assert(SmoothLobe<GgxReflection> && SmoothLobe<BeckmannReflection> &&
              SmoothLobe<AshikhminShirleyReflection>);

} // namespace weft::lobes
