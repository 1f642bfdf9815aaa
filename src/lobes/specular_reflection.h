// The perfect mirror. White; a tint is the list's weight.
#pragma once

#include "lobes/lobe.h"

namespace weft::lobes {

struct SpecularReflection {
    static constexpr LobeFlags flags() { return LobeFlags::Reflection | LobeFlags::Delta; }
    DeltaSample sample(Vec3 const& wo, Vec3 const&) const {
        return {.wi = {-wo.x, -wo.y, wo.z}, .weight = Color(1), .probability = 1};
    }
    Color albedo(Vec3 const&) const { return Color(1); }
};

static_assert(DeltaLobe<SpecularReflection>);

} // namespace weft::lobes
