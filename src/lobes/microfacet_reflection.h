// Rough reflection off a microsurface (Cook and Torrance 1982; Heitz 2014):
//     f cos = F D G2 / (4 wo.z),  sampled by visible normals, density D G1(wo) / (4 wo.z).
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
        float const pdf = distribution.density(h) / (4 * sigma_o);
        float const weight = shadowing_above(wo.z, sigma_o, wi.z, sigma_i);
        return {fresnel(dot(wo, h)) * (pdf * weight), pdf};
    }
    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        Vec3 const wi = reflect(wo, distribution.sample_visible_normal(wo, {u.x, u.y}));
        return wi.z > 0 ? normalize(wi) : Vec3(0);
    }
    /// With F taken at the normal: exact for white, an estimate for a Fresnel that varies.
    Color albedo(Vec3 const& wo) const {
        return fresnel(wo.z) * reflection_albedo(distribution, wo.z);
    }
};

using GgxReflection = MicrofacetReflection<Ggx>;
using BeckmannReflection = MicrofacetReflection<Beckmann>;

static_assert(SmoothLobe<GgxReflection> && SmoothLobe<BeckmannReflection>);

} // namespace weft::lobes
