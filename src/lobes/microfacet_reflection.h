// Rough reflection off a microsurface (Cook and Torrance 1982; Heitz 2014):
//     f cos = F D G2 / (4 wo.z),
// sampled by normals that reflect to above the surface where the distribution can tell, else by
// visible normals: the density is D / (4 reflecting_area).
// `Fresnel` maps the cosine between wo and the half vector to a Color in [0, 1]; the default is
// white and leaves the tint to the list's weight.
#pragma once

#include "lobes/albedo.h"
#include "lobes/fresnel.h"
#include "lobes/lobe.h"
#include "lobes/microfacet.h"

namespace weft::lobes {

struct WhiteFresnel {
    constexpr Color operator()(float) const { return Color(1); }
};

template <class Distribution, class Fresnel = WhiteFresnel>
struct MicrofacetReflection {
    Distribution distribution;
    [[no_unique_address]] Fresnel fresnel{};

    static constexpr LobeFlags flags() { return LobeFlags::Reflection | LobeFlags::Glossy; }
    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        if (!(wi.z > 0)) return {};
        Vec3 const h = normalize(wo + wi); // not 0: both have positive z
        float const sigma_o = distribution.projected_area(wo);
        float const sigma_i = distribution.projected_area(wi);
        float const quarter_density = 0.25f * distribution.density(h);
        float const weight = shadowing_above(wo.z, sigma_o, wi.z, sigma_i);
        return {fresnel(dot(wo, h)) * (quarter_density * weight / sigma_o),
                quarter_density / distribution.reflecting_area(wo, h, sigma_o)};
    }
    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        float spare = u.z;
        Vec3 const m = distribution.sample_reflecting_normal(wo, {u.x, u.y}, spare);
        Vec3 const wi = reflect(wo, m);
        return wi.z > 0 ? normalize(wi) : Vec3(0);
    }
    /// With F taken at the normal: exact for white, an estimate for a Fresnel that varies.
    Color albedo(Vec3 const& wo) const { return fresnel(wo.z) * white_albedo(distribution, wo); }
};

using GgxReflection = MicrofacetReflection<Ggx>;
using BeckmannReflection = MicrofacetReflection<Beckmann>;
using AshikhminShirleyReflection = MicrofacetReflection<AshikhminShirley>;

static_assert(SmoothLobe<GgxReflection> && SmoothLobe<BeckmannReflection> &&
              SmoothLobe<AshikhminShirleyReflection>);

} // namespace weft::lobes
