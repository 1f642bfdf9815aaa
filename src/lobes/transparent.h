// Light that goes straight on, as if there were no surface: the part of a material that a cut-out
// or a coverage leaves open. White; the tint is the list's weight.
#pragma once

#include "lobes/lobe.h"

namespace weft::lobes {

struct Transparent {
    static constexpr LobeFlags flags() { return {ScatteringKind::Straight, Sides::Transmission}; }
    static constexpr float width() { return 0; }
    DeltaSample sample(Vec3 const& wo, Vec3 const&) const {
        return {.wi = -wo, .weight = Color(1), .probability = 1};
    }
    Color albedo(Vec3 const&) const { return Color(1); }
};

static_assert(DeltaLobe<Transparent>);

} // namespace weft::lobes
