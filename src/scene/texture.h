// Textures: the nodes of the networks that say what varies over a surface. Every parameter that is
// an `Input` can be fed by a node, those of nodes included. Types, inputs and meanings are those of
// MaterialX 1.38's standard nodes where it has one.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "scene/color_space.h"
#include "scene/dialects.h"
#include "scene/handles.h"
#include "scene/nodes_color.h"
#include "scene/nodes_geometry.h"
#include "scene/nodes_math.h"
#include "scene/nodes_procedural.h"
#include "schema/describe.h"

namespace weft::scene {

struct ConstantTexture {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "constant",
                                           .help = "The same value everywhere.",
                                           .output = ValueType::color};
    Color value{1};

    template <class F>
    constexpr void describe(F&& f) {
        f("value", value, {.required = true, .help = "The value; one number stands for a grey."});
    }
};

enum class TextureBorder { repeat, clamp };
constexpr auto choices(TextureBorder) { return std::array<std::string_view, 2>{"repeat", "clamp"}; }
/// Bilinear is the default because it is what lightwave does: its scenes keep their pictures.
enum class TextureFilter { bilinear, nearest, mipmap };
constexpr auto choices(TextureFilter) {
    return std::array<std::string_view, 3>{"bilinear", "nearest", "mipmap"};
}

/// What stands for the number of a tile in the name of a set of files.
inline constexpr std::string_view kUdim = "<UDIM>";

namespace dialects {
inline constexpr std::array kImages{
    Spelling{.parameter = "image",
             .today = "is `filename` and `linear` of the texture itself today",
             .rewrite = image_file},
};
inline constexpr std::array kCheckerboards{
    Spelling{.parameter = "value", .today = "has no effect: the colours are `color0` and `color1`"},
    Spelling{.parameter = "scale",
             .today = "is two numbers today, not a texture of a constant colour",
             .rewrite = scale_of_constant},
};
} // namespace dialects

struct ImageTexture {
    static constexpr schema::TypeInfo info{
        .category = "texture",
        .type = "image",
        .help = "An image file over the unit square of uv; v runs upwards. 8 and 16 bit files hold "
                "screen colours unless `linear` is set, float files (EXR, HDR) are linear.",
        .example = "<texture name=\"albedo\" type=\"image\" filename=\"wood.png\"/>",
        .output = ValueType::color,
        .spellings = dialects::kImages};
    FileName filename;
    float exposure = 1;
    TextureBorder border = TextureBorder::repeat;
    TextureFilter filter = TextureFilter::bilinear;
    bool linear = false;
    ColorSpace color_space = ColorSpace::automatic;
    Input<SurfaceUv> texcoord;

    template <class F>
    constexpr void describe(F&& f) {
        f("filename", filename,
          {.required = true,
           .help = "PNG, JPEG, EXR, HDR, TIFF, ...; relative to the scene file. <UDIM> in the name "
                   "stands for the numbers of tiles, 1001 + u + 10 v."});
        f("exposure", exposure, {.min = 0, .help = "A factor on all values."});
        f("border", border,
          {.help = "What lies outside of [0, 1]: the image again, or its border pixels."});
        f("filter", filter,
          {.help = "How values between pixel centres are made. `mipmap` also averages the pixels "
                   "that a ray cannot tell apart, from smaller copies of the image: best for large "
                   "and for distant textures. Opacity, emission and backgrounds take it as "
                   "`bilinear`."});
        f("linear", linear, {.help = "The file holds data (roughness, normals), not colours."});
        f("colorSpace", color_space,
          {.help = "What the colours of the file are: what it says itself (chromaticities of EXR, "
                   "gAMA, cHRM, cICP and ICC profiles, EXPOSURE of HDR; auto); else, and where it "
                   "says sRGB, 8 and 16 bit files have a gamma of 2.2 as in lightwave. Anything "
                   "else overrules the file: a gamma of 2.2, sRGB's own curve, or none."});
        f("texcoord", texcoord,
          {.help = "Where to look; unconnected: the surface's uv. A `place2d` node moves, turns "
                   "and repeats it."});
    }
};

struct Checkerboard {
    static constexpr schema::TypeInfo info{.category = "texture",
                                           .type = "checkerboard",
                                           .help = "Two colours in alternating cells.",
                                           .output = ValueType::color,
                                           .spellings = dialects::kCheckerboards};
    Input<Color> color0{Color(0)};
    Input<Color> color1{Color(1)};
    Input<Vec2> scale{Vec2(1, 1)};
    Input<SurfaceUv> texcoord;

    template <class F>
    constexpr void describe(F&& f) {
        f("color0", color0, {.help = "Colour of the cell at the origin of uv."});
        f("color1", color1, {.help = "The other colour."});
        f("scale", scale, {.help = "Number of cells along u and v."});
        f("texcoord", texcoord, {.help = "Where to look; unconnected: the surface's uv."});
    }
};

using Texture = std::variant<
    ConstantTexture, ImageTexture, Checkerboard, nodes::Place2d, nodes::RampLr, nodes::RampTb,
    nodes::Noise2d, nodes::Noise3d, nodes::Fractal3d, nodes::CellNoise2d, nodes::CellNoise3d,
    nodes::WorleyNoise2d, nodes::WorleyNoise3d, nodes::ColorRamp, nodes::Blackbody, nodes::Mix,
    nodes::Add, nodes::Subtract, nodes::Multiply, nodes::Divide, nodes::Modulo, nodes::Power,
    nodes::Min, nodes::Max, nodes::Absval, nodes::Floor, nodes::Ceil, nodes::Sin, nodes::Cos,
    nodes::Invert, nodes::Clamp, nodes::Remap, nodes::Smoothstep, nodes::Range, nodes::Contrast,
    nodes::Luminance, nodes::Saturate, nodes::HsvAdjust, nodes::ColorCorrect, nodes::DotProduct,
    nodes::CrossProduct, nodes::Normalize, nodes::Magnitude, nodes::Extract, nodes::Combine2,
    nodes::Combine3, nodes::Convert, nodes::Position, nodes::Normal, nodes::Tangent,
    nodes::Texcoord, nodes::FacingRatio, nodes::GeomPropValue, nodes::InstanceRandom,
    nodes::NormalMap, nodes::Bump, nodes::Triplanar>;

} // namespace weft::scene
