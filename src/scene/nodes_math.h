// Nodes that calculate. Names, inputs and meanings are those of MaterialX 1.38; what divides by 0
// or takes the root of a negative number gives 0, so that no network makes NaN out of good numbers.
// Left out on purpose: vector2 forms of the geometric ones (convert to vector3 first).
#pragma once

#include <array>
#include <string_view>

#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene::nodes {

/// A node of one input that works on each channel by itself.
template <class Op>
struct Unary {
    static constexpr schema::TypeInfo info = Op::info;
    Input<AnyValue> in;

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "x, of any type."});
    }
};

/// A node of two inputs that works on each channel by itself.
template <class Op>
struct Binary {
    static constexpr schema::TypeInfo info = Op::info;
    Input<AnyValue> in1;
    Input<AnyValue> in2{AnyValue(Op::neutral)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in1", in1, {.help = "a, of any type."});
        f("in2", in2, {.help = "b, of the same type or a number."});
    }
};

struct AddOp {
    static constexpr float neutral = 0;
    static constexpr schema::TypeInfo info{
        .category = "texture", .type = "add", .help = "a + b.", .output = ValueType::inputs};
};
struct SubtractOp {
    static constexpr float neutral = 0;
    static constexpr schema::TypeInfo info{
        .category = "texture", .type = "subtract", .help = "a - b.", .output = ValueType::inputs};
};
struct MultiplyOp {
    static constexpr float neutral = 1;
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "multiply",
                                           .help = "a times b: masks, tints.",
                                           .output = ValueType::inputs};
};
struct DivideOp {
    static constexpr float neutral = 1;
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "divide",
                                           .help = "a / b; 0 where b is 0.",
                                           .output = ValueType::inputs};
};
struct ModuloOp {
    static constexpr float neutral = 1;
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "modulo",
        .help = "What is left of a after dividing by b, from 0 up to b: a pattern again and again.",
        .output = ValueType::inputs};
};
struct PowerOp {
    static constexpr float neutral = 1;
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "power",
                                           .help =
                                               "a to the power of b; 0 where that is no number.",
                                           .output = ValueType::inputs};
};
struct MinOp {
    static constexpr float neutral = 0;
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "min",
                                           .help = "The smaller of a and b.",
                                           .output = ValueType::inputs};
};
struct MaxOp {
    static constexpr float neutral = 0;
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "max",
                                           .help = "The larger of a and b.",
                                           .output = ValueType::inputs};
};
struct AbsvalOp {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "absval",
                                           .help = "x without its sign.",
                                           .output = ValueType::inputs};
};
struct FloorOp {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "floor",
        .help = "The largest whole number that is not above x: steps.",
        .output = ValueType::inputs};
};
struct CeilOp {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "ceil",
                                           .help = "The smallest whole number that is not below x.",
                                           .output = ValueType::inputs};
};
struct SinOp {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "sin",
                                           .help = "Sine of x in radians: waves.",
                                           .output = ValueType::inputs};
};
struct CosOp {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "cos",
                                           .help = "Cosine of x in radians.",
                                           .output = ValueType::inputs};
};

using Add = Binary<AddOp>;
using Subtract = Binary<SubtractOp>;
using Multiply = Binary<MultiplyOp>;
using Divide = Binary<DivideOp>;
using Modulo = Binary<ModuloOp>;
using Power = Binary<PowerOp>;
using Min = Binary<MinOp>;
using Max = Binary<MaxOp>;
using Absval = Unary<AbsvalOp>;
using Floor = Unary<FloorOp>;
using Ceil = Unary<CeilOp>;
using Sin = Unary<SinOp>;
using Cos = Unary<CosOp>;

struct Invert {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "invert",
                                           .help = "`amount` - in: black for white.",
                                           .output = ValueType::inputs};
    Input<AnyValue> in;
    Input<AnyValue> amount{AnyValue(1.f)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "What is turned round."});
        f("amount", amount, {.help = "What white is."});
    }
};

struct Clamp {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "clamp",
                                           .help = "in, but not below `low` nor above `high`.",
                                           .output = ValueType::inputs};
    Input<AnyValue> in;
    Input<AnyValue> low{AnyValue(0.f)};
    Input<AnyValue> high{AnyValue(1.f)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "What is limited."});
        f("low", low, {.help = "The least result."});
        f("high", high, {.help = "The largest result."});
    }
};

struct Remap {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "remap",
        .help = "Stretches the range inlow .. inhigh over outlow .. outhigh, and what lies outside "
                "with it.",
        .example =
            "<texture name=\"roughness\" type=\"remap\" outlow=\"0.2\" outhigh=\"0.6\">\n  "
            "<texture name=\"in\" type=\"image\" filename=\"wear.png\" linear=\"true\"/></texture>",
        .output = ValueType::inputs};
    Input<AnyValue> in;
    Input<AnyValue> inlow{AnyValue(0.f)};
    Input<AnyValue> inhigh{AnyValue(1.f)};
    Input<AnyValue> outlow{AnyValue(0.f)};
    Input<AnyValue> outhigh{AnyValue(1.f)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "What is mapped."});
        f("inlow", inlow, {.help = "What becomes `outlow`."});
        f("inhigh", inhigh, {.help = "What becomes `outhigh`."});
        f("outlow", outlow, {.help = "Result at `inlow`."});
        f("outhigh", outhigh, {.help = "Result at `inhigh`."});
    }
};

