// The principled material: one surface description whose parameters are those of Blender's
// Principled BSDF, after Burley 2012, "Physically-Based Shading at Disney", and 2015, "Extending
// the Disney BRDF to a BSDF with Integrated Subsurface Scattering".
#pragma once

#include "scene/dialects.h"
#include "scene/material_traits.h"
#include "schema/describe.h"

namespace weft::scene {

namespace dialects {
inline constexpr std::string_view kTintToday =
    "is a colour today: an amount of the base colour's hue (Burley 2012) becomes one";
inline constexpr std::array kDisney{
    Spelling{.parameter = "specularTint", .today = kTintToday, .rewrite = specular_tint},
    Spelling{.parameter = "sheenTint", .today = kTintToday, .rewrite = sheen_tint},
    Spelling{.parameter = "clearcoatGloss",
             .today = "is `clearcoatRoughness` today, the root of Burley's 0.1 (1 - gloss) + 0.001 "
                      "gloss, and a `clearcoat` beside it counts a quarter, as his does",
             .rewrite = coat_by_gloss},
};
} // namespace dialects

struct Disney {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "disney",
        .help = "Almost any surface by what it is made of: a base that is matte, metal or glass, "
                "with sheen (fabric) and a clear coat on top. The same parameters as Blender's "
                "Principled BSDF. `weft help materials` has values by what things feel like.",
        .example = "<!-- lacquer; gold; velvet; bottle glass -->\n"
                   "<bsdf type=\"disney\" baseColor=\"0.8,0.1,0.05\" roughness=\"0.35\" "
                   "clearcoat=\"1\"/>\n"
                   "<bsdf type=\"disney\" baseColor=\"0.97,0.73,0.36\" metallic=\"1\" "
                   "roughness=\"0.15\"/>\n"
                   "<bsdf type=\"disney\" baseColor=\"0.05,0.01,0.05\" roughness=\"1\" sheen=\"1\" "
                   "sheenTint=\"0.8,0.3,0.8\"/>\n"
                   "<bsdf type=\"disney\" baseColor=\"0.6,0.9,0.7\" roughness=\"0\" "
                   "transmission=\"1\"/>",
        .spellings = dialects::kDisney};
    Input<Color> base_color{Color(0.8f)};
    Input<float> metallic{0};
    Input<float> roughness{0.5f};
    Input<float> ior{1.5f};
    Input<float> specular{0.5f};
    Input<Color> specular_tint{Color(1)};
    Input<float> anisotropic{0};
    Input<float> anisotropic_rotation{0};
    Input<float> sheen{0};
    Input<float> sheen_roughness{0.5f};
    Input<Color> sheen_tint{Color(1)};
    Input<float> clearcoat{0};
    Input<float> clearcoat_roughness{0.03f};
    Input<float> clearcoat_ior{1.5f};
    Input<Color> clearcoat_tint{Color(1)};
    Input<float> transmission{0};
    Input<float> transmission_roughness{-1};
    bool thin_walled = false;
    Input<float> subsurface{0};
    Input<Color> subsurface_radius{Color(1, 0.2f, 0.1f)};
    Input<float> subsurface_scale{0.05f};
    Input<float> thin_film_thickness{0};
    Input<float> thin_film_ior{1.33f};
    Input<Color> emission_color{Color(1)};
    Input<float> emission_strength{0};
    Input<float> opacity{1};
    Input<Vec3> normal{Vec3(0, 0, 0)};
    Input<Vec3> clearcoat_normal{Vec3(0, 0, 0)};

