// Materials made of materials: layers one over another, a clear coat, a mixture, and what stands
// in for a costly material where light has been scattered before.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "scene/dialects.h"
#include "scene/material_traits.h"
#include "schema/describe.h"

namespace weft::scene {

inline constexpr schema::Attr kLabelAttr{
    .help = "Name of the layer: the AOV `layers` has a picture of the light that the camera sees "
            "it scatter, all layers of one name together. Letters, digits, _ and -; without one it "
            "belongs to the layer around it."};

/// What a material made of several is for secondary rays: those that have been scattered by a
/// surface that is not a mirror or clear glass, or by a medium.
enum class SecondaryRays { full, base };
constexpr auto choices(SecondaryRays) { return std::array<std::string_view, 2>{"full", "base"}; }

struct Layer {
    static constexpr schema::TypeInfo info{
        .category = "layer",
        .type = "",
        .help = "One layer of a `layered` bsdf: dirt, paint, rust, and where it is."};
    MaterialId bsdf;
    Input<float> opacity{1};
    Input<Vec3> normal{Vec3(0, 0, 0)};
    std::string label;

    template <class F>
    constexpr void describe(F&& f) {
        f("bsdf", bsdf, {.required = true, .help = "What the layer is made of."});
        f("opacity", opacity,
          {.min = 0, .max = 1, .help = "Where the layer is: a mask; 0 is a hole in it."});
        f("normal", normal,
          {.help = "Shading normal of this layer, from a `normalmap` or `bump` node; the mask may "
                   "feed that, so that paint has an edge."});
        f("label", label, kLabelAttr);
    }
};

struct Layered {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "layered",
        .help = "Layers that cover each other by their masks, listed from the outside in: dirt, "
                "black paint, red paint, metal. The last one should cover everything.",
        .example = "<bsdf type=\"layered\">\n"
                   "  <layer><bsdf type=\"disney\" baseColor=\"0.02\"/>\n"
                   "    <texture name=\"opacity\" type=\"image\" filename=\"mask.png\" "
                   "linear=\"true\"/></layer>\n"
                   "  <layer><bsdf type=\"disney\" metallic=\"1\" roughness=\"0.2\"/></layer>\n"
                   "</bsdf>"};
    std::vector<LayerId> layers;
    SecondaryRays secondary = SecondaryRays::full;

    template <class F>
    constexpr void describe(F&& f) {
        f("layer", layers, {.help = "The layers, the outermost first."});
        f("secondary", secondary,
          {.help = "For light that was scattered before: all layers, or the last one alone."});
    }
};
template <>
struct MaterialTraits<Layered>
    : IsSurface, SoftensBentLight, IsOpaque, IsWholeAndDark, IsIsotropic {
    static constexpr PartCount part_count{1, INT_MAX};
    static std::vector<MaterialId> parts(Layered const& m, std::vector<Layer> const& layers) {
        std::vector<MaterialId> all;
        for (LayerId id : m.layers) all.push_back(layers[size_t(id.index)].bsdf);
        return all;
    }
    static std::vector<std::string> labels(Layered const& m, std::vector<Layer> const& layers) {
        std::vector<std::string> all;
        for (LayerId id : m.layers) all.push_back(layers[size_t(id.index)].label);
        return all;
    }
};

namespace dialects {
inline constexpr std::array kCoats{
    Spelling{.type = "principled_clearcoat",
             .today = "is a <bsdf type=\"coat\"> over a `principled` one today, and its strength "
                      "counts a quarter, as Burley's does",
             .rewrite = coat_over_principled},
};
} // namespace dialects