struct Smoothstep {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "smoothstep",
        .help = "0 up to `low`, 1 from `high` on, and a smooth rise between: a soft threshold.",
        .output = ValueType::inputs};
    Input<AnyValue> in;
    Input<AnyValue> low{AnyValue(0.f)};
    Input<AnyValue> high{AnyValue(1.f)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "What is compared."});
        f("low", low, {.help = "Where the rise begins."});
        f("high", high, {.help = "Where it ends."});
    }
};

struct Mix {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "mix",
        .help = "`bg` and `fg` in the proportion of `mix`.",
        .example =
            "<texture name=\"baseColor\" type=\"mix\" fg=\"0.4,0.1,0.05\" bg=\"0.7\">\n  <texture "
            "name=\"mix\" type=\"image\" filename=\"rust_mask.png\" linear=\"true\"/></texture>",
        .output = ValueType::inputs};
    Input<AnyValue> fg{AnyValue(0.f)};
    Input<AnyValue> bg{AnyValue(0.f)};
    Input<float> mix{0};

    template <class F>
    constexpr void describe(F&& f) {
        f("fg", fg, {.help = "What is there at mix 1."});
        f("bg", bg, {.help = "What is there at mix 0."});
        f("mix", mix, {.soft_max = 1, .help = "Share of `fg`: a mask."});
    }
};

struct DotProduct {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "dotproduct",
        .help = "Dot product of two vectors: the cosine between unit ones.",
        .output = ValueType::number};
    Input<Vec3> in1{Vec3(0, 0, 0)};
    Input<Vec3> in2{Vec3(0, 0, 0)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in1", in1, {.help = "a."});
        f("in2", in2, {.help = "b."});
    }
};

struct CrossProduct {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "crossproduct",
                                           .help = "The vector at right angles to both.",
                                           .output = ValueType::vector3};
    Input<Vec3> in1{Vec3(0, 0, 0)};
    Input<Vec3> in2{Vec3(0, 0, 0)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in1", in1, {.help = "a."});
        f("in2", in2, {.help = "b."});
    }
};

struct Normalize {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "normalize",
                                           .help = "A vector scaled to length 1; 0 stays 0.",
                                           .output = ValueType::vector3};
    Input<Vec3> in{Vec3(0, 0, 0)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The vector."});
    }
};

struct Magnitude {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "magnitude",
                                           .help = "Length of a vector: distance from the origin.",
                                           .output = ValueType::number};
    Input<Vec3> in{Vec3(0, 0, 0)};

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The vector."});
    }
};

struct Extract {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "extract",
                                           .help =
                                               "One channel of a colour or component of a vector.",
                                           .output = ValueType::number};
    Input<AnyValue> in;
    int index = 0;

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The colour or vector."});
        f("index", index,
          {.min = 0, .max = 2, .help = "0 is red or x, 1 green or y, 2 blue or z."});
    }
};

struct Combine2 {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "combine2",
                                           .help = "A vector2 of two numbers.",
                                           .output = ValueType::vector2};
    Input<float> in1{0};
    Input<float> in2{0};

    template <class F>
    constexpr void describe(F&& f) {
        f("in1", in1, {.help = "x."});
        f("in2", in2, {.help = "y."});
    }
};

enum class Triple { color3, vector3 };
constexpr auto choices(Triple) { return std::array<std::string_view, 2>{"color3", "vector3"}; }

struct Combine3 {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "combine3",
                                           .help = "A colour or vector of three numbers.",
                                           .output = ValueType::chosen};
    Input<float> in1{0};
    Input<float> in2{0};
    Input<float> in3{0};
    Triple output = Triple::color3;
    constexpr ValueType output_type() const {
        return output == Triple::color3 ? ValueType::color : ValueType::vector3;
    }

    template <class F>
    constexpr void describe(F&& f) {
        f("in1", in1, {.help = "Red or x."});
        f("in2", in2, {.help = "Green or y."});
        f("in3", in3, {.help = "Blue or z."});
        f("output", output, {.help = "What it is."});
    }
};

enum class AnyType { number, color3, vector2, vector3 };
constexpr auto choices(AnyType) {
    return std::array<std::string_view, 4>{"float", "color3", "vector2", "vector3"};
}
constexpr ValueType value_type(AnyType t) {
    constexpr std::array<ValueType, 4> types{ValueType::number, ValueType::color,
                                             ValueType::vector2, ValueType::vector3};
    return types[size_t(t)];
}

struct Convert {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "convert",
        .help = "The same numbers as another type: red, green, blue as x, y, z; a colour as the "
                "mean of its channels; a number in all channels; z is 0 where there was none.",
        .output = ValueType::chosen};
    Input<AnyValue> in;
    AnyType output = AnyType::color3;
    constexpr ValueType output_type() const { return value_type(output); }

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "What is converted; of a vector, `extract` makes a number."});
        f("output", output, {.help = "What it becomes."});
    }
};

} // namespace weft::scene::nodes
