// The smooth mirror. A tint beyond its Fresnel reflectance is the list's weight.
#pragma once

#include "lobes/fresnel_model.h"
#include "lobes/lobe.h"

namespace weft::lobes {

struct SpecularReflection {
    Fresnel fresnel{};

    static constexpr LobeFlags flags() { return {ScatteringKind::Specular, Sides::Reflection}; }
    static constexpr float width() { return 0; }
    DeltaSample sample(Vec3 const& wo, Vec3 const&) const {
        return {.wi = {-wo.x, -wo.y, wo.z}, .weight = albedo(wo), .probability = 1};
    }
    Color albedo(Vec3 const& wo) const { return reflectance(fresnel, wo.z); }
};

static_assert(DeltaLobe<SpecularReflection>);

} // namespace weft::lobes
