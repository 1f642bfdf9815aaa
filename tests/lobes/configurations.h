// Parameter sets for every alternative of LobeVariant. An alternative without a specialisation
// here does not compile: the tests cannot forget a lobe.
#pragma once

#include <string>
#include <vector>

#include "base/hash.h"
#include "lobes/bsdf.h"
#include "lobes/conductor_presets.h"

namespace weft::lobes::testing {

template <class L>
struct Configuration {
    std::string name;
    L lobe;
    bool isotropic = true;
    /// Relative error that rounding of directions (some 1e-6 in all) makes in the value.
    float resolution = 1e-4f;
    bool weighs_below_one = true; ///< every sample: f / pdf is at most 1
    bool reciprocal = true;
    /// By which the albedo may pass 1: rounding of a mean of ones, or for compensated lobes the
    /// error of the tables (see energy.cpp).
    double gain = 1e-4;
};

/// Whether the distribution draws visible normals, which G2 / G1 <= 1 weighs.
template <class Distribution>
constexpr bool draws_visible = !std::is_same_v<Distribution, AshikhminShirley>;

template <class L>
std::vector<Configuration<L>> test_configurations() = delete;

template <>
inline std::vector<Configuration<Lambert>> test_configurations<Lambert>() {
    return {{"Lambert", {}}};
}

/// One of each kind, and a film over a dielectric.
inline std::vector<std::pair<std::string, Fresnel>> test_fresnels() {
    Conductor const gold = conductor_presets[0].conductor, iron = conductor_presets[4].conductor;
    return {{"white", WhiteFresnel{}},
            {"Schlick", SchlickFresnel{Color(0.04f, 0.5f, 0.9f), Color(1, 0.8f, 0.9f)}},
            {"F82", schlick_f82(Color(0.3f, 0.6f, 0.95f), Color(0.2f, 0.8f, 0.5f))},
            {"dielectric", DielectricFresnel{1.5f}},
            {"dielectric of a high index", DielectricFresnel{15}},
            {"conductor", ConductorFresnel{gold.eta, gold.k}},
            {"film on a metal", ThinFilmFresnel{{300, 1.4f}, iron.eta, iron.k}},
            {"film on glass", ThinFilmFresnel{{450, 1.33f}, Color(1.5f), Color(0)}},
            {"thin wall", ThinWallFresnel{1.5f}},
            {"thin wall under films", ThinWallFresnel{1.5f, {450, 1.33f}}}};
}

template <>
inline std::vector<Configuration<SpecularReflection>> test_configurations<SpecularReflection>() {
    std::vector<Configuration<SpecularReflection>> all;
    for (auto const& [name, fresnel] : test_fresnels())
        all.push_back({"SpecularReflection " + name, {fresnel}});
    return all;
}

template <>
inline std::vector<Configuration<SpecularDielectric>> test_configurations<SpecularDielectric>() {
    return {
        {"SpecularDielectric entering", {1.5f}},
        {"SpecularDielectric leaving", {1 / 1.5f}},
        {"SpecularDielectric matched", {1.f}},
        {"SpecularDielectric tinted", {1.33f, Color(0.9f, 0.5f, 0.1f), Color(0.2f, 0.3f, 0.7f)}},
        {"SpecularDielectric mirror only", {1.5f, Color(1), Color(0)}},
        {"SpecularDielectric black", {1.5f, Color(0), Color(0)}},
        {"SpecularDielectric stronger reflection", {1.3f, Color(1), Color(1), {2.4f}}},
        {"SpecularDielectric weaker reflection", {1 / 1.8f, Color(1), Color(1), {1 / 1.3f}}},
        {"SpecularDielectric film", {1.5f, Color(1), Color(1), {0, {500, 1.8f}}}},
        {"SpecularDielectric film inside",
         {1 / 1.5f, Color(1), Color(1), {0, {300, 1.33f, 1.5f}}}}};
}

template <class Distribution>
std::vector<Configuration<MicrofacetReflection<Distribution>>>
reflections(std::string const& name) {
    std::vector<Configuration<MicrofacetReflection<Distribution>>> all;
    for (Vec2 const& a : {Vec2(1e-3f, 1e-3f), Vec2(0.02f, 0.02f), Vec2(0.1f, 0.1f),
                          Vec2(0.5f, 0.5f), Vec2(1, 1), Vec2(0.05f, 0.4f), Vec2(0.8f, 2e-3f)}) {
        all.push_back({name + " alpha " + std::to_string(a.x) + " " + std::to_string(a.y),
                       {{a.x, a.y}},
                       a.x == a.y,
                       std::max(1e-4f, 1e-6f / std::min(a.x, a.y)),
                       draws_visible<Distribution>});
        all.push_back(all.back());
        all.back().name += " separable";
        all.back().lobe.distribution.shadowing = Shadowing::Separable;
    }
    int i = 0;
    for (auto const& [fresnel_name, fresnel] : test_fresnels()) {
        for (bool const compensated : {false, true}) {
            // All of them with GGX: samples and densities do not depend on them.
            if (!std::is_same_v<Distribution, Ggx> && i % 4 != 3) continue;
            Vec2 const a = i % 3 == 0 ? Vec2(0.5f, 0.1f) : Vec2(0.1f * float(i + 1));
            auto const shadowing = i % 2 == 0 ? Shadowing::Separable : Shadowing::Correlated;
            all.push_back({name + " " + fresnel_name + (compensated ? " compensated" : ""),
                           {{a.x, a.y, shadowing}, fresnel, compensated},
                           a.x == a.y,
                           1e-4f,
                           draws_visible<Distribution> && !compensated,
                           !compensated,
                           compensated ? (a.x == a.y ? 5e-4 : 2e-3) : 1e-4});
        }
        ++i;
    }
    return all;
}

template <class Distribution>
std::vector<Configuration<MicrofacetDielectric<Distribution>>>
dielectrics(std::string const& name) {
    struct Parameters {
        float alpha_x, alpha_y, eta;
        Color reflectance{1.f}, transmittance{1.f};
        BoundaryOptions options{};
        bool compensated = false;
        Shadowing shadowing = Shadowing::Correlated;
    };
    constexpr auto separable = Shadowing::Separable;
    std::vector<Configuration<MicrofacetDielectric<Distribution>>> all;
    for (Parameters const& p : std::vector<Parameters>{
             {1e-3f, 1e-3f, 1.5f},
             {1e-3f, 1e-3f, 1 / 1.5f},
             {1e-3f, 1e-3f, 1},
             {0.1f, 0.1f, 1.5f},
             {0.1f, 0.1f, 1 / 1.5f},
             {0.3f, 0.3f, 1},
             {0.5f, 0.5f, 1.33f},
             {0.5f, 0.5f, 1 / 1.33f},
             {1, 1, 2.4f},
             {1, 1, 1 / 2.4f},
             {0.05f, 0.4f, 1.5f},
             {0.4f, 0.05f, 1 / 1.5f},
             {0.2f, 0.2f, 1.5f, Color(0.9f, 0.5f, 0.1f), Color(0.2f, 0.3f, 0.7f)},
             {0.2f, 0.2f, 1 / 1.5f, Color(0), Color(1)},
             {0.2f, 0.2f, 1.5f, Color(0), Color(0)},
             {0.1f, 0.1f, 1.5f, Color(1), Color(1), {}, false, separable},
             {0.5f, 0.5f, 1 / 1.33f, Color(1), Color(1), {}, false, separable},
             {0.05f, 0.4f, 1.5f, Color(1), Color(1), {}, false, separable},
             {0.6f, 0.6f, 1.5f, Color(1), Color(1), {}, true, separable},
             {0.6f, 0.6f, 1.5f, Color(1), Color(1), {}, true},
             {0.3f, 0.6f, 1 / 1.5f, Color(1), Color(1), {}, true},
             {0.2f, 0.2f, 1.3f, Color(1), Color(1), {2}},
             {0.5f, 0.5f, 1 / 1.3f, Color(1), Color(1), {1 / 2.f}, true},
             {0.2f, 0.2f, 1.8f, Color(1), Color(1), {1.3f}},
             {0.2f, 0.2f, 1.5f, Color(1), Color(1), {0, {500, 1.8f}}},
             {0.4f, 0.4f, 1 / 1.5f, Color(1), Color(1), {0, {300, 1.33f, 1.5f}}, true}}) {
        MicrofacetDielectric<Distribution> const lobe({p.alpha_x, p.alpha_y, p.shadowing}, p.eta,
                                                      p.reflectance, p.transmittance, p.options,
                                                      p.compensated);
        float const width =
            std::min(p.alpha_x, p.alpha_y) * std::min(1.f, std::abs(lobe.eta() - 1));
        // The onset of total reflection by the other index and the fringes of films magnify
        // rounding, and the density follows the channels' average.
        bool const options = p.options.film || p.options.reflection_eta > 0;
        all.push_back(
            {name + " alpha " + std::to_string(p.alpha_x) + " " + std::to_string(p.alpha_y) +
                 " eta " + std::to_string(p.eta) + " tints " + std::to_string(p.reflectance.r) +
                 " " + std::to_string(p.transmittance.r) + " reflection " +
                 std::to_string(p.options.reflection_eta) + " film " +
                 std::to_string(p.options.film.thickness) + (p.compensated ? " compensated" : "") +
                 (p.shadowing == separable ? " separable" : ""),
             lobe, p.alpha_x == p.alpha_y, options ? 5e-3f : std::max(1e-4f, 1e-6f / width),
             draws_visible<Distribution> && !p.compensated && !options,
             !p.compensated && p.options.reflection_eta <= p.eta, p.compensated ? 0.01 : 1e-4});
    }
    return all;
}

template <>
inline std::vector<Configuration<GgxReflection>> test_configurations<GgxReflection>() {
    return reflections<Ggx>("GgxReflection");
}
template <>
inline std::vector<Configuration<BeckmannReflection>> test_configurations<BeckmannReflection>() {
    return reflections<Beckmann>("BeckmannReflection");
}
template <>
inline std::vector<Configuration<AshikhminShirleyReflection>>
test_configurations<AshikhminShirleyReflection>() {
    return reflections<AshikhminShirley>("AshikhminShirleyReflection");
}
template <>
inline std::vector<Configuration<AshikhminShirleyDielectric>>
test_configurations<AshikhminShirleyDielectric>() {
    return dielectrics<AshikhminShirley>("AshikhminShirleyDielectric");
}
template <>
inline std::vector<Configuration<GgxDielectric>> test_configurations<GgxDielectric>() {
    return dielectrics<Ggx>("GgxDielectric");
}
template <>
inline std::vector<Configuration<BeckmannDielectric>> test_configurations<BeckmannDielectric>() {
    return dielectrics<Beckmann>("BeckmannDielectric");
}

template <class Distribution>
std::vector<Configuration<ThinTransmission<Distribution>>>
thin_transmissions(std::string const& name) {
    std::vector<Configuration<ThinTransmission<Distribution>>> all;
    for (Vec2 const& a : {Vec2(0.01f, 0.01f), Vec2(0.2f, 0.2f), Vec2(0.8f, 0.8f), Vec2(0.1f, 0.5f)})
        all.push_back({name + " alpha " + std::to_string(a.x) + " " + std::to_string(a.y),
                       Distribution{a.x, a.y}, a.x == a.y,
                       std::max(1e-4f, 1e-6f / std::min(a.x, a.y)), false, false,
                       a.x == a.y ? 5e-4 : 2e-3});
    return all;
}
template <>
inline std::vector<Configuration<GgxThinTransmission>> test_configurations<GgxThinTransmission>() {
    return thin_transmissions<Ggx>("GgxThinTransmission");
}
template <>
inline std::vector<Configuration<BeckmannThinTransmission>>
test_configurations<BeckmannThinTransmission>() {
    return thin_transmissions<Beckmann>("BeckmannThinTransmission");
}
template <>
inline std::vector<Configuration<AshikhminShirleyThinTransmission>>
test_configurations<AshikhminShirleyThinTransmission>() {
    return thin_transmissions<AshikhminShirley>("AshikhminShirleyThinTransmission");
}

template <>
inline std::vector<Configuration<OrenNayar>> test_configurations<OrenNayar>() {
    std::vector<Configuration<OrenNayar>> all;
    for (float const roughness : {0.f, 0.1f, 0.5f, 1.f})
        for (Color const& rho : {Color(1), Color(0.9f, 0.4f, 0.05f)})
            all.push_back({.name = "OrenNayar roughness " + std::to_string(roughness) + " rho " +
                                   std::to_string(rho.g),
                           .lobe = {rho, roughness},
                           .weighs_below_one = false});
    return all;
}

template <>
inline std::vector<Configuration<BurleyDiffuse>> test_configurations<BurleyDiffuse>() {
    std::vector<Configuration<BurleyDiffuse>> all;
    for (float const roughness : {0.f, 0.3f, 0.5f, 0.77f, 1.f})
        all.push_back({.name = "BurleyDiffuse roughness " + std::to_string(roughness),
                       .lobe = {roughness},
                       .weighs_below_one = false,
                       .reciprocal = false});
    return all;
}

template <>
inline std::vector<Configuration<SubsurfaceDiffuse>> test_configurations<SubsurfaceDiffuse>() {
    return {{.name = "SubsurfaceDiffuse",
             .lobe = {{0.4f}},
             .weighs_below_one = false,
             .reciprocal = false}};
}

template <>
inline std::vector<Configuration<DiffuseTransmission>> test_configurations<DiffuseTransmission>() {
    return {{"DiffuseTransmission", {}}};
}

template <>
inline std::vector<Configuration<Transparent>> test_configurations<Transparent>() {
    return {{"Transparent", {}}};
}

template <>
inline std::vector<Configuration<Sheen>> test_configurations<Sheen>() {
    std::vector<Configuration<Sheen>> all;
    for (float const roughness : {0.f, 0.1f, 0.25f, 0.5f, 0.8f, 1.f})
        all.push_back({.name = "Sheen roughness " + std::to_string(roughness),
                       .lobe = {roughness},
                       .reciprocal = false});
    return all;
}

template <>
inline std::vector<Configuration<DisneySheen>> test_configurations<DisneySheen>() {
    return {{"DisneySheen", {}}};
}

template <>
inline std::vector<Configuration<Clearcoat>> test_configurations<Clearcoat>() {
    std::vector<Configuration<Clearcoat>> all;
    for (float const alpha : {1e-3f, 0.02f, 0.1f, 0.25f, 0.5f})
        for (float const ior : {1.5f, 2.5f})
            all.push_back(
                {.name = "Clearcoat alpha " + std::to_string(alpha) + " ior " + std::to_string(ior),
                 .lobe = Clearcoat(alpha, ior),
                 .resolution = std::max(1e-4f, 1e-6f / alpha)});
    return all;
}

template <>
inline std::vector<Configuration<Hair>> test_configurations<Hair>() {
    struct Parameters {
        float beta_m, beta_n, h;
        Color sigma_a{};
        float eta = 1.55f, alpha = radians(2.f);
    };
    std::vector<Configuration<Hair>> all;
    for (Parameters const& p : std::vector<Parameters>{
             {0.3f, 0.3f, 0.4f},
             {0.05f, 0.2f, -0.7f},
             {0.15f, 0.06f, 0},
             {1, 1, 0.9f},
             {0.6f, 0.9f, -1, Color(0.1f, 0.5f, 3)},
             {0.3f, 0.3f, 0.99f, Color(0.2f, 0.4f, 0.8f), 1.4f, radians(-3.f)},
             {0.25f, 0.4f, -0.3f, sigma_a_from_melanin(8, 0), 1.55f, radians(5.f)}}) {
        all.push_back({.name = "Hair beta_m " + std::to_string(p.beta_m) + " beta_n " +
                               std::to_string(p.beta_n) + " h " + std::to_string(p.h),
                       .lobe = Hair({p.sigma_a, p.beta_m, p.beta_n, p.eta, p.alpha}, p.h),
                       .isotropic = true,
                       .resolution = 1e-3f,
                       .reciprocal = false});
    }
    return all;
}

/// The lobe that light meets on its way back, for wo on the other side.
template <class L>
L seen_from_behind(L const& lobe) {
    return lobe;
}
template <class D>
MicrofacetDielectric<D> seen_from_behind(MicrofacetDielectric<D> const& lobe) {
    BoundaryOptions options = lobe.options();
    if (options.reflection_eta > 0) options.reflection_eta = 1 / options.reflection_eta;
    options.film.outer_ior *= lobe.eta();
    return {lobe.distribution(), 1 / lobe.eta(), lobe.reflectance(), lobe.transmittance(), options};
}

/// Calls f(configuration) for every configuration of every alternative that satisfies `Smooth`.
template <bool Smooth, class F>
void for_each_configuration(F&& f) {
    for_each_type<LobeVariant>([&]<class L>() {
        if constexpr (SmoothLobe<L> == Smooth) {
            for (Configuration<L> const& c : test_configurations<L>()) f(c);
        }
    });
}

/// Unit vector with z > 0 at an angle in degrees, at an azimuth that lines up with nothing.
inline Vec3 at_angle(float angle, float azimuth = 0.7f) {
    float const t = radians(angle);
    return {std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t)};
}

} // namespace weft::lobes::testing