    template <class F>
    constexpr void describe(F&& f) {
        f("baseColor", base_color,
          {.min = 0,
           .max = 1,
           .help = "Colour of the matte part; of a metal's reflection; of what glass lets through."
                   " Soot 0.04, wood 0.3, skin 0.5, snow 0.9; metals 0.5 and more, gold "
                   "0.97,0.73,0.36."});
        f("metallic", metallic,
          {.min = 0,
           .max = 1,
           .help = "0 is anything but metal, 1 is metal; between: dusty or worn."});
        f("roughness", roughness,
          {.min = 0,
           .max = 1,
           .help = "0 is polished, 1 is dull: highlights, reflections and refractions alike. Water "
                   "0, varnish 0.1, satin 0.4, paper 0.8; alpha = max(roughness^2, 0.001)."});
        f("ior", ior,
          {.min = 1,
           .max = 100,
           .soft_max = 3,
           .help =
               "Index of refraction of what is not metal; higher reflects more, and bends light "
               "more where it goes through: water 1.33, skin 1.4, plastic and glass 1.5, "
               "diamond 2.4.",
           .aliases = {"eta"}});
        f("specular", specular,
          {.min = 0,
           .max = 1,
           .help = "Strength of the reflection at normal incidence: 0.5 is what `ior` says, 0 is "
                   "none, 1 is twice. Less for what is full of pores: cloth 0.2, clay 0.25.",
           .aliases = {"specularLevel"}});
        f("specularTint", specular_tint,
          {.min = 0,
           .max = 1,
           .help = "Colour of the reflection: at normal incidence where it is not metal, at the "
                   "silhouette where it is. White is physical."});
        f("anisotropic", anisotropic,
          {.min = 0,
           .max = 1,
           .help = "How much highlights stretch along the tangent: brushed metal 0.7, satin 0.5; "
                   "aspect = sqrt(1 - 0.9 anisotropic)."});
        f("anisotropicRotation", anisotropic_rotation,
          {.unit = "turn",
           .min = 0,
           .max = 1,
           .help =
               "Turns the direction of the stretch; it lies across the scratches, so that 0.25 is "
               "for a surface brushed along u."});
        f("sheen", sheen,
          {.min = 0,
           .max = 1,
           .help = "Fuzz of tiny fibres, seen at the silhouette: cotton 0.2, wool 0.5, velvet 1."});
        f("sheenRoughness", sheen_roughness,
          {.min = 0, .max = 1, .help = "0 is a thin rim (satin), 1 is an even haze (dust)."});
        f("sheenTint", sheen_tint, {.min = 0, .max = 1, .help = "Colour of the fuzz."});
        f("clearcoat", clearcoat,
          {.min = 0, .max = 1, .help = "A clear, glossy layer on top: car paint, varnish 1."});
        f("clearcoatRoughness", clearcoat_roughness,
          {.min = 0, .max = 1, .help = "Roughness of that layer: new lacquer 0.03, worn 0.2."});
        f("clearcoatIor", clearcoat_ior,
          {.min = 1,
           .max = 3,
           .help = "Index of refraction of that layer: water 1.33, lacquer 1.5."});
        f("clearcoatTint", clearcoat_tint,
          {.min = 0,
           .max = 1,
           .help = "What the layer lets through, along the normal: amber varnish 1,0.8,0.5."});
        f("transmission", transmission,
          {.min = 0,
           .max = 1,
           .help = "0 is opaque, 1 is glass or liquid.",
           .aliases = {"specularTrans", "specTrans"}});
        f("transmissionRoughness", transmission_roughness,
          {.min = -1,
           .max = 1,
           .help = "Roughness of what is seen through the surface; below 0: the same as "
                   "`roughness`, as in nature."});
        f("thinWalled", thin_walled,
          {.help =
               "A sheet without an inside, such as a window pane, a bubble or a leaf: light goes "
               "through without a bend, half of what is `subsurface` leaves on the other side, "
               "and the mesh need not be closed."});
        f("subsurface", subsurface,
          {.min = 0,
           .max = 1,
           .help = "How much of the matte part is light from below: skin, wax, milk 1. It comes "
                   "out where it went in, whatever the two parameters below say; light controls "
                   "and AOVs tell it from diffuse reflection."});
        f("subsurfaceRadius", subsurface_radius,
          {.min = 0, .help = "How far light travels below the surface, by colour, as a factor."});
        f("subsurfaceScale", subsurface_scale,
          {.unit = "scene",
           .min = 0,
           .help =
               "The length that `subsurfaceRadius` is a factor of: in metres skin 0.005, marble "
               "0.0085, wax 0.006."});
        f("thinFilmThickness", thin_film_thickness,
          {.unit = "nm",
           .min = 0,
           .soft_max = 2000,
           .help = "A film on the surface whose colours are those of soap or oil; 0 is none, 250 "
                   "to 600 is the most colourful."});
        f("thinFilmIor", thin_film_ior,
          {.min = 1, .max = 4, .help = "Index of refraction of the film: soap 1.33, oil 1.47."});
        f("emissionColor", emission_color, {.min = 0, .help = "Colour of the light it emits."});
        f("emissionStrength", emission_strength,
          {.unit = "W/(m^2 sr)", .min = 0, .help = "Radiance per unit of `emissionColor`."});
        f("opacity", opacity, {.min = 0, .max = 1, .help = "0 is not there at all."});
        f("normal", normal, {.help = "Shading normal, from a `normalmap` or `bump` node."});
        f("clearcoatNormal", clearcoat_normal, {.help = "Shading normal of the clear coat alone."});
    }
};

template <>
struct MaterialTraits<Disney> : IsSurface, SoftensBentLight, HasNoParts {
    static bool transmits(Disney const& m) { return may_differ(m.transmission, 0.f); }
    static std::optional<Input<float>> inner_ior(Disney const& m) {
        return transmits(m) && !m.thin_walled ? std::optional(m.ior) : std::nullopt;
    }
    static bool passes_straight(Disney const& m) { return transmits(m) && m.thin_walled; }
    static Input<float> opacity(Disney const& m) { return m.opacity; }
    static std::optional<MaterialEmission> emission(Disney const& m) {
        if (!m.emission_strength.texture && !(m.emission_strength.value > 0)) return {};
        return MaterialEmission{m.emission_color, m.emission_strength};
    }
    static bool needs_tangents(Disney const& m) { return may_differ(m.anisotropic, 0.f); }
};

} // namespace weft::scene
