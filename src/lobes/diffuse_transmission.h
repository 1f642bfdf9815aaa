// Diffuse transmission: what arrives on one side leaves the other with the same radiance in every
// direction (leaves, paper, lamp shades). Lambert mirrored at the surface; white, the tint is the
// list's weight. There is no change of index: eta_scale is 1.
#pragma once

#include "base/warp.h"
#include "lobes/lobe.h"

namespace weft::lobes {

struct DiffuseTransmission {
    static constexpr LobeFlags flags() { return {ScatteringKind::Diffuse, Sides::Transmission}; }
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }
    LobeValue eval(Vec3 const&, Vec3 const& wi) const {
        float const pdf = cosine_hemisphere_pdf(-wi.z);
        return {Color(pdf), pdf};
    }
    Vec3 sample(Vec3 const&, Vec3 const& u) const {
        Vec3 const w = square_to_cosine_hemisphere({u.x, u.y});
        return {w.x, w.y, -w.z};
    }
    Color albedo(Vec3 const&) const { return Color(1); }
};

static_assert(SmoothLobe<DiffuseTransmission>);

} // namespace weft::lobes
