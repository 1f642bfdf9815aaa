// Surface materials, emission, and the media that fill closed shapes.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "base/match.h"
#include "scene/dialects.h"
#include "scene/disney.h"
#include "scene/handles.h"
#include "scene/layered_materials.h"
#include "scene/light_color.h"
#include "scene/scattering_materials.h"
#include "schema/describe.h"

namespace weft::scene {

struct Diffuse {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "diffuse",
        .help =
            "A matte surface, the same from both sides: Lambert's ideal one, or rough like clay "
            "and plaster (Portsmouth et al. 2024)."};
    Input<Color> albedo{Color(0.8f)};
    Input<float> roughness{0};

    template <class F>
    constexpr void describe(F&& f) {
        f("albedo", albedo, {.min = 0, .max = 1, .help = "Fraction of light that is reflected."});
        f("roughness", roughness,
          {.min = 0,
           .max = 1,
           .help = "0 is Lambert's; 1 is dusty: flat like the full moon, as bright at its edge."});
    }
};
template <>
struct MaterialTraits<Diffuse>
    : IsSurface, DropsBentLight, IsOpaque, IsWholeAndDark, IsIsotropic, HasNoParts {};

struct Conductor {
    static constexpr schema::TypeInfo info{
        .category = "bsdf", .type = "conductor", .help = "A perfect mirror."};
    Input<Color> reflectance{Color(1)};

    template <class F>
    constexpr void describe(F&& f) {
        f("reflectance", reflectance,
          {.min = 0, .max = 1, .help = "Fraction of light that is reflected."});
    }
};
template <>
struct MaterialTraits<Conductor>
    : IsSurface, DropsBentLight, IsOpaque, IsWholeAndDark, IsIsotropic, HasNoParts {};

enum class Microfacets { ggx, beckmann };
constexpr auto choices(Microfacets) { return std::array<std::string_view, 2>{"ggx", "beckmann"}; }

struct RoughConductor {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "roughconductor",
        .help =
            "A mirror of microscopic facets: brushed or cast metal. As in course scenes: separable "
            "shadowing (Walter et al. 2007), and light that meets several facets is lost."};
    Input<Color> reflectance{Color(1)};
    Input<float> roughness{0.5f};
    Microfacets distribution = Microfacets::ggx;

    template <class F>
    constexpr void describe(F&& f) {
        f("reflectance", reflectance,
          {.min = 0, .max = 1, .help = "Fraction of light that a facet reflects."});
        f("roughness", roughness,
          {.min = 0,
           .max = 1,
           .help = "0 is a mirror, 1 is dull; alpha = max(roughness^2, 0.001)."});
        f("distribution", distribution, {.help = "Distribution of the facets' normals."});
    }
};
template <>
struct MaterialTraits<RoughConductor>
    : IsSurface, DropsBentLight, IsOpaque, IsWholeAndDark, IsIsotropic, HasNoParts {};

struct Dielectric {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "dielectric",
        .help = "A smooth boundary such as glass or water: it reflects and refracts."};
    Input<float> ior{1.5f};
    Input<Color> reflectance{Color(1)};
    Input<Color> transmittance{Color(1)};
    bool thin_walled = false;

    template <class F>
    constexpr void describe(F&& f) {
        f("ior", ior,
          {.min = 1e-3,
           .max = 1000,
           .soft_max = 3,
           .help = "Index of refraction of the inside: water 1.33, glass 1.5, diamond 2.4."});
        f("reflectance", reflectance,
          {.min = 0, .max = 1, .help = "A factor on what is reflected."});
        f("transmittance", transmittance,
          {.min = 0, .max = 1, .help = "A factor on what is refracted."});
        f("thinWalled", thin_walled,
          {.help = "A sheet without an inside, such as a window pane or a bubble: light goes on "
                   "without a bend, and the mesh need not be closed."});
    }
};
template <>
struct MaterialTraits<Dielectric>
    : IsSurface, DropsBentLight, IsWholeAndDark, IsIsotropic, HasNoParts {
    static std::optional<Input<float>> inner_ior(Dielectric const& m) {
        return m.thin_walled ? std::nullopt : std::optional(m.ior);
    }
    static bool passes_straight(Dielectric const& m) { return m.thin_walled; }
};

namespace dialects {
inline constexpr std::string_view kDisneyToday = "is a parameter of <bsdf type=\"disney\"> today";
inline constexpr std::array kPrincipled{
    Spelling{.parameter = "transmission", .today = kDisneyToday, .rewrite = principled_as_disney},
    Spelling{.parameter = "specularLevel", .today = kDisneyToday, .rewrite = principled_as_disney},
    Spelling{.parameter = "ior", .today = kDisneyToday, .rewrite = principled_as_disney},
};
} // namespace dialects

