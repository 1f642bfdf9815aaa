// Lights. light_controls.h and light_color.h have what all of them share.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "scene/dialects.h"
#include "scene/environment_light.h"
#include "scene/light_color.h"
#include "scene/sky_light.h"

namespace weft::scene {

/// How lamps describe their `radius`.
inline constexpr schema::Attr kLampRadiusAttr{
    .unit = "scene",
    .min = 0,
    .help = "Of the ball that shines, for soft shadows and highlights; it blocks no light, and its "
            "power does not depend on it. 0 is a point."};

struct PointLight {
    static constexpr schema::TypeInfo info{
        .category = "light",
        .type = "point",
        .help = "Shines evenly in all directions from one point or, with a radius, a ball. The "
                "camera does not see the ball unless `visibleToCamera` says so; mirrors do."};
    Vec3 position{0, 0, 0};
    Input<Color> power{Color(1)};
    Input<Color> intensity{Color(0)};
    float radius = 0;
    LightUnit unit = LightUnit::radiometric;
    LightColor color;
    LightControls controls{.visible_to_camera = false};

    template <class F>
    constexpr void describe(F&& f) {
        f("position", position, {.unit = "scene", .help = "Where it is."});
        f("power", power,
          {.unit = "W",
           .min = 0,
           .help = "Radiant flux; the radiant intensity is power / (4 pi)."});
        f("intensity", intensity,
          {.unit = "W/sr", .min = 0, .help = "Radiant intensity, instead of `power`."});
        f("radius", radius, kLampRadiusAttr);
        f("unit", unit, kLightUnitAttr);
        f.group(color);
        f.group(controls);
    }
};

namespace dialects {
inline constexpr std::array kDirectionals{
    Spelling{.type = "sun",
             .today = "is <light type=\"directional\" visibleToCamera=\"true\"> today, whose "
                      "`angle` is the full one in degrees; `size` is half of it in radians",
             .rewrite = sun_as_directional},
};
} // namespace dialects

struct DirectionalLight {
    static constexpr schema::TypeInfo info{
        .category = "light",
        .type = "directional",
        .help = "Parallel light from infinitely far away or, with an angle, a disk there. The "
                "camera does not see the disk unless `visibleToCamera` says so; mirrors do.",
        .spellings = dialects::kDirectionals};
    Vec3 direction{0, 0, 1};
    Input<Color> intensity{Color(1)};
    float angle = 0;
    LightUnit unit = LightUnit::radiometric;
    LightColor color;
    LightControls controls{.visible_to_camera = false};

    template <class F>
    constexpr void describe(F&& f) {
        f("direction", direction, {.help = "Points towards the light."});
        f("intensity", intensity,
          {.unit = "W/m^2", .min = 0, .help = "Irradiance on a surface that faces it."});
        f("angle", angle,
          {.unit = "deg",
           .min = 0,
           .max = 180,
           .soft_max = 10,
           .help = "Full angle of the disk, which makes shadows soft: the sun's is 0.53. It has "
                   "the same irradiance whatever its angle."});
        f("unit", unit, kLightUnitAttr);
        f.group(color);
        f.group(controls);
    }
};

/// Between the bright cone and the dark.
enum class Falloff { linear, smooth };
constexpr auto choices(Falloff) { return std::array<std::string_view, 2>{"linear", "smooth"}; }

namespace dialects {
inline constexpr std::array kSpots{
    Spelling{.parameter = "falloffStart",
             .today = "and `angle` count from the axis; today `angle` is the full angle of full "
                      "intensity and `falloff` what the cone is wider, in which light falls "
                      "otherwise. The power is that of a light that shines all around",
             .rewrite = spot_by_half_angles},
};
inline constexpr std::string_view kSamplingToday =
    "has no effect: lights are sampled by what arrives of them";
inline constexpr std::array kAreas{
    Spelling{.parameter = "improved", .today = kSamplingToday},
    Spelling{.parameter = "intersectable",
             .today = "has no effect: light counts once, whether rays or light sampling find it"},
};
} // namespace dialects

struct SpotLight {
    static constexpr schema::TypeInfo info{
        .category = "light",
        .type = "spot",
        .help = "A cone of light from one point or, with a radius, a ball; it can project an "
                "image. The camera does not see the ball unless `visibleToCamera` says so; mirrors "
                "do.",
        .example = "<light type=\"spot\" position=\"0,3,0\" direction=\"0,-1,0\" angle=\"20\" "
                   "falloff=\"20\" falloffShape=\"smooth\" power=\"800\" unit=\"photometric\"/>",
        .spellings = dialects::kSpots};
    Vec3 position{0, 0, 0};
    Vec3 direction{0, 0, 1};
    Input<Color> intensity{Color(1)};
    Input<Color> power{Color(0)};
    float angle = 40;
    float falloff = 10;
    Falloff falloff_shape = Falloff::linear;
    Input<Color> gobo{Color(1)};
    Vec3 up{0, 1, 0};
    float radius = 0;
    LightUnit unit = LightUnit::radiometric;
    LightColor color;
    LightControls controls{.visible_to_camera = false};

