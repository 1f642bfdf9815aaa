// The sheen term of Burley 2012, "Physically-based shading at Disney", 5.4: f = (1 - cos
// theta_d)^5, theta_d being the angle between either direction and their half vector. As published
// it has no 1 / pi, and gives back less than 0.09 of what it receives. White; the tint is the
// list's weight. Reciprocal.
#pragma once

#include "base/warp.h"
#include "lobes/lobe.h"

namespace weft::lobes {

/// From a table, to 0.001; cos_o in [0, 1].
float disney_sheen_albedo(float cos_o);

/// The grid of that table, equally spaced in the cosine.
inline constexpr int disney_sheen_cosines = 24;

struct DisneySheen {
    static constexpr LobeFlags flags() { return {ScatteringKind::Diffuse, Sides::Reflection}; }
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }
    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        if (!(wi.z > 0)) return {};
        float const m = std::max(1 - 0.5f * length(wo + wi), 0.f), m2 = m * m;
        return {Color(m2 * m2 * m * wi.z), 0.5f * kInvPi};
    }
    /// Uniform: what returns to grazing directions is spread out to the horizon.
    Vec3 sample(Vec3 const&, Vec3 const& u) const {
        float const z = 1 - u.x, r = safe_sqrt(u.x * (1 + z)), phi = 2 * kPi * u.y;
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    Color albedo(Vec3 const& wo) const { return Color(disney_sheen_albedo(wo.z)); }
};

static_assert(SmoothLobe<DisneySheen>);

} // namespace weft::lobes
