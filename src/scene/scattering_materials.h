// Materials that are one kind of scattering each, for those who build surfaces lobe by lobe.
#pragma once

#include <array>
#include <string_view>

#include "scene/material_traits.h"
#include "schema/describe.h"

namespace weft::scene {

enum class MicrofacetDistribution { beckmann, ggx, ashikhminShirley };
constexpr auto choices(MicrofacetDistribution) {
    return std::array<std::string_view, 3>{"beckmann", "ggx", "ashikhminShirley"};
}

/// How the shadowing of the two directions goes together: lobes/microfacet.h.
enum class Shadowing { separable, correlated };
constexpr auto choices(Shadowing) {
    return std::array<std::string_view, 2>{"separable", "correlated"};
}

/// `none`: a dielectric; `artist`: a conductor by `reflectance` and `edgeTint`.
enum class Metal { none, gold, silver, copper, aluminium, iron, chrome, brass, artist, complex };
constexpr auto choices(Metal) {
    return std::array<std::string_view, 10>{"none", "gold",   "silver", "copper", "aluminium",
                                            "iron", "chrome", "brass",  "artist", "complex"};
}

struct Microfacet {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "microfacet",
        .help =
            "A surface of microscopic facets, metal or glass (Walter et al. 2007). One roughness "
            "drives highlights, reflections and refractions alike.",
        .example = "<bsdf type=\"microfacet\" metal=\"gold\" roughness=\"0.2\"/>"};
    MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
    Shadowing shadowing = Shadowing::separable;
    Metal metal = Metal::none;
    Input<float> roughness{0.3f};
    Input<float> anisotropic{0};
    Input<float> anisotropic_rotation{0};
    Input<Color> reflectance{Color(1)};
    Input<Color> edge_tint{Color(1)};
    Input<Color> transmittance{Color(1)};
    Input<float> ior{1.5f};
    Input<float> reflection_ior{0};
    Input<Color> complex_ior{Color(0.2f, 0.9f, 1.1f)};
    Input<Color> extinction{Color(3.9f, 2.4f, 2.2f)};
    Input<float> thin_film_thickness{0};
    Input<float> thin_film_ior{1.33f};
    bool thin_walled = false;
    Input<Vec3> normal{Vec3(0, 0, 0)};

    template <class F>
    constexpr void describe(F&& f) {
        f("distribution", distribution,
          {.help =
               "Distribution of the facets' normals: `beckmann` is that of a random height "
               "field, `ggx` has long tails around highlights, `ashikhminShirley` is Phong's."});
        f("shadowing", shadowing,
          {.help = "How facets hide each other from light and view: `separable` is Walter's, as if "
                   "the two were independent; `correlated` by heights (Heitz 2014), as `disney`, "
                   "and a little brighter at grazing angles."});
        f("metal", metal,
          {.help =
               "A measured metal; `artist`: one by `reflectance` and `edgeTint`; `complex`: one "
               "by `complexIor` and `extinction`; `none`: glass, by `ior`."});
        f("roughness", roughness,
          {.min = 0,
           .max = 1,
           .help = "0 is polished, 1 is dull; alpha = max(roughness^2, 0.001)."});
        f("anisotropic", anisotropic,
          {.min = 0, .max = 1, .help = "How much highlights stretch along the tangent."});
        f("anisotropicRotation", anisotropic_rotation,
          {.unit = "turn", .min = 0, .max = 1, .help = "Turns the direction of the stretch."});
        f("reflectance", reflectance,
          {.min = 0,
           .max = 1,
           .help = "A factor on what is reflected; of an `artist` metal the colour seen head-on."});
        f("edgeTint", edge_tint,
          {.min = 0,
           .max = 1,
           .help =
               "Of an `artist` metal (Gulbrandsen 2014): 0 turns white late towards the edge, 1 "
               "early."});
        f("transmittance", transmittance,
          {.min = 0, .max = 1, .help = "A factor on what is refracted; 0 is an opaque coating."});
        f("ior", ior,
          {.min = 1e-3, .max = 1000, .soft_max = 3, .help = "Index of refraction of the inside."});
        f("reflectionIor", reflection_ior,
          {.min = 0,
           .max = 1000,
           .soft_max = 3,
           .help = "Another index for the reflection alone, as eyes in films have; 0: the same."});
        f("complexIor", complex_ior,
          {.min = 1e-3, .help = "Real part of a `complex` metal's index, by colour."});
        f("extinction", extinction,
          {.min = 0, .help = "Imaginary part of a `complex` metal's index, by colour."});
        f("thinFilmThickness", thin_film_thickness,
          {.unit = "nm", .min = 0, .soft_max = 2000, .help = "A film with interference colours."});
        f("thinFilmIor", thin_film_ior, {.min = 1, .max = 4, .help = "Index of that film."});
        f("thinWalled", thin_walled,
          {.help = "Makes glass a sheet without an inside, such as a window pane or a bubble: "
                   "light goes on "
                   "without a bend, and the mesh need not be closed."});
        f("normal", normal, {.help = "Shading normal, from a `normalmap` or `bump` node."});
    }
};
template <>
struct MaterialTraits<Microfacet> : IsSurface, SoftensBentLight, IsWholeAndDark, HasNoParts {
    static bool transmits(Microfacet const& m) {
        return m.metal == Metal::none && may_differ(m.transmittance, Color(0));
    }
    static std::optional<Input<float>> inner_ior(Microfacet const& m) {
        return transmits(m) && !m.thin_walled ? std::optional(m.ior) : std::nullopt;
    }
    static bool passes_straight(Microfacet const& m) { return transmits(m) && m.thin_walled; }
    static bool needs_tangents(Microfacet const& m) { return may_differ(m.anisotropic, 0.f); }
};