struct RoughDielectric {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "roughdielectric",
        .help =
            "A boundary of microscopic facets: frosted glass, ice (Walter et al. 2007, with its "
            "separable shadowing). Light that meets several facets is lost."};
    Input<float> ior{1.5f};
    Input<Color> reflectance{Color(1)};
    Input<Color> transmittance{Color(1)};
    Input<float> roughness{0.5f};
    Microfacets distribution = Microfacets::ggx;
    bool thin_walled = false;

    template <class F>
    constexpr void describe(F&& f) {
        f("ior", ior,
          {.min = 1e-3, .max = 1000, .soft_max = 3, .help = "Index of refraction of the inside."});
        f("reflectance", reflectance,
          {.min = 0, .max = 1, .help = "A factor on what is reflected."});
        f("transmittance", transmittance,
          {.min = 0, .max = 1, .help = "A factor on what is refracted."});
        f("roughness", roughness,
          {.min = 0, .max = 1, .help = "0 is smooth, 1 is dull; alpha = max(roughness^2, 0.001)."});
        f("distribution", distribution, {.help = "Distribution of the facets' normals."});
        f("thinWalled", thin_walled,
          {.help = "A sheet without an inside, such as frosted paper or a lampshade: light is "
                   "spread but not bent, and none is lost. The mesh need not be closed."});
    }
};
template <>
struct MaterialTraits<RoughDielectric>
    : IsSurface, DropsBentLight, IsWholeAndDark, IsIsotropic, HasNoParts {
    static std::optional<Input<float>> inner_ior(RoughDielectric const& m) {
        return m.thin_walled ? std::nullopt : std::optional(m.ior);
    }
    static bool passes_straight(RoughDielectric const&) { return false; }
};

struct Principled {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "principled",
        .help =
            "Four parameters from plastic to metal: a Lambert lobe under a GGX lobe of separable "
            "shadowing, whose Fresnel term divides the light between them.",
        .spellings = dialects::kPrincipled};
    Input<Color> base_color{Color(0.8f)};
    Input<float> roughness{0.5f};
    Input<float> metallic{0};
    Input<float> specular{0.5f};

    template <class F>
    constexpr void describe(F&& f) {
        f("baseColor", base_color,
          {.min = 0, .max = 1, .help = "Colour of the matte part, and of the metal's reflection."});
        f("roughness", roughness,
          {.min = 0,
           .max = 1,
           .help = "0 is a mirror, 1 is dull; alpha = max(roughness^2, 0.001)."});
        f("metallic", metallic,
          {.min = 0, .max = 1, .help = "0 is plastic, wood, stone; 1 is metal."});
        f("specular", specular,
          {.min = 0,
           .max = 1,
           .help = "Strength of the uncoloured reflection: F = specular * Schlick(0.08 (1 - "
                   "metallic))."});
    }
};
template <>
struct MaterialTraits<Principled>
    : IsSurface, DropsBentLight, IsOpaque, IsWholeAndDark, IsIsotropic, HasNoParts {};

namespace dialects {
inline constexpr std::array kVolumes{
    Spelling{.type = "hg",
             .today = "is <bsdf type=\"volume\"> today, with scatter = albedo and absorption = 1 - "
                      "albedo",
             .rewrite = scattering_by_albedo},
    Spelling{.type = "volumebsdf",
             .today = "is <bsdf type=\"volume\"> today, with scatter = albedo and absorption = 1 - "
                      "albedo",
             .rewrite = scattering_by_albedo},
    Spelling{.parameter = "absorption",
             .today =
                 "is the absorption coefficient, beside `scatter`, which is 1 where nothing is "
                 "said; some teams of lightwave scale what is scattered by it, for which "
                 "`baseColor` is the parameter here",
             .rewrite = scatter_is_one},
};
} // namespace dialects

struct VolumeBoundary {
    static constexpr schema::TypeInfo info{
        .category = "bsdf",
        .type = "volume",
        .help = "No surface at all: the shape bounds a medium (smoke, fog, milk). Its density is "
                "the instance's `<volume>`, 1 where there is none.",
        .spellings = dialects::kVolumes};
    Color absorption{0};
    Color scatter{1};
    float phase = 0;
    Color base_color{1};

    template <class F>
    constexpr void describe(F&& f) {
        f("absorption", absorption,
          {.unit = "1/scene", .min = 0, .help = "Absorption coefficient at density 1."});
        f("scatter", scatter,
          {.unit = "1/scene", .min = 0, .help = "Scattering coefficient at density 1."});
        f("phase", phase,
          {.min = -0.999,
           .max = 0.999,
           .help = "Henyey-Greenstein g: -1 backwards, 0 evenly, 1 forwards.",
           .aliases = {"g"}});
        f("baseColor", base_color,
          {.min = 0,
           .max = 1,
           .help = "Fraction of scattered light that is not absorbed, by colour.",
           .aliases = {"color"}});
    }
};
template <>
struct MaterialTraits<VolumeBoundary>
    : DropsBentLight, IsOpaque, IsWholeAndDark, IsIsotropic, HasNoParts {
    static constexpr bool is_null_boundary = true;
    static constexpr bool can_be_part = false;
};

