// Lights. light_controls.h has what all of them share.
#pragma once

#include <string_view>
#include <variant>

#include "scene/environment_light.h"
#include "scene/sky_light.h"

namespace weft::scene {

struct PointLight {
    static constexpr schema::TypeInfo info{.category = "light",
                                           .type = "point",
                                           .help =
                                               "Shines evenly in all directions from one point."};
    Vec3 position{0, 0, 0};
    Color power{1};
    LightControls controls;

    template <class F>
    constexpr void describe(F&& f) {
        f("position", position, {.unit = "scene", .help = "Where it is."});
        f("power", power,
          {.unit = "W",
           .min = 0,
           .help = "Radiant flux; the radiant intensity is power / (4 pi)."});
        f.group(controls);
    }
};

struct DirectionalLight {
    static constexpr schema::TypeInfo info{.category = "light",
                                           .type = "directional",
                                           .help = "Parallel light from infinitely far away."};
    Vec3 direction{0, 0, 1};
    Color intensity{1};
    LightControls controls;

    template <class F>
    constexpr void describe(F&& f) {
        f("direction", direction, {.help = "Points towards the light."});
        f("intensity", intensity,
          {.unit = "W/m^2", .min = 0, .help = "Irradiance on a surface that faces it."});
        f.group(controls);
    }
};

struct SpotLight {
    static constexpr schema::TypeInfo info{
        .category = "light", .type = "spot", .help = "A cone of light from one point."};
    Vec3 position{0, 0, 0};
    Vec3 direction{0, 0, 1};
    Color intensity{1};
    float angle = 40;
    float falloff = 10;
    LightControls controls;

    template <class F>
    constexpr void describe(F&& f) {
        f("position", position, {.unit = "scene", .help = "Where it is."});
        f("direction", direction, {.help = "Where it shines."});
        f("intensity", intensity,
          {.unit = "W/sr", .min = 0, .help = "Radiant intensity on the axis."});
        f("angle", angle,
          {.unit = "deg",
           .min = 0,
           .max = 360,
           .help = "Full angle of the cone of full intensity."});
        f("falloff", falloff,
          {.unit = "deg",
           .min = 0,
           .max = 360,
           .help = "Full angle by which the outer cone is wider; linear in the angle between."});
        f.group(controls);
    }
};

struct AreaLight {
    static constexpr schema::TypeInfo info{.category = "light",
                                           .type = "area",
                                           .help =
                                               "An emissive instance that is sampled as a light. "
                                               "It is part of the scene: do not list it again."};
    InstanceId instance;
    LightControls controls;

    template <class F>
    constexpr void describe(F&& f) {
        f("instance", instance,
          {.required = true, .help = "The instance; it carries an emission."});
        f.group(controls);
    }
};

using Light =
    std::variant<PointLight, DirectionalLight, SpotLight, EnvironmentLight, SkyLight, AreaLight>;

} // namespace weft::scene
