// Rough transmission through a wall so thin that light leaves it where it went in: the reflection
// of a white microsurface, mirrored to the other side (Burley 2015, "Extending the Disney BRDF to a
// BSDF with Integrated Subsurface Scattering", section 5, thin surfaces). What the wall reflects is
// left to the weight. There is no change of index: eta_scale is 1.
#pragma once

#include "lobes/microfacet_reflection.h"

namespace weft::lobes {

template <class Distribution>
struct ThinTransmission {
    /// Of which light that meets several facets is not lost.
    MicrofacetReflection<Distribution> mirrored;

    ThinTransmission(Distribution const& distribution)
        : mirrored{distribution, WhiteFresnel{}, true} {}

    static constexpr LobeFlags flags() { return {ScatteringKind::Glossy, Sides::Transmission}; }
    float width() const { return mirrored.width(); }
    static constexpr float eta_scale() { return 1; }
    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        return mirrored.eval(wo, {wi.x, wi.y, -wi.z});
    }
    Vec3 sample(Vec3 const& wo, Vec3 const& u) const {
        Vec3 const wi = mirrored.sample(wo, u);
        return {wi.x, wi.y, -wi.z};
    }
    Color albedo(Vec3 const& wo) const { return mirrored.albedo(wo); }
};

template <class D>
void look_up(ThinTransmission<D>& lobe, Vec3 const& wo) {
    look_up(lobe.mirrored, wo);
}
template <class D>
Color look_up_albedo(ThinTransmission<D>& lobe, Vec3 const& wo) {
    return look_up_albedo(lobe.mirrored, wo);
}

using GgxThinTransmission = ThinTransmission<Ggx>;
using BeckmannThinTransmission = ThinTransmission<Beckmann>;
using AshikhminShirleyThinTransmission = ThinTransmission<AshikhminShirley>;

static_assert(SmoothLobe<GgxThinTransmission> && SmoothLobe<BeckmannThinTransmission> &&
              SmoothLobe<AshikhminShirleyThinTransmission>);

} // namespace weft::lobes
