// How bright lights are and in what colour, said in one way for all of them. docs/lighting.md has
// the units in one table.
//
// Brightness is radiometric: watts (power), W/sr (intensity), W/m^2 (irradiance), W/(m^2 sr)
// (radiance), each for the red, green and blue part of the light. Where a light says
// unit="photometric" the same numbers are lumens, candela, lux and nits, and 683 lm are a watt in
// every channel: the convention of glTF's KHR_lights_punctual and of Blender's importer. As 683
// lm/W is the efficacy of green light at 555 nm alone, these watts are no measured ones; but lights
// of all kinds keep their proportions, and a grey light of 683 lm has luminance 1 W.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "base/blackbody.h"
#include "schema/describe.h"

namespace weft::scene {

inline constexpr float kLumensPerWatt = 683;

enum class LightUnit { radiometric, photometric };
constexpr auto choices(LightUnit) {
    return std::array<std::string_view, 2>{"radiometric", "photometric"};
}
/// How every light describes its `unit`.
inline constexpr schema::Attr kLightUnitAttr{
    .help = "What its brightness is given in: radiometric (W, W/sr, W/m^2, W/(m^2 sr)) or "
            "photometric (lm, cd, lx, nt); 683 lm are 1 W."};

struct LightColor {
    float exposure = 0;
    float temperature = 0;

    template <class F>
    constexpr void describe(F&& f) {
        f("exposure", exposure,
          {.unit = "stops", .min = -60, .max = 60, .help = "Twice as bright for each."});
        f("temperature", temperature,
          {.unit = "K",
           .min = 0,
           .max = 40000,
           .help =
               "Tint: the colour of what glows by that heat, at luminance 1. Candle 1900, light "
               "bulb 2700, noon sun 5800, overcast sky 6500; 0 is no tint."});
    }
    friend constexpr bool operator==(LightColor const&, LightColor const&) = default;
};

/// Returns the factor on the brightness that a light gives; exactly 1 for the defaults.
inline Color scale_of(LightColor const& color, LightUnit unit = LightUnit::radiometric) {
    float const stops = color.exposure == 0 ? 1 : std::exp2(color.exposure);
    float const factor = unit == LightUnit::photometric ? stops / kLumensPerWatt : stops;
    return color.temperature > 0 ? blackbody_color(color.temperature) * factor : Color(factor);
}

} // namespace weft::scene
