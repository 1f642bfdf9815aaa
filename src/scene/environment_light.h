// Light from infinitely far away in all directions.
#pragma once

#include "scene/light_color.h"
#include "scene/light_controls.h"

namespace weft::scene {

struct EnvironmentLight {
    static constexpr schema::TypeInfo info{
        .category = "light",
        .type = "envmap",
        .help = "Light from all around: u = 0.5 - atan2(z, x) / (2 pi), v from the angle to the "
                "local y axis.",
        .example = "<light type=\"envmap\"><texture type=\"image\" filename=\"sky.hdr\"/></light>"};
    Input<Color> texture{Color(1)};
    Affined transform;
    LightUnit unit = LightUnit::radiometric;
    LightColor color;
    LightControls controls;

    template <class F>
    constexpr void describe(F&& f) {
        f("texture", texture, {.unit = "W/(m^2 sr)", .min = 0, .help = "Radiance by direction."});
        f("transform", transform, {.help = "Rotation from the map's space to the world."});
        f("unit", unit, kLightUnitAttr);
        f.group(color);
        f.group(controls);
    }
};

} // namespace weft::scene
