// Diffuse reflection, Lambert 1760: the same radiance in every direction. White; the albedo is
// the list's weight.
#pragma once

#include "base/warp.h"
#include "lobes/lobe.h"

namespace weft::lobes {

struct Lambert {
    static constexpr LobeFlags flags() { return {ScatteringKind::Diffuse, Sides::Reflection}; }
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }
    LobeValue eval(Vec3 const&, Vec3 const& wi) const {
        float const pdf = cosine_hemisphere_pdf(wi.z);
        return {Color(pdf), pdf};
    }
    Vec3 sample(Vec3 const&, Vec3 const& u) const {
        return square_to_cosine_hemisphere({u.x, u.y});
    }
    Color albedo(Vec3 const&) const { return Color(1); }
};

static_assert(SmoothLobe<Lambert>);

} // namespace weft::lobes
