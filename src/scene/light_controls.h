// What every light can be told besides its shape and its brightness. None of these is physics: all
// but the weight change what is in the picture, each in one defined way, and docs/light-controls.md
// has them in one table.
//
// A *bounce* is a surface or medium that scatters light between the light and the camera: none, the
// light itself is seen; one, direct light; more, indirect light.
#pragma once

#include <string>
#include <string_view>

#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

inline constexpr schema::Attr kGroupAttr{
    .help = "Light group: the `light_groups` AOV has a picture of the light of each. Letters, "
            "digits, _ and -; without one it is in `default`."};

struct LightControls {
    float weight = 1;
    int bounces = -1;
    float direct = 1, indirect = 1;
    float diffuse = 1, specular = 1, transmission = 1, volume = 1, subsurface = 1;
    bool visible_to_camera = true, visible_to_secondary = true;
    bool cast_shadows = true;
    std::string illuminates, shadowed_by;
    float max_distance = 0;
    float min_contribution = 0;
    std::string group;

    template <class F>
    constexpr void describe(F&& f) {
        f("weight", weight,
          {.min = 0, .help = "Factor on the chance of being picked by light sampling; 0 = never."});
        f("bounces", bounces,
          {.min = -1,
           .max = 100000,
           .soft_max = 16,
           .help = "How many bounces after the first surface its light may reach through: 0 is "
                   "direct light alone; -1 is no limit.",
           .aliases = {"lightBounce", "bounce"}});
        constexpr schema::Attr factor{.min = 0, .soft_max = 2};
        auto with = [&](std::string_view help) {
            schema::Attr attr = factor;
            attr.help = help;
            return attr;
        };
        f("direct", direct, with("Factor on the light that it gives to what the camera sees."));
        f("indirect", indirect,
          with("Factor on its light that comes over further surfaces or media."));
        f("diffuse", diffuse, with("Factor on its light that surfaces reflect diffusely."));
        f("specular", specular,
          with("Factor on its light that mirrors and glossy surfaces reflect."));
        f("transmission", transmission, with("Factor on its light that surfaces let through."));
        f("volume", volume, with("Factor on its light that media scatter."));
        f("subsurface", subsurface, with("Factor on its light that comes from below surfaces."));
        f("visibleToCamera", visible_to_camera,
          {.help = "Whether the camera sees the light itself: lamps if they have a radius or an "
                   "angle."});
        f("visibleToSecondary", visible_to_secondary,
          {.help = "Whether mirrors and clear glass show the light itself; without it, light "
                   "sampling alone finds it, and rough surfaces are lit as before."});
        f("castShadows", cast_shadows,
          {.help = "Whether surfaces block its light. Without shadows, light sampling alone finds "
                   "it."});
        f("illuminates", illuminates,
          {.help = "Light linking: names of the sets of instances that it lights; \"-name\" "
                   "excepts one. Empty: all."});
        f("shadowedBy", shadowed_by,
          {.help = "Shadow linking: names of the sets of instances that block its light; "
                   "\"-name\" excepts one. Empty: all. Like castShadows, it leaves the light to "
                   "light sampling."});
        f("maxDistance", max_distance,
          {.unit = "scene",
           .min = 0,
           .help =
               "Points of surfaces and media further away are not lit; 0 is no limit. Lights at "
               "infinity have none."});
        f("minContribution", min_contribution,
          {.unit = "W/m^2",
           .min = 0,
           .help = "Beyond the first bounce, points where its irradiance would be less than this, "
                   "estimated from its intensity and distance, are not lit; large values leave a "
                   "light to what the camera sees. 0: all are."});
        f("group", group, kGroupAttr);
    }
    friend bool operator==(LightControls const&, LightControls const&) = default;
};

} // namespace weft::scene