    template <class F>
    constexpr void describe(F&& f) {
        f("position", position, {.unit = "scene", .help = "Where it is."});
        f("direction", direction, {.help = "Where it shines."});
        f("intensity", intensity,
          {.unit = "W/sr", .min = 0, .help = "Radiant intensity on the axis."});
        f("power", power,
          {.unit = "W",
           .min = 0,
           .help = "Radiant flux of the whole cone, instead of `intensity`: narrower cones are "
                   "brighter."});
        f("angle", angle,
          {.unit = "deg",
           .min = 0,
           .max = 360,
           .help = "Full angle of the cone of full intensity."});
        f("falloff", falloff,
          {.unit = "deg",
           .min = 0,
           .max = 360,
           .help = "Full angle by which the outer cone, beyond which it is dark, is wider."});
        f("falloffShape", falloff_shape,
          {.help = "From the inner cone to the outer: linear in the angle, or smooth at both ends "
                   "(a smoothstep in the cosine, as pbrt and Cycles have it)."});
        f("gobo", gobo,
          {.min = 0,
           .help = "An image in front of the lamp, a factor on its light: over the square around "
                   "the outer cone, which must be narrower than 180 degrees."});
        f("up", up,
          {.help = "Where the upper edge of the `gobo` points; a direction along the light's own "
                   "counts as 0,0,1."});
        f("radius", radius, kLampRadiusAttr);
        f("unit", unit, kLightUnitAttr);
        f.group(color);
        f.group(controls);
    }
};

struct IesLight {
    static constexpr schema::TypeInfo info{
        .category = "light",
        .type = "ies",
        .help =
            "A real lamp, as measured by its maker: the light's distribution and brightness "
            "come from an IES file (LM-63). With a radius, mirrors see it, and the camera where "
            "`visibleToCamera` says so.",
        .example = "<light type=\"ies\" filename=\"downlight.ies\" position=\"0,2.5,0\" "
                   "temperature=\"3000\"/>"};
    FileName filename;
    Vec3 position{0, 0, 0};
    Vec3 direction{0, -1, 0};
    Vec3 c0{1, 0, 0};
    Input<Color> tint{Color(1)};
    float radius = 0;
    LightColor color;
    LightControls controls{.visible_to_camera = false};

    template <class F>
    constexpr void describe(F&& f) {
        f("filename", filename,
          {.required = true, .help = "The .ies file; relative to the scene file."});
        f("position", position, {.unit = "scene", .help = "Where it is."});
        f("direction", direction,
          {.help = "Where the file's vertical angle 0, straight down, points to."});
        f("c0", c0,
          {.help = "Where the file's half plane of horizontal angle 0 points to; a direction along "
                   "the light's own counts as 0,0,1."});
        f("tint", tint,
          {.min = 0, .help = "A factor on the file's candela, of which 683 are 1 W/sr."});
        f("radius", radius, kLampRadiusAttr);
        f.group(color);
        f.group(controls);
    }
};

struct AreaLight {
    static constexpr schema::TypeInfo info{.category = "light",
                                           .type = "area",
                                           .help =
                                               "An emissive instance that is sampled as a light. "
                                               "It is part of the scene: do not list it again.",
                                           .spellings = dialects::kAreas};
    InstanceId instance;
    float power = 0;
    LightUnit unit = LightUnit::radiometric;
    float spread = 180;
    LightControls controls;

    template <class F>
    constexpr void describe(F&& f) {
        f("instance", instance,
          {.required = true, .help = "The instance; it carries an emission."});
        f("power", power,
          {.unit = "W",
           .min = 0,
           .help = "Radiant flux of the whole surface: the emission then says only its colour and "
                   "pattern, and is scaled so that the luminance of what leaves is that of a white "
                   "light of this power. 0: the emission is the radiance."});
        f("unit", unit,
          {.help = "What the power is given in: radiometric (W) or photometric (lm)."});
        f("spread", spread,
          {.unit = "deg",
           .min = 0.1,
           .max = 180,
           .help = "Full angle into which each point shines, as through the grid of a soft box: "
                   "smaller is narrower and as much brighter, since the power stays. 180 shines "
                   "like paper (Lambertian)."});
        f.group(controls);
    }
};

using Light = std::variant<PointLight, DirectionalLight, SpotLight, IesLight, EnvironmentLight,
                           SkyLight, AreaLight>;

} // namespace weft::scene