using Material = std::variant<Diffuse, Conductor, RoughConductor, Dielectric, RoughDielectric,
                              Principled, Disney, Microfacet, Translucent, Transparent, Hair,
                              Layered, Coat, Mix, Secondary, VolumeBoundary>;

/// Calls f.operator()<Traits>(m) with the traits of the alternative that `material` holds.
template <class F>
decltype(auto) with_traits(Material const& material, F&& f) {
    return match(material, [&]<KnownMaterial M>(M const& m) -> decltype(auto) {
        return f.template operator()<MaterialTraits<M>>(m);
    });
}

/// Returns whether the material has no surface of its own: rays pass straight on.
inline bool is_null_boundary(Material const& material) {
    return with_traits(material, []<class T>(auto const&) -> bool { return T::is_null_boundary; });
}
/// Returns whether other materials can be made of it.
inline bool can_be_part(Material const& material) {
    return with_traits(material, []<class T>(auto const&) -> bool { return T::can_be_part; });
}
/// How much of a material by itself is there, 0 to 1.
inline Input<float> opacity_of(Material const& material) {
    return with_traits(material, []<class T>(auto const& m) { return T::opacity(m); });
}
/// Returns what a material by itself emits, if it may.
inline std::optional<MaterialEmission> emission_of(Material const& material) {
    return with_traits(material, []<class T>(auto const& m) { return T::emission(m); });
}
/// Returns whether it looks at the direction in which u grows, its parts aside.
inline bool needs_tangents(Material const& material) {
    return with_traits(material, []<class T>(auto const& m) { return T::needs_tangents(m); });
}

struct LambertianEmission {
    static constexpr schema::TypeInfo info{
        .category = "emission",
        .type = "lambertian",
        .help = "Emits the same radiance in all directions, from the front side only."};
    Input<Color> emission{Color(1)};
    LightUnit unit = LightUnit::radiometric;
    LightColor color;

    template <class F>
    constexpr void describe(F&& f) {
        f("emission", emission, {.unit = "W/(m^2 sr)", .min = 0, .help = "Radiance."});
        f("unit", unit, kLightUnitAttr);
        f.group(color);
    }
};

struct ConstantVolume {
    static constexpr schema::TypeInfo info{
        .category = "volume", .type = "constant", .help = "The same density everywhere."};
    float value = 1;

    template <class F>
    constexpr void describe(F&& f) {
        f("value", value, {.min = 0, .help = "Factor on the coefficients of the `volume` bsdf."});
    }
};

namespace dialects {
inline constexpr std::string_view kExtinctionToday =
    "and `color` are `absorption` and `scatter` today: light meets the medium sigmaT times per "
    "unit "
    "of length, and goes on by the colour. The team that says so also divides what is scattered by "
    "pi";
inline constexpr std::array kMedia{
    Spelling{.parameter = "sigmaT", .today = kExtinctionToday, .rewrite = medium_by_albedo},
    Spelling{.parameter = "sigma_t", .today = kExtinctionToday, .rewrite = medium_by_albedo},
    Spelling{.parameter = "density", .today = kExtinctionToday, .rewrite = medium_by_albedo},
};
} // namespace dialects

struct HomogeneousMedium {
    static constexpr schema::TypeInfo info{
        .category = "medium",
        .type = "homogeneous",
        .help = "What fills a closed shape (inside an `instance`), or all space that no shape "
                "fills (inside a `scene`): coloured glass, milk, fog.",
        .example = "<instance><shape type=\"sphere\"/><bsdf type=\"dielectric\"/>\n"
                   "  <medium type=\"homogeneous\" absorption=\"2,0.5,0.1\"/></instance>",
        .spellings = dialects::kMedia};
    Color absorption{0};
    Color scatter{0};
    float phase = 0;

    template <class F>
    constexpr void describe(F&& f) {
        f("absorption", absorption,
          {.unit = "1/scene", .min = 0, .help = "Absorption coefficient."});
        f("scatter", scatter, {.unit = "1/scene", .min = 0, .help = "Scattering coefficient."});
        f("phase", phase,
          {.min = -0.999,
           .max = 0.999,
           .help = "Henyey-Greenstein g: -1 backwards, 0 evenly, 1 forwards."});
    }
};

} // namespace weft::scene
