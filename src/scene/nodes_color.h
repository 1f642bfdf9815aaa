// Nodes that change or make colours. Names, inputs and meanings are those of MaterialX 1.38, but
// for `colorramp`, which it lacks.
#pragma once

#include <array>
#include <string_view>

#include "scene/dialects.h"
#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene::nodes {

struct Luminance {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "luminance",
        .help = "How bright a colour looks (Rec. 709: mostly its green).",
        .output = ValueType::number};
    Input<Color> in{Color(0)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The colour."});
    }
};

struct Contrast {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "contrast",
        .help = "Moves values away from `pivot`, or, by amounts below 1, towards it.",
        .output = ValueType::inputs};
    Input<AnyValue> in;
    Input<AnyValue> amount{AnyValue(1.f)};
    Input<AnyValue> pivot{AnyValue(0.5f)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "What is changed."});
        f("amount", amount, {.help = "Factor on the distance from the pivot."});
        f("pivot", pivot, {.help = "What stays the same."});
    }
};

struct Range {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "range",
        .help = "As `remap`, with a gamma between: above 1 it lifts the middle tones.",
        .output = ValueType::inputs};
    Input<AnyValue> in;
    Input<AnyValue> inlow{AnyValue(0.f)};
    Input<AnyValue> inhigh{AnyValue(1.f)};
    Input<AnyValue> gamma{AnyValue(1.f)};
    Input<AnyValue> outlow{AnyValue(0.f)};
    Input<AnyValue> outhigh{AnyValue(1.f)};
    bool doclamp = false;

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "What is mapped."});
        f("inlow", inlow, {.help = "What becomes `outlow`."});
        f("inhigh", inhigh, {.help = "What becomes `outhigh`."});
        f("gamma", gamma, {.help = "The value between 0 and 1 to the power of 1 / gamma."});
        f("outlow", outlow, {.help = "Result at `inlow`."});
        f("outhigh", outhigh, {.help = "Result at `inhigh`."});
        f("doclamp", doclamp, {.help = "Keep the result within outlow .. outhigh."});
    }
};

struct Saturate {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "saturate",
        .help = "Between grey (0), the colour itself (1), and more colourful (2).",
        .output = ValueType::color};
    Input<Color> in{Color(0)};
    Input<float> amount{1};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The colour."});
        f("amount", amount, {.soft_max = 2, .help = "How colourful."});
    }
};

struct HsvAdjust {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "hsvadjust",
        .help = "Turns the hue, scales saturation and brightness (the value of HSV).",
        .output = ValueType::color};
    Input<Color> in{Color(0)};
    Input<Vec3> amount{Vec3(0, 1, 1)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The colour."});
        f("amount", amount,
          {.help = "Turns to add to the hue (1 is all the way round), factor on the saturation, "
                   "factor on the value."});
    }
};

struct ColorCorrect {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "colorcorrect",
                                           .help =
                                               "All the usual corrections, in this order: hue, "
                                               "saturation, gamma, lift, gain, contrast, exposure.",
                                           .output = ValueType::color};
    Input<Color> in{Color(1)};
    Input<float> hue{0};
    Input<float> saturation{1};
    Input<float> gamma{1};
    Input<float> lift{0};
    Input<float> gain{1};
    Input<float> contrast{1};
    Input<float> contrast_pivot{0.5f};
    Input<float> exposure{0};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The colour."});
        f("hue", hue, {.unit = "turn", .help = "Turns the hue."});
        f("saturation", saturation, {.soft_max = 2, .help = "0 is grey, 1 no change."});
        f("gamma", gamma,
          {.soft_max = 4, .help = "To the power of 1 / gamma: above 1 lifts the middle tones."});
        f("lift", lift, {.help = "Raises black to this value; white stays."});
        f("gain", gain, {.help = "A factor on all."});
        f("contrast", contrast, {.help = "Factor on the distance from `contrastpivot`."});
        f("contrastpivot", contrast_pivot, {.help = "What contrast leaves the same."});
        f("exposure", exposure, {.unit = "stops", .help = "Twice as bright for each."});
    }
};

inline constexpr std::array kTints{
    schema::Spelling{.parameter = "tint",
                     .today = "is one factor of a <texture type=\"multiply\"> today, and the glow "
                              "is the other",
                     .rewrite = dialects::tinted_blackbody},
};

struct Blackbody {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "blackbody",
        .help = "Colour of what glows by its heat, at luminance 1 (Planck's law). Candle 1900 K, "
                "light bulb 2700 K, noon sun 5800 K, overcast sky 6500 K. Redder than the screen "
                "can show (below 1900 K), it is as red as possible.",
        .example = "<emission type=\"lambertian\"><texture name=\"emission\" type=\"blackbody\" "
                   "temperature=\"2700\"/></emission>",
        .output = ValueType::color,
        .spellings = kTints};
    Input<float> temperature{5000};

    template <class F>
    constexpr void describe(F&& f) {
        f("temperature", temperature,
          {.unit = "K",
           .min = 800,
           .max = 40000,
           .help = "Temperature; beyond the ends it is that of the end."});
    }
};

enum class RampInterpolation { linear, smooth, constant };
constexpr auto choices(RampInterpolation) {
    return std::array<std::string_view, 3>{"linear", "smooth", "constant"};
}

struct ColorRamp {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "colorramp",
        .help = "Gives every number a colour: that of the stops around it.",
        .example = "<texture name=\"baseColor\" type=\"colorramp\" stops=\"0: 0.02,0.1,0.02; 0.6: "
                   "0.3,0.25,0.1; 1: 0.9\">\n  <texture name=\"in\" type=\"fractal3d\"/></texture>",
        .output = ValueType::color};
    Input<float> in{0};
    schema::ColorStops stops;
    RampInterpolation interpolation = RampInterpolation::linear;

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The number, as a noise or an image gives it."});
        f("stops", stops,
          {.help = "position: color, separated by semicolons, positions ascending. Before the "
                   "first and after the last stop it stays the same."});
        f("interpolation", interpolation,
          {.help = "Between stops: straight, eased in and out, or in steps."});
    }
};

} // namespace weft::scene::nodes
