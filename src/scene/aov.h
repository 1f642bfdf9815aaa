// The pictures beside the beauty that a render can make of the same samples ("arbitrary output
// variables"). docs/aovs.md says what each holds and how its channels are called in a file.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "schema/describe.h"

namespace weft::scene {

enum class Aov : uint8_t {
    beauty,
    alpha,
    depth,
    position,
    normal,
    normal_geometric,
    uv,
    albedo,
    emission,
    background,
    direct_diffuse,
    indirect_diffuse,
    direct_specular,
    indirect_specular,
    direct_transmission,
    indirect_transmission,
    direct_volume,
    indirect_volume,
    direct_subsurface,
    indirect_subsurface,
    light_groups,
    layers,
    denoise_albedo,
    denoise_normal,
    crypto_object,
    crypto_material,
    crypto_asset,
    sample_count,
    variance,
    shadow_catcher,
    removed
};

/// The light group, and the layer, of whatever names none; always the first.
inline constexpr char const* kDefaultGroup = "default";

struct AovInfo {
    std::string_view name, channels, help;
};

/// In the order of `Aov`.
inline constexpr std::array<AovInfo, 31> kAovs{{
    {"beauty", "R G B", "The picture itself; always there."},
    {"alpha", "A",
     "How much of the pixel is covered: holes of opacity and the background are not."},
    {"depth", "Z",
     "Distance along the camera's axis to the nearest surface; 1e10 where there is none."},
    {"position", "P.X P.Y P.Z", "Place of the nearest surface in world space."},
    {"normal", "N.X N.Y N.Z", "Mean shading normal of the first surface, in world space."},
    {"normal_geometric", "Ng.X Ng.Y Ng.Z",
     "Mean normal of the first surface itself, without normal maps and smoothing."},
    {"uv", "UV.U UV.V", "Texture coordinates of the nearest surface."},
    {"albedo", "albedo.R ...", "The part of light that the first surface scatters."},
    {"emission", "emission.R ...", "Light of surfaces that the camera sees straight."},
    {"background", "background.R ...",
     "Light from infinitely far away that the camera sees straight."},
    {"direct_diffuse", "direct_diffuse.R ...", "Light over one diffuse reflection."},
    {"indirect_diffuse", "indirect_diffuse.R ...",
     "Light over more bounces, the first (from the camera) a diffuse reflection."},
    {"direct_specular", "direct_specular.R ...", "Likewise for glossy and mirror reflection."},
    {"indirect_specular", "indirect_specular.R ...", "Likewise for glossy and mirror reflection."},
    {"direct_transmission", "direct_transmission.R ...",
     "Likewise for all that goes through a surface."},
    {"indirect_transmission", "indirect_transmission.R ...",
     "Likewise for all that goes through a surface."},
    {"direct_volume", "direct_volume.R ...", "Likewise for scattering in media."},
    {"indirect_volume", "indirect_volume.R ...", "Likewise for scattering in media."},
    {"direct_subsurface", "direct_subsurface.R ...", "Likewise for scattering below a surface."},
    {"indirect_subsurface", "indirect_subsurface.R ...",
     "Likewise for scattering below a surface."},
    {"light_groups", "light_NAME.R ...",
     "One picture per `group` of lights, and light_default of all others; they add up to the "
     "beauty."},
    {"layers", "layer_NAME.R ...",
     "One picture per `label` of materials' layers, of the light that the camera sees this layer "
     "scatter, and layer_default of all other light; they add up to the beauty."},
    {"denoise_albedo", "denoise_albedo.R ...",
     "Guide for denoisers: albedo of the first surface that is no mirror or clear glass, seen by "
     "way of those."},
    {"denoise_normal", "denoise_normal.X ...", "Guide for denoisers: normal of that surface."},
    {"crypto_object", "CryptoObject00.R ...", "Cryptomatte by the id of instances."},
    {"crypto_material", "CryptoMaterial00.R ...", "Cryptomatte by the id of materials."},
    {"crypto_asset", "CryptoAsset00.R ...",
     "Cryptomatte by the id of the outermost instance: a group is one asset."},
    {"sample_count", "sample_count", "How many samples the pixel has."},
    {"variance", "variance.R ...",
     "Estimated variance of the beauty: of the pixel's mean, not of one sample."},
    {"shadow_catcher", "shadow_catcher.R ...",
     "Of the light of lights that reaches shadow catchers, the part that other instances do not "
     "block; 1 where there is none."},
    {"removed", "removed.R ...",
     "What light controls, visibility, limits and simpler secondary materials took out of the "
     "beauty: both add up to the picture without them. It costs a second path for each sample."},
}};

constexpr auto choices(Aov) {
    std::array<std::string_view, kAovs.size()> names{};
    for (size_t i = 0; i < names.size(); ++i) names[i] = kAovs[i].name;
    return names;
}

/// Of a name that other renderers have, why it is missing here; else "".
constexpr std::string_view why_missing(Aov, std::string_view name) {
    return name == "motion" || name == "motion_vector" || name == "velocity"
               ? " (nothing moves in Weft's scenes yet, so there is no motion to picture)"
               : "";
}

/// What an integrator that follows light can make beside its picture.
struct Outputs {
    std::vector<Aov> aovs;
    int cryptomatte_levels = 6;

    template <class F>
    constexpr void describe(F&& f) {
        f("aovs", aovs,
          {.help = "Further pictures to make of the same samples, for example `albedo, normal, "
                   "depth`; all go into one EXR file. `weft help aov` explains each."});
        f("cryptomatteLevels", cryptomatte_levels,
          {.min = 2,
           .max = 32,
           .help = "How many objects of one pixel a Cryptomatte can tell apart."});
    }
};

} // namespace weft::scene
