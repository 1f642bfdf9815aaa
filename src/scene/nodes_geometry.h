// Nodes that tell about the surface, or bend its normal. Names, inputs and meanings are those of
// MaterialX 1.38, but for `instancerandom` and `triplanar` (there: triplanarprojection, of images).
#pragma once

#include "scene/color_space.h"
#include "scene/dialects.h"
#include "scene/nodes_math.h"

namespace weft::scene::nodes {

enum class Space { object, world };
constexpr auto choices(Space) { return std::array<std::string_view, 2>{"object", "world"}; }

struct Position {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "position",
                                           .help = "Where the point is.",
                                           .output = ValueType::vector3};
    Space space = Space::object;

    template <class F>
    constexpr void describe(F&& f) {
        f("space", space, {.help = "Whose axes: `object` moves with the instance."});
    }
};

inline constexpr std::array kNormalFiles{
    schema::Spelling{.parameter = "filename",
                     .today = "is one of <texture type=\"image\" linear=\"true\"> today",
                     .rewrite = dialects::normals_file},
};

struct Normal {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "normal",
                                           .help = "Unit shading normal.",
                                           .output = ValueType::vector3,
                                           .spellings = kNormalFiles};
    Space space = Space::object;

    template <class F>
    constexpr void describe(F&& f) {
        f("space", space, {.help = "Whose axes; material inputs expect `world`."});
    }
};

struct Tangent {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "tangent",
                                           .help = "Unit tangent, the direction in which u grows.",
                                           .output = ValueType::vector3};
    Space space = Space::object;

    template <class F>
    constexpr void describe(F&& f) {
        f("space", space, {.help = "Whose axes; material inputs expect `world`."});
    }
};

struct Texcoord {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "texcoord",
                                           .help = "Surface coordinates (u, v).",
                                           .output = ValueType::vector2};

    template <class F>
    constexpr void describe(F&&) {}
};

struct FacingRatio {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "facingratio",
        .help = "1 where the surface faces the viewer, 0 at the silhouette: dust, velvet, X-rays.",
        .output = ValueType::number};
    Input<SurfaceNormal> normal;
    bool faceforward = true;
    bool invert = false;

    template <class F>
    constexpr void describe(F&& f) {
        f("normal", normal, {.help = "Normal in world space; unconnected: the shading normal."});
        f("faceforward", faceforward,
          {.help = "The back counts as the front; otherwise it is negative."});
        f("invert", invert, {.help = "1 minus that."});
    }
};

struct GeomPropValue {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "geompropvalue",
        .help = "A property of the mesh's vertices, interpolated: of a PLY file its vertex colours "
                "(red, green, blue as `color`) and every other number by its name.",
        .example = "<texture name=\"albedo\" type=\"geompropvalue\" geomprop=\"color\" "
                   "colorSpace=\"srgb_texture\"/>",
        .output = ValueType::chosen};
    std::string geomprop;
    AnyType output = AnyType::color3;
    AnyValue fallback{0.f};
    ColorSpace color_space = ColorSpace::lin_rec709;
    constexpr ValueType output_type() const { return value_type(output); }

    template <class F>
    constexpr void describe(F&& f) {
        f("geomprop", geomprop, {.required = true, .help = "Name of the property."});
        f("output", output,
          {.help = "What it is; a property of one number stands in all channels."});
        f("default", fallback, {.help = "Value on shapes without that property."});
        f("colorSpace", color_space,
          {.help = "How colours are stored: files do not say; scanners and Blender's byte colours "
                   "mean sRGB."});
    }
};

struct InstanceRandom {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "instancerandom",
        .help = "A random number, 0 to 1, that is the same all over an object and different for "
                "every object.",
        .example =
            "<texture name=\"baseColor\" type=\"mix\" fg=\"0.1,0.3,0.05\" bg=\"0.3,0.4,0.1\">\n  "
            "<texture name=\"mix\" type=\"instancerandom\"/></texture>",
        .output = ValueType::number};
    int seed = 0;

    template <class F>
    constexpr void describe(F&& f) {
        f("seed", seed, {.help = "Another seed, another set of numbers."});
    }
};

enum class Handedness { opengl, directx };
constexpr auto choices(Handedness) { return std::array<std::string_view, 2>{"opengl", "directx"}; }

struct NormalMap {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "normalmap",
        .help = "A normal out of a tangent-space normal map, for the `normal` input of a material.",
        .example = "<texture name=\"normal\" type=\"normalmap\">\n  <texture name=\"in\" "
                   "type=\"image\" filename=\"bricks_n.png\" linear=\"true\"/></texture>",
        .output = ValueType::vector3};
    Input<AnyValue> in{AnyValue(0.5f, 0.5f, 1)};
    Input<float> scale{1};
    Handedness handedness = Handedness::opengl;
    Input<SurfaceNormal> normal;

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in,
          {.help = "The map, 0 .. 1 standing for -1 .. 1; load the image with linear=\"true\"."});
        f("scale", scale, {.soft_max = 2, .help = "Strength: 0 is flat."});
        f("handedness", handedness,
          {.help = "Whether green is up (OpenGL, Blender) or down (DirectX)."});
        f("normal", normal,
          {.help = "What is bent, in world space; unconnected: the shading normal."});
    }
};

struct Bump {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "bump",
        .help = "A normal as if the surface were raised by `height`, for the `normal` input of a "
                "material. Works with any nodes that depend on uv or position, images and noises "
                "alike; not with vertex properties.",
        .example = "<texture name=\"normal\" type=\"bump\" scale=\"0.01\">\n  <texture "
                   "name=\"height\" type=\"fractal3d\"/></texture>",
        .output = ValueType::vector3};
    Input<float> height{0};
    Input<float> scale{1};
    Input<SurfaceNormal> normal;
    Input<float> step{0};

    template <class F>
    constexpr void describe(F&& f) {
        f("height", height, {.unit = "scene", .help = "How far the surface is raised."});
        f("scale", scale, {.help = "Factor on the height."});
        f("normal", normal,
          {.help = "What is bent, in world space; unconnected: the shading normal."});
        f("step", step,
          {.unit = "scene",
           .min = 0,
           .help = "How far to both sides slopes are measured: a tenth of the finest detail is a "
                   "good choice. 0: 1/2000 of the uv square, or of the object's unit where there "
                   "are no uvs."});
    }
};

struct Triplanar {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "triplanar",
        .help = "Projects a pattern along the three axes, and blends by the normal: images without "
                "uvs.",
        .example = "<texture name=\"albedo\" type=\"triplanar\" scale=\"2\">\n  <texture "
                   "name=\"in\" type=\"image\" filename=\"concrete.png\"/></texture>",
        .output = ValueType::inputs};
    Input<AnyValue> in;
    Input<float> scale{1};
    Input<float> blend{1};
    Space space = Space::object;

    template <class F>
    constexpr void describe(F&& f) {
        f("in", in, {.help = "The pattern: its uv becomes two of the position's coordinates."});
        f("scale", scale, {.help = "Repeats per unit of length."});
        f("blend", blend, {.min = 0, .max = 1, .help = "0 is hard edges, 1 soft."});
        f("space", space, {.help = "Whose axes: `object` moves with the instance."});
    }
};

} // namespace weft::scene::nodes
