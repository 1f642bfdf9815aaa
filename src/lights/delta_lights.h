// Lights that shine from one point or in one direction, and so are met by no ray: they need no
// density and no MIS. luminaire.h gives those at a point a size.
#pragma once

#include <numbers>

#include "lights/light_sample.h"

namespace weft::lights {

/// Returns the sample of a light of no size: `irradiance` on a surface that faces it.
inline LightSample delta_sample(Vec3 const& wi, float distance, Color const& irradiance) {
    return {.wi = wi, .distance = distance, .radiance = irradiance, .pdf = 1, .delta = true};
}

/// The same intensity in all directions.
struct PointLight {
    Vec3 position{0, 0, 0};
    Color intensity{1}; ///< power per solid angle

    LightSample sample(Vec3 const& ref) const {
        Vec3 const d = position - ref;
        float const d2 = length_squared(d);
        if (!(d2 > 0)) return {};
        float const distance = std::sqrt(d2);
        return delta_sample(d * (1 / distance), distance, intensity * (1 / d2));
    }
    Color power() const { return intensity * (4 * kPi); }
    /// Returns the share of the intensity that leaves along `d`.
    float attenuation(Vec3 const&) const { return 1; }
};

/// Parallel light from infinitely far away.
struct DirectionalLight {
    static constexpr FoundAs found_as = FoundAs::Nothing;
    static constexpr bool at_infinity = true;

    Vec3 direction{0, 1, 0}; ///< unit, towards the light
    Color irradiance{1};     ///< on a surface facing the light

    static constexpr bool has_size() { return false; }
    /// The same from everywhere.
    LightSample sample() const { return delta_sample(direction, kInfinity, irradiance); }
    LightSample sample(LightContext const&, Vec3 const&, Vec2, uint32_t) const { return sample(); }
    /// Returns what crosses a disk of the scene's radius.
    Color power(float scene_radius) const { return irradiance * (kPi * square(scene_radius)); }
};

/// A point light that shines into a cone: full intensity up to angle / 2 from the axis, from there
/// falling to 0 at (angle + falloff) / 2. Linearly in the angle; or as a smoothstep in its cosine
/// (pbrt-v4's SpotLight, Pharr, Jakob and Humphreys 2023, 12.2.1; Cycles' `blend` likewise), where
/// an outer cone of more than a full turn ends at the full turn.
struct SpotLight {
    Vec3 position{0, 0, 0};
    Vec3 axis{0, 0, 1};    ///< unit, the way the light shines
    Color intensity{1};    ///< power per solid angle on the axis
    float angle = kPi / 4; ///< full opening angle of the bright cone, radians in [0, 2 pi]
    float falloff = 0;     ///< how much wider the dark edge is, full angle in radians, >= 0
    bool smooth = false;   ///< a smoothstep rather than a line

    /// Returns the share of the intensity along `d` (any length but 0), in [0, 1].
    float attenuation(Vec3 const& d) const {
        // atan2 rather than acos: narrow spots live where the cosine has no digits left.
        float const theta = std::atan2(length(cross(axis, d)), dot(axis, d));
        float const beyond = theta - 0.5f * angle;
        if (beyond <= 0) return 1;
        if (!smooth) return std::max(0.f, 1 - 2 * beyond / falloff);
        float const outer = std::min(0.5f * (angle + falloff), kPi);
        if (theta >= outer) return 0;
        // (cos theta - cos outer) / (cos inner - cos outer), as products for the same reason.
        float const t =
            std::sin(0.5f * (outer + theta)) * std::sin(0.5f * (outer - theta)) /
            (std::sin(0.5f * (outer + 0.5f * angle)) * std::sin(0.5f * (outer - 0.5f * angle)));
        return std::min(t * t * (3 - 2 * t), 1.f);
    }
    LightSample sample(Vec3 const& ref) const {
        LightSample s = PointLight{position, intensity}.sample(ref);
        if (s.pdf > 0) s.radiance *= attenuation(-s.wi);
        return s;
    }
    /// Returns, linear: 2 pi I (1 - (sin b - sin a) / (b - a)) for the half angles a and b of the
    /// two cones. Smooth: 2 pi I (1 - (cos a + cos b) / 2), as a smoothstep is 1/2 in the mean.
    Color power() const {
        double const pi = std::numbers::pi;
        double const a = std::min(0.5 * angle, pi);
        double const b = std::max(a, std::min(0.5 * (double(angle) + falloff), pi));
        if (smooth || b - a < 1e-6)
            return intensity * float(2 * pi * (1 - 0.5 * (std::cos(a) + std::cos(b))));
        // Where the outer cone is wider than everything, the ramp stops at pi above 0.
        double const end = std::max(0.0, 0.5 * (double(angle) + falloff) - pi) / (0.5 * falloff);
        double const mean_cos = (std::sin(b) - std::sin(a)) / (b - a);
        return intensity * float(2 * pi * (1 - end * std::cos(b) - (1 - end) * mean_cos));
    }
};

} // namespace weft::lights
