// Bloom: light that the eye or a lens scatters around what is bright.
#pragma once

#include <array>
#include <string_view>

#include "scene/dialects.h"
#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

enum class BloomKind { glare, threshold };
constexpr auto choices(BloomKind) { return std::array<std::string_view, 2>{"glare", "threshold"}; }

namespace dialects {
inline constexpr std::string_view kBoxesToday =
    "says how widely boxes blur what is bright; today a Gaussian does, of the `sigma` that they "
    "amount to. The team that says so adds whole pixels that are brighter than the threshold, not "
    "what exceeds it, and a second, narrow bloom";
inline constexpr std::array kBlooms{
    Spelling{.type = "image_bloom",
             .today = "is <postprocess type=\"bloom\"> today, with `intensity` for `strength`; it "
                      "adds what exceeds the threshold, without a square and an upper bound",
             .rewrite = bloom_by_gaussian},
    Spelling{.parameter = "kernelSize", .today = kBoxesToday, .rewrite = bloom_by_boxes},
    Spelling{.parameter = "iterations", .today = kBoxesToday, .rewrite = bloom_by_boxes},
    Spelling{.parameter = "softThreshold",
             .today = "has no effect: the threshold has no soft edge"},
    Spelling{.parameter = "amountSmall",
             .today = "has no effect: there is one bloom, not a second, narrow one"},
};
} // namespace dialects

struct Bloom {
    static constexpr schema::TypeInfo info{
        .category = "postprocess",
        .type = "bloom",
        .help = "Light that the eye or a lens scatters around what is bright, before any tone "
                "mapping.",
        .example = "<postprocess type=\"bloom\" strength=\"0.1\" fov=\"40\">\n  <ref "
                   "name=\"input\" id=\"picture\"/>\n  <image id=\"bloomed\"/>\n</postprocess>",
        .spellings = dialects::kBlooms};
    ImageId input, image;
    BloomKind kind = BloomKind::glare;
    float strength = 0.1f;
    float fov = 40;
    float threshold = 1;
    float sigma = 3;
    int radius = 0;
    float intensity = 1;

    template <class F>
    constexpr void describe(F&& f) {
        f("input", input, {.required = true, .help = "The picture, made before this one."});
        f("image", image, {.required = true, .help = "The picture to write."});
        f("kind", kind,
          {.help = "glare: every pixel scatters a part of its light as an eye does, and no light "
                   "is gained or lost. threshold: a blurred copy of what is brighter than a "
                   "threshold is added, as lightwave does; also where a parameter of this kind is "
                   "given and no kind."});
        f("strength", strength,
          {.min = 0,
           .max = 1,
           .help = "glare: the part of the light that is scattered; 0.62 is that of the eye, "
                   "camera lenses have some hundredths."});
        f("fov", fov,
          {.unit = "deg",
           .min = 0.1,
           .max = 170,
           .help = "glare: the angle that the picture's width stands for, which says how large "
                   "the glare is in the picture."});
        f("threshold", threshold,
          {.min = 0,
           .soft_max = 10,
           .help = "threshold: of a pixel's largest channel, what exceeds this blooms."});
        f("sigma", sigma,
          {.unit = "pixels",
           .min = 0.1,
           .max = 4096,
           .soft_max = 100,
           .help = "threshold: standard deviation of the Gaussian that it is blurred by."});
        f("radius", radius,
          {.unit = "pixels",
           .min = 0,
           .max = 16384,
           .soft_max = 300,
           .help = "threshold: where the Gaussian ends; 0 is four standard deviations."});
        f("intensity", intensity,
          {.min = 0,
           .soft_max = 4,
           .help = "threshold: scales what is added.",
           .aliases = {"amount"}});
    }
};

/// Makes `bloom.kind` what the parameters that were `given(name)` amount to. Returns the first of
/// them that the kind has no use for, or "".
template <class Given>
std::string_view settle_kind(Bloom& bloom, Given const& given) {
    constexpr std::array<std::string_view, 2> of_glare{"strength", "fov"};
    constexpr std::array<std::string_view, 4> of_threshold{"threshold", "sigma", "radius",
                                                           "intensity"};
    if (!given("kind"))
        for (std::string_view name : of_threshold)
            if (given(name)) bloom.kind = BloomKind::threshold;
    auto first = [&](auto const& names) {
        for (std::string_view name : names)
            if (given(name)) return name;
        return std::string_view();
    };
    return bloom.kind == BloomKind::glare ? first(of_threshold) : first(of_glare);
}

} // namespace weft::scene
