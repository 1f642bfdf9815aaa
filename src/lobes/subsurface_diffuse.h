// Scattering below the surface, of which the light comes out where it went in: the limit of a mean
// free path of 0. It has the shape of `BurleyDiffuse`, and a flag of its own, by which light
// controls and AOVs tell it from what the surface itself reflects.
//
// Left out: the way that the light goes below the surface.
#pragma once

#include "lobes/burley_diffuse.h"

namespace weft::lobes {

struct SubsurfaceDiffuse : BurleyDiffuse {
    static constexpr LobeFlags flags() { return {ScatteringKind::Subsurface, Sides::Reflection}; }
};

static_assert(SmoothLobe<SubsurfaceDiffuse>);

} // namespace weft::lobes
