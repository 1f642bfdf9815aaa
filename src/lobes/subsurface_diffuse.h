// Scattering below the surface in the limit of a mean free path of 0: light comes out where it went
// in. The lobe has the shape of `BurleyDiffuse`. Its own flag tells light controls and AOVs that
// the light is not reflected by the surface itself.
//
// Left out: the path of the light below the surface.
#pragma once

#include "lobes/burley_diffuse.h"

namespace weft::lobes {

struct SubsurfaceDiffuse : BurleyDiffuse {
    static constexpr LobeFlags flags() { return {ScatteringKind::Subsurface, Sides::Reflection}; }
};

static_assert(SmoothLobe<SubsurfaceDiffuse>);

} // namespace weft::lobes