struct Coat {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "coat",
        .help = "A clear layer over any material: varnish, lacquer, water, ice. It reflects, and "
                "dims and tints what lies below.",
        .example = "<bsdf type=\"coat\" thickness=\"0.5\" tint=\"0.9,0.6,0.3\">\n"
                   "  <bsdf type=\"disney\" metallic=\"1\"/></bsdf>",
        .spellings = dialects::kCoats};
    MaterialId bsdf;
    Input<float> weight{1};
    Input<float> roughness{0.05f};
    Input<float> ior{1.5f};
    Input<float> thickness{1};
    Input<Color> tint{Color(1)};
    Input<Vec3> normal{Vec3(0, 0, 0)};
    std::string label;
    SecondaryRays secondary = SecondaryRays::full;

    template <class F>
    constexpr void describe(F&& f) {
        f("bsdf", bsdf, {.required = true, .help = "What lies below."});
        f("weight", weight, {.min = 0, .max = 1, .help = "Where the coat is: a mask."});
        f("roughness", roughness, {.min = 0, .max = 1, .help = "0 is polished, 1 is dull."});
        f("ior", ior,
          {.min = 1, .max = 4, .help = "Index of refraction: water 1.33, varnish 1.5."});
        f("thickness", thickness,
          {.min = 0, .soft_max = 10, .help = "How often light goes through what `tint` says."});
        f("tint", tint,
          {.min = 0,
           .max = 1,
           .help = "What a layer of thickness 1 lets through, in and out along the normal; flatter "
                   "rays go a longer way."});
        f("normal", normal, {.help = "Shading normal of the coat alone."});
        f("label", label,
          {.help = "Name of the coat's own reflection for the AOV `layers`, as of a `layer`."});
        f("secondary", secondary,
          {.help = "For light that was scattered before: all of it, or what lies below alone."});
    }
};
template <>
struct MaterialTraits<Coat> : IsSurface, SoftensBentLight, IsOpaque, IsWholeAndDark, IsIsotropic {
    static constexpr PartCount part_count{1, 1};
    static std::vector<MaterialId> parts(Coat const& m, std::vector<Layer> const&) {
        return {m.bsdf};
    }
    /// Of the coat's own reflection.
    static std::vector<std::string> labels(Coat const& m, std::vector<Layer> const&) {
        return {m.label};
    }
};

struct Mix {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "mix",
        .help = "Two materials side by side, finer than can be seen.",
        .example = "<bsdf type=\"mix\" amount=\"0.3\">\n"
                   "  <bsdf type=\"diffuse\"/><bsdf type=\"conductor\"/></bsdf>"};
    std::vector<MaterialId> bsdfs;
    Input<float> amount{0.5f};
    std::string label0, label1;
    SecondaryRays secondary = SecondaryRays::full;

    template <class F>
    constexpr void describe(F&& f) {
        f("bsdf", bsdfs, {.help = "The two materials."});
        f("amount", amount, {.min = 0, .max = 1, .help = "Share of the second one: a mask."});
        f("label0", label0,
          {.help = "Name of the first one for the AOV `layers`, as of a `layer`."});
        f("label1", label1, {.help = "Likewise of the second one."});
        f("secondary", secondary,
          {.help = "For light that was scattered before: both, or the first one alone."});
    }
};
template <>
struct MaterialTraits<Mix> : IsSurface, SoftensBentLight, IsOpaque, IsWholeAndDark, IsIsotropic {
    static constexpr PartCount part_count{2, 2};
    static std::vector<MaterialId> parts(Mix const& m, std::vector<Layer> const&) {
        return m.bsdfs;
    }
    static std::vector<std::string> labels(Mix const& m, std::vector<Layer> const&) {
        return {m.label0, m.label1};
    }
};

struct Secondary {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "secondary",
        .help = "A material and a simpler one that stands in for it where light was scattered "
                "before, by a surface that is neither mirror nor clear glass, or by a medium. It "
                "saves time and is wrong by what the two differ: compare a render with "
                "`fullMaterials`.",
        .example =
            "<bsdf type=\"secondary\">\n"
            "  <ref id=\"carpaint\"/><bsdf type=\"diffuse\" albedo=\"0.5,0.05,0.03\"/></bsdf>"};
    std::vector<MaterialId> bsdfs;

    template <class F>
    constexpr void describe(F&& f) {
        f("bsdf", bsdfs, {.help = "What the camera sees, and what stands in for it."});
    }
};
template <>
struct MaterialTraits<Secondary>
    : IsSurface, SoftensBentLight, IsOpaque, IsWholeAndDark, IsIsotropic {
    static constexpr PartCount part_count{2, 2};
    static std::vector<MaterialId> parts(Secondary const& m, std::vector<Layer> const&) {
        return m.bsdfs;
    }
    static std::vector<std::string> labels(Secondary const&, std::vector<Layer> const&) {
        return {};
    }
};

} // namespace weft::scene