struct Translucent {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "translucent",
        .help =
            "Matte on both sides of a thin sheet: leaves, paper, lampshades. Where both colours "
            "together pass 1 they are scaled down."};
    Input<Color> reflectance{Color(0.4f)};
    Input<Color> transmittance{Color(0.4f)};

    template <class F>
    constexpr void describe(F&& f) {
        f("reflectance", reflectance,
          {.min = 0, .max = 1, .help = "Fraction of light that stays on its side."});
        f("transmittance", transmittance,
          {.min = 0, .max = 1, .help = "Fraction of light that comes out of the other side."});
    }
};
template <>
struct MaterialTraits<Translucent>
    : IsSurface, SoftensBentLight, IsOpaque, IsWholeAndDark, IsIsotropic, HasNoParts {};

struct Transparent {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "transparent",
        .help =
            "Lets light straight through, tinted: gels, film, stained glass without refraction."};
    Input<Color> transmittance{Color(1)};

    template <class F>
    constexpr void describe(F&& f) {
        f("transmittance", transmittance,
          {.min = 0, .max = 1, .help = "Fraction of light that goes through."});
    }
};
template <>
struct MaterialTraits<Transparent>
    : IsSurface, SoftensBentLight, IsWholeAndDark, IsIsotropic, HasNoParts {
    static std::optional<Input<float>> inner_ior(Transparent const&) { return {}; }
    static bool passes_straight(Transparent const& m) {
        return may_differ(m.transmittance, Color(0));
    }
};

/// How `Hair` says what colour it has.
enum class HairColor { melanin, color };
constexpr auto choices(HairColor) { return std::array<std::string_view, 2>{"melanin", "color"}; }

struct Hair {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "hair",
        .help = "A hair or fibre (Chiang et al. 2016). On surfaces v runs across the fibre and u "
                "along it, so that a strip of polygons is one.",
        .example = "<bsdf type=\"hair\" eumelanin=\"1.3\" roughness=\"0.25\"/>"};
    HairColor coloring = HairColor::melanin;
    Input<float> eumelanin{1.3f};
    Input<float> pheomelanin{0};
    Input<Color> color{Color(0.4f, 0.25f, 0.15f)};
    Input<float> roughness{0.3f};
    Input<float> radial_roughness{0.3f};
    Input<float> ior{1.55f};
    Input<float> scale_angle{2};

    template <class F>
    constexpr void describe(F&& f) {
        f("coloring", coloring, {.help = "By pigments, or by the colour of a thick mass of it."});
        f("eumelanin", eumelanin,
          {.min = 0,
           .soft_max = 8,
           .help = "Black and brown pigment: blond 0.3, brown 1.3, black 8."});
        f("pheomelanin", pheomelanin,
          {.min = 0, .soft_max = 8, .help = "Red pigment: blond 0, red 1 to 3."});
        f("color", color, {.min = 0, .max = 1, .help = "Colour, where `coloring` is `color`."});
        f("roughness", roughness,
          {.min = 0, .max = 1, .help = "Along the fibre: how long the highlights are."});
        f("radialRoughness", radial_roughness,
          {.min = 0, .max = 1, .help = "Around the fibre: how even it looks."});
        f("ior", ior, {.min = 1, .max = 3, .help = "Index of refraction: hair 1.55, nylon 1.53."});
        f("scaleAngle", scale_angle,
          {.unit = "deg", .min = -45, .max = 45, .help = "Tilt of the scales, towards the root."});
    }
};
template <>
struct MaterialTraits<Hair> : IsSurface, SoftensBentLight, IsOpaque, IsWholeAndDark, HasNoParts {
    static bool needs_tangents(Hair const&) { return true; }
};

} // namespace weft::scene
