// Lights. Every light has a sampling weight: 0 leaves it to be found by rays alone.
#pragma once

#include <string_view>
#include <variant>

#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

inline constexpr schema::Attr kWeightAttr{
    .min = 0, .help = "Factor on the chance of being picked by light sampling; 0 = never."};

struct PointLight {
    static constexpr schema::TypeInfo info{.category = "light",
                                           .type = "point",
                                           .help =
                                               "Shines evenly in all directions from one point."};
    Vec3 position{0, 0, 0};
    Color power{1};
    float weight = 1;

    template <class F>
    constexpr void describe(F&& f) {
        f("position", position, {.unit = "scene", .help = "Where it is."});
        f("power", power,
          {.unit = "W",
           .min = 0,
           .help = "Radiant flux; the radiant intensity is power / (4 pi)."});
        f("weight", weight, kWeightAttr);
    }
};

struct DirectionalLight {
    static constexpr schema::TypeInfo info{.category = "light",
                                           .type = "directional",
                                           .help = "Parallel light from infinitely far away."};
    Vec3 direction{0, 0, 1};
    Color intensity{1};
    float weight = 1;

    template <class F>
    constexpr void describe(F&& f) {
        f("direction", direction, {.help = "Points towards the light."});
        f("intensity", intensity,
          {.unit = "W/m^2", .min = 0, .help = "Irradiance on a surface that faces it."});
        f("weight", weight, kWeightAttr);
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
    float weight = 1;

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
        f("weight", weight, kWeightAttr);
    }
};

struct EnvironmentLight {
    static constexpr schema::TypeInfo info{
        .category = "light",
        .type = "envmap",
        .help = "Light from all around: u = 0.5 - atan2(z, x) / (2 pi), v from the angle to the "
                "local y axis.",
        .example = "<light type=\"envmap\"><texture type=\"image\" filename=\"sky.hdr\"/></light>"};
    Input<Color> texture{Color(1)};
    Affined transform;
    float weight = 1;

    template <class F>
    constexpr void describe(F&& f) {
        f("texture", texture, {.unit = "W/(m^2 sr)", .min = 0, .help = "Radiance by direction."});
        f("transform", transform, {.help = "Rotation from the map's space to the world."});
        f("weight", weight, kWeightAttr);
    }
};

struct AreaLight {
    static constexpr schema::TypeInfo info{.category = "light",
                                           .type = "area",
                                           .help =
                                               "An emissive instance that is sampled as a light. "
                                               "It is part of the scene: do not list it again."};
    InstanceId instance;
    float weight = 1;

    template <class F>
    constexpr void describe(F&& f) {
        f("instance", instance,
          {.required = true, .help = "The instance; it carries an emission."});
        f("weight", weight, kWeightAttr);
    }
};

using Light = std::variant<PointLight, DirectionalLight, SpotLight, EnvironmentLight, AreaLight>;

} // namespace weft::scene
