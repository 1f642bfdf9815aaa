// Light from infinitely far away in all directions.
#pragma once

#include <vector>

#include "scene/dialects.h"
#include "scene/light_color.h"
#include "scene/light_controls.h"

namespace weft::scene {

/// Where light comes in.
struct Portal {
    static constexpr schema::TypeInfo info{
        .category = "portal",
        .type = "",
        .help = "A window that light from all around comes in by: a rectangle, [-1, 1]^2 in the "
                "local x-y plane, whose z axis points into the room. It is not seen. Light "
                "sampling on that side of it looks for the light through portals alone.",
        .example = "<portal><transform><scale x=\"0.6\" y=\"0.8\"/>"
                   "<translate z=\"-2\"/></transform></portal>"};
    Affined transform;

    template <class F>
    constexpr void describe(F&& f) {
        f("transform", transform,
          {.help = "From the rectangle's space to the world, without shear."});
    }
};

inline constexpr schema::Attr kPortalAttr{
    .help = "Windows that all of the light comes in by, for less noise in rooms. Light that comes "
            "another way is there, but noisy."};

namespace dialects {
inline constexpr std::string_view kEnvmapToday =
    "is <light type=\"envmap\"> today, which is sampled by its brightness";
inline constexpr std::array kEnvmaps{
    Spelling{.type = "envmapIS", .today = kEnvmapToday},
    Spelling{.type = "envmap1", .today = kEnvmapToday},
    Spelling{.type = "simpleenvmap", .today = kEnvmapToday},
    Spelling{.type = "warp2denvmap", .today = kEnvmapToday},
    Spelling{.type = "warp2devnmap", .today = kEnvmapToday},
    Spelling{.parameter = "mis_compensation_strength",
             .today = "has no effect: what surfaces find of an environment by themselves, light "
                      "sampling leaves to them"},
    Spelling{.parameter = "importanceSampling",
             .today = "has no effect: an environment is always sampled by its brightness"},
};
} // namespace dialects

struct EnvironmentLight {
    static constexpr schema::TypeInfo info{
        .category = "light",
        .type = "envmap",
        .help = "Light from all around: u = 0.5 - atan2(z, x) / (2 pi), v is 0 at the local +y and "
                "1 at -y, so the top row of an image is at -y.",
        .example = "<light type=\"envmap\"><texture type=\"image\" filename=\"sky.hdr\"/></light>",
        .spellings = dialects::kEnvmaps};
    Input<Color> texture{Color(1)};
    Affined transform;
    std::vector<PortalId> portals;
    LightUnit unit = LightUnit::radiometric;
    LightColor color;
    LightControls controls;

    template <class F>
    constexpr void describe(F&& f) {
        f("texture", texture,
          {.unit = "W/(m^2 sr)",
           .min = 0,
           .help = "Radiance by direction. An image is interpolated between the centres of its "
                   "texels, goes on around the seam and ends at the poles, whatever its border."});
        f("transform", transform,
          {.help =
               "From the map's space to the world: turns and mirrors the map; unequal scales and "
               "shear stretch it, as if painted on a far sphere. The rest does nothing."});
        f("unit", unit, kLightUnitAttr);
        f.group(color);
        f("portal", portals, kPortalAttr);
        f.group(controls);
    }
};

} // namespace weft::scene
