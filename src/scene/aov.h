// The pictures beside the beauty that a render can make of the same samples ("arbitrary output
// variables"). docs/aovs.md says what each holds and how its channels are called in a file.
#pragma once

#include <array>
#include <iterator>
#include <string_view>
#include <vector>

#include "schema/describe.h"

namespace weft::scene {

/// The light group, and the layer, of whatever names none; always the first.
inline constexpr char const* kDefaultGroup = "default";

/// How the samples of a pixel become the channels of an AOV.
enum class Accumulation : uint8_t {
    Beauty,            ///< the mean of the samples' colours, which every film has
    Mean,              ///< the mean of the samples
    MeanPerLightGroup, ///< a mean for each group of lights; its name ends the channels' layer
    MeanPerLayer,      ///< a mean for each label of materials' layers, likewise
    Ratio,             ///< the mean of one colour over the mean of another; 1 where that is 0
    Nearest,           ///< the sample whose surface is nearest
    Ids,               ///< a Cryptomatte: which part of the samples has each id
    SampleCount,       ///< the number of samples
    Variance           ///< the estimated variance of the pixel's beauty
};

/// Who sets an AOV of a sample (film/sample_record.h).
enum class AovSource : uint8_t {
    Film,         ///< the film, from the beauty of the samples
    Contribution, ///< the record, from what the path contributes
    FirstSurface, ///< the path, at the surface that it scatters at first; forgotten where it goes
                  ///< straight on there
    Guides,       ///< the path, at the first surface that is no mirror or clear glass
    Path          ///< the path, wherever it knows
};

// One row per AOV: X(name, layer, letters, accumulation, source, help). A channel is called
// LAYER.LETTER, by the letter alone where the layer has no name, and by the layer alone where there
// are no letters. To add an AOV, add a row; where the source is the path, call SampleRecord::set
// in integrator/record.cpp. Nothing else knows how many there are.
#define WEFT_AOVS(X)                                                                               \
    X(beauty, "", "RGB", Beauty, Film, "The picture itself; always there.")                        \
    X(alpha, "", "A", Mean, Path,                                                                  \
      "How much of the pixel is covered: holes of opacity and the background are not.")            \
    X(depth, "", "Z", Nearest, FirstSurface,                                                       \
      "Distance along the camera's axis to the nearest surface; 1e10 where there is none.")        \
    X(position, "P", "XYZ", Nearest, FirstSurface, "Place of the nearest surface in world space.") \
    X(normal, "N", "XYZ", Mean, FirstSurface,                                                      \
      "Mean shading normal of the first surface, in world space.")                                 \
    X(normal_geometric, "Ng", "XYZ", Mean, FirstSurface,                                           \
      "Mean normal of the first surface itself, without normal maps and smoothing.")               \
    X(uv, "UV", "UV", Nearest, FirstSurface, "Texture coordinates of the nearest surface.")        \
    X(albedo, "albedo", "RGB", Mean, FirstSurface,                                                 \
      "The part of light that the first surface scatters.")                                        \
    X(emission, "emission", "RGB", Mean, Contribution,                                             \
      "Light of surfaces that the camera sees straight.")                                          \
    X(background, "background", "RGB", Mean, Contribution,                                         \
      "Light from infinitely far away that the camera sees straight.")                             \
    X(direct_diffuse, "direct_diffuse", "RGB", Mean, Contribution,                                 \
      "Light over one diffuse reflection.")                                                        \
    X(indirect_diffuse, "indirect_diffuse", "RGB", Mean, Contribution,                             \
      "Light over more bounces, the first (from the camera) a diffuse reflection.")                \
    X(direct_specular, "direct_specular", "RGB", Mean, Contribution,                               \
      "Likewise for glossy and mirror reflection.")                                                \
    X(indirect_specular, "indirect_specular", "RGB", Mean, Contribution,                           \
      "Likewise for glossy and mirror reflection.")                                                \
    X(direct_transmission, "direct_transmission", "RGB", Mean, Contribution,                       \
      "Likewise for all that goes through a surface.")                                             \
    X(indirect_transmission, "indirect_transmission", "RGB", Mean, Contribution,                   \
      "Likewise for all that goes through a surface.")                                             \
    X(direct_volume, "direct_volume", "RGB", Mean, Contribution,                                   \
      "Likewise for scattering in media.")                                                         \
    X(indirect_volume, "indirect_volume", "RGB", Mean, Contribution,                               \
      "Likewise for scattering in media.")                                                         \
    X(direct_subsurface, "direct_subsurface", "RGB", Mean, Contribution,                           \
      "Likewise for scattering below a surface.")                                                  \
    X(indirect_subsurface, "indirect_subsurface", "RGB", Mean, Contribution,                       \
      "Likewise for scattering below a surface.")                                                  \
    X(light_groups, "light_", "RGB", MeanPerLightGroup, Contribution,                              \
      "One picture per `group` of lights, and light_default of all others; they add up to the "    \
      "beauty.")                                                                                   \
    X(layers, "layer_", "RGB", MeanPerLayer, Contribution,                                         \
      "One picture per `label` of materials' layers, of the light that the camera sees this "      \
      "layer scatter, and layer_default of all other light; they add up to the beauty.")           \
    X(denoise_albedo, "denoise_albedo", "RGB", Mean, Guides,                                       \
      "Guide for denoisers: albedo of the first surface that is no mirror or clear glass, seen "   \
      "by way of those.")                                                                          \
    X(denoise_normal, "denoise_normal", "XYZ", Mean, Guides,                                       \
      "Guide for denoisers: normal of that surface.")                                              \
    X(denoise_kept, "denoise_kept", "RGB", Mean, Contribution,                                     \
      "For denoisers: light that the camera sees straight and in focus, which has no noise to "    \
      "take out. Comes with the two guides.")                                                      \
    X(crypto_object, "CryptoObject", "", Ids, FirstSurface, "Cryptomatte by the id of instances.") \
    X(crypto_material, "CryptoMaterial", "", Ids, FirstSurface,                                    \
      "Cryptomatte by the id of materials.")                                                       \
    X(crypto_asset, "CryptoAsset", "", Ids, FirstSurface,                                          \
      "Cryptomatte by the id of the outermost instance: a group is one asset.")                    \
    X(sample_count, "sample_count", "", SampleCount, Film, "How many samples the pixel has.")      \
    X(variance, "variance", "RGB", Variance, Film,                                                 \
      "Estimated variance of the beauty: of the pixel's mean, not of one sample.")                 \
    X(shadow_catcher, "shadow_catcher", "RGB", Ratio, Path,                                        \
      "Of the light of lights that reaches shadow catchers, the part that other instances do not " \
      "block; 1 where there is none.")                                                             \
    X(removed, "removed", "RGB", Mean, Path,                                                       \
      "What light controls, visibility, limits and simpler secondary materials took out of the "   \
      "beauty: both add up to the picture without them. It costs a second path for each sample.")

enum class Aov : uint8_t {
#define WEFT_AOV(name, ...) name,
    WEFT_AOVS(WEFT_AOV)
#undef WEFT_AOV
};

struct AovInfo {
    Aov aov;
    std::string_view name, layer, letters;
    Accumulation how;
    AovSource source;
    std::string_view help;

