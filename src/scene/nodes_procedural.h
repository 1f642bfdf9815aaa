// Nodes that make patterns out of places. Names, inputs and meanings are those of MaterialX 1.38;
// the noises' random numbers are our own, so that the same scene looks different elsewhere.
#pragma once

#include <array>
#include <string_view>

#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene::nodes {

struct Place2d {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "place2d",
        .help = "Moves, turns and scales uv: for the `texcoord` of other nodes.",
        .example = "<texture name=\"albedo\" type=\"image\" filename=\"tiles.png\">\n  <texture "
                   "name=\"texcoord\" type=\"place2d\" scale=\"0.1\" rotate=\"45\"/></texture>",
        .output = ValueType::vector2};
    Input<SurfaceUv> texcoord;
    Input<Vec2> pivot{Vec2(0, 0)};
    Input<Vec2> scale{Vec2(1, 1)};
    Input<float> rotate{0};
    Input<Vec2> offset{Vec2(0, 0)};

    template <class F>
    constexpr void describe(F&& f) {
        f("texcoord", texcoord, {.help = "Where to look; unconnected: the surface's uv."});
        f("pivot", pivot, {.help = "Centre of turning and scaling."});
        f("scale", scale, {.help = "Size of the pattern: 2 makes it twice as large."});
        f("rotate", rotate, {.unit = "deg", .help = "Turns the pattern counter-clockwise."});
        f("offset", offset, {.help = "Moves the pattern."});
    }
};

struct RampLr {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "ramplr",
        .help = "From left to right: one value at u = 0, another at u = 1, straight between.",
        .output = ValueType::inputs};
    Input<AnyValue> valuel{AnyValue(0.f)};
    Input<AnyValue> valuer{AnyValue(1.f)};
    Input<SurfaceUv> texcoord;

    template <class F>
    constexpr void describe(F&& f) {
        f("valuel", valuel, {.help = "Left."});
        f("valuer", valuer, {.help = "Right."});
        f("texcoord", texcoord, {.help = "Where to look; unconnected: the surface's uv."});
    }
};

struct RampTb {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "ramptb",
        .help = "From top to bottom: one value at v = 1, another at v = 0, straight between.",
        .output = ValueType::inputs};
    Input<AnyValue> valuet{AnyValue(0.f)};
    Input<AnyValue> valueb{AnyValue(1.f)};
    Input<SurfaceUv> texcoord;

    template <class F>
    constexpr void describe(F&& f) {
        f("valuet", valuet, {.help = "Top."});
        f("valueb", valueb, {.help = "Bottom."});
        f("texcoord", texcoord, {.help = "Where to look; unconnected: the surface's uv."});
    }
};

struct Noise2d {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "noise2d",
        .help = "Smooth random hills over uv, one per unit (Perlin noise).",
        .output = ValueType::number};
    Input<float> amplitude{1};
    Input<float> pivot{0};
    Input<SurfaceUv> texcoord;

    template <class F>
    constexpr void describe(F&& f) {
        f("amplitude", amplitude,
          {.help = "Factor: the result lies in pivot - amplitude .. pivot + amplitude."});
        f("pivot", pivot, {.help = "The middle."});
        f("texcoord", texcoord, {.help = "Where to look; unconnected: the surface's uv."});
    }
};

struct Noise3d {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "noise3d",
                                           .help =
                                               "Smooth random hills in space, one per unit (Perlin "
                                               "noise): clouds, dirt, unevenness without uvs.",
                                           .output = ValueType::number};
    Input<float> amplitude{1};
    Input<float> pivot{0};
    Input<SurfacePosition> position;

    template <class F>
    constexpr void describe(F&& f) {
        f("amplitude", amplitude,
          {.help = "Factor: the result lies in pivot - amplitude .. pivot + amplitude."});
        f("pivot", pivot, {.help = "The middle."});
        f("position", position,
          {.help = "Where to look; unconnected: the position in the object's space."});
    }
};

struct Fractal3d {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "fractal3d",
        .help = "Noise upon finer noise upon finer noise: stone, rust, marble.",
        .output = ValueType::number};
    Input<float> amplitude{1};
    int octaves = 3;
    Input<float> lacunarity{2};
    Input<float> diminish{0.5f};
    Input<SurfacePosition> position;

    template <class F>
    constexpr void describe(F&& f) {
        f("amplitude", amplitude, {.help = "Factor on all."});
        f("octaves", octaves, {.min = 1, .max = 16, .help = "How many noises are added."});
        f("lacunarity", lacunarity, {.help = "How much finer each is than the one before."});
        f("diminish", diminish,
          {.soft_max = 1, .help = "How much weaker each is than the one before."});
        f("position", position,
          {.help = "Where to look; unconnected: the position in the object's space."});
    }
};

struct CellNoise2d {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "cellnoise2d",
        .help = "One random number, 0 to 1, for each unit square of uv.",
        .output = ValueType::number};
    Input<SurfaceUv> texcoord;

    template <class F>
    constexpr void describe(F&& f) {
        f("texcoord", texcoord, {.help = "Where to look; unconnected: the surface's uv."});
    }
};

struct CellNoise3d {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "cellnoise3d",
        .help = "One random number, 0 to 1, for each unit cube of space.",
        .output = ValueType::number};
    Input<SurfacePosition> position;

    template <class F>
    constexpr void describe(F&& f) {
        f("position", position,
          {.help = "Where to look; unconnected: the position in the object's space."});
    }
};

enum class WorleyFeature { f1, f2, f2_f1 };
constexpr auto choices(WorleyFeature) {
    return std::array<std::string_view, 3>{"f1", "f2", "f2-f1"};
}

struct WorleyNoise2d {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "worleynoise2d",
        .help =
            "Distance to the nearest of random points, one per unit square of uv (Worley 1996).",
        .output = ValueType::number};
    Input<float> jitter{1};
    WorleyFeature feature = WorleyFeature::f1;
    Input<SurfaceUv> texcoord;

    template <class F>
    constexpr void describe(F&& f) {
        f("jitter", jitter,
          {.min = 0, .max = 1, .help = "How far the points are from a regular grid."});
        f("feature", feature,
          {.help = "Distance to the nearest point (bubbles, leather), to the second nearest, or "
                   "the second less the first (cracks are where it is 0)."});
        f("texcoord", texcoord, {.help = "Where to look; unconnected: the surface's uv."});
    }
};

struct WorleyNoise3d {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "worleynoise3d",
        .help =
            "Distance to the nearest of random points, one per unit cube of space (Worley 1996).",
        .output = ValueType::number};
    Input<float> jitter{1};
    WorleyFeature feature = WorleyFeature::f1;
    Input<SurfacePosition> position;

    template <class F>
    constexpr void describe(F&& f) {
        f("jitter", jitter,
          {.min = 0, .max = 1, .help = "How far the points are from a regular grid."});
        f("feature", feature,
          {.help = "Distance to the nearest point (bubbles, leather), to the second nearest, or "
                   "the second less the first (cracks are where it is 0)."});
        f("position", position,
          {.help = "Where to look; unconnected: the position in the object's space."});
    }
};

} // namespace weft::scene::nodes
