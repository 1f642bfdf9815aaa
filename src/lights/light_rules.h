// What a light's controls make of light that is about to arrive somewhere: one factor, the same for
// light sampling and for rays that find the light, so that both strategies keep one mean.
// scene/light_controls.h says what each control means.
#pragma once

#include <array>

#include "base/vec.h"
#include "lights/light_bounds.h"
#include "scene/light_controls.h"
#include "world/ray_kind.h"
#include "world/set_names.h"

namespace weft::lights {

/// Light on its way to where it is scattered, or seen.
struct Arrival {
    Vec3 p{0, 0, 0};                ///< the place
    uint64_t sets = 0;              ///< that the object there belongs to
    uint32_t bounces = 0;           ///< from the camera on, this place included; 0: seen itself
    RayKind kind = RayKind::camera; ///< how the place scatters it
    float distance = 0;             ///< from the light
};

/// Returns whether light sampling has to find all light, even where strategies are combined.
bool is_sampled_alone(scene::LightControls const& controls);

struct LightRules {
    bool in_use = false;         ///< else every factor is 1
    bool by_kind = false;        ///< factors differ between kinds of scattering
    bool sampling_alone = false; ///< rays that scattered smoothly do not count it
    bool shown = true;           ///< mirrors and clear glass show it
    world::RayMask shadow_mask = world::kShadowMask; ///< of what blocks it; 0: nothing does
    world::Links lit;

    LightRules() = default;
    /// `power`: luminance of all that it emits; `at_infinity`: times the scene's cross-section.
    LightRules(scene::LightControls const& controls, LightBounds const& bounds, float power,
               float cross_section);

    /// Returns the part of the light that counts.
    float factor(Arrival const& to) const {
        if (to.bounces == 0) return by_ray_kind_[size_t(RayKind::camera)];
        bool const indirect = to.bounces > 1;
        if (to.bounces > most_bounces_ || !lit.accept(to.sets)) return 0;
        if (to.distance > max_distance_) return 0;
        if (indirect && irradiance(to.p) < min_contribution_) return 0;
        return (indirect ? indirect_ : direct_) * by_ray_kind_[size_t(to.kind)];
    }
    /// Takes away what rays of that kind see: they do not meet the light's object.
    void hide_from(RayKind kind);

  private:
    /// Returns the irradiance on a facing surface, roughly.
    float irradiance(Vec3 const& p) const {
        return at_infinity_ ? intensity_
                            : intensity_ / std::max(length_squared(p - centre_), radius_squared_);
    }

    std::array<float, kRayKinds> by_ray_kind_{1, 1, 1, 1, 1, 1};
    float direct_ = 1, indirect_ = 1;
    uint32_t most_bounces_ = UINT32_MAX;
    float max_distance_ = kInfinity, min_contribution_ = 0;
    float intensity_ = 0, radius_squared_ = 0; ///< of its bounds
    Vec3 centre_{0, 0, 0};
    bool at_infinity_ = false;
};

} // namespace weft::lights