    /// Returns how many channels it has, or each of its pictures where it has several; 0 for a
    /// Cryptomatte, which can be asked for any number.
    constexpr int channels() const {
        if (how == Accumulation::Ids) return 0;
        return letters.empty() ? 1 : int(letters.size());
    }
};

/// By the number of the AOV.
inline constexpr AovInfo kAovs[]{
#define WEFT_AOV(name, layer, letters, how, source, help)                                          \
    {Aov::name, #name, layer, letters, Accumulation::how, AovSource::source, help},
    WEFT_AOVS(WEFT_AOV)
#undef WEFT_AOV
};
#undef WEFT_AOVS
inline constexpr size_t kAovCount = std::size(kAovs);

constexpr AovInfo const& info_of(Aov aov) { return kAovs[size_t(aov)]; }

/// Returns how many AOVs accumulate in this way.
constexpr size_t count_of(Accumulation how) {
    size_t count = 0;
    for (AovInfo const& info : kAovs) count += info.how == how;
    return count;
}

constexpr auto choices(Aov) {
    std::array<std::string_view, kAovCount> names{};
    for (size_t i = 0; i < kAovCount; ++i) names[i] = kAovs[i].name;
    return names;
}

/// Returns why an AOV is missing that other renderers have by this name; "" for any other name.
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
