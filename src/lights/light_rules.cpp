#include "lights/light_rules.h"

namespace weft::lights {

bool is_sampled_alone(scene::LightControls const& c) {
    return !c.visible_to_secondary || !c.cast_shadows || !c.shadowed_by.empty();
}

LightRules::LightRules(scene::LightControls const& c, LightBounds const& bounds, float power,
                       float cross_section)
    : by_kind(c.diffuse != c.specular || c.diffuse != c.transmission || c.diffuse != c.volume ||
              c.diffuse != c.subsurface),
      sampling_alone(is_sampled_alone(c)),
      shown(c.visible_to_secondary), by_ray_kind_{c.visible_to_camera ? 1.f : 0.f,
                                                  c.diffuse,
                                                  c.specular,
                                                  c.transmission,
                                                  c.volume,
                                                  c.subsurface},
      direct_(c.direct), indirect_(c.indirect), min_contribution_(c.min_contribution),
      at_infinity_(bounds.at_infinity) {
    scene::LightControls physics;
    physics.weight = c.weight;
    in_use = !(c == physics);
    if (c.bounces >= 0) most_bounces_ = uint32_t(c.bounces) + 1;
    if (!c.cast_shadows) shadow_mask = 0;
    if (at_infinity_) {
        intensity_ = power / cross_section;
    } else {
        if (c.max_distance > 0) max_distance_ = c.max_distance;
        intensity_ = power / orientation_measure(bounds);
        centre_ = bounds.centre();
        radius_squared_ = 0.25f * bounds.diagonal_squared();
    }
}

void LightRules::hide_from(RayKind kind) {
    in_use = true;
    by_kind |= kind != RayKind::camera;
    by_ray_kind_[size_t(kind)] = 0;
}

} // namespace weft::lights
