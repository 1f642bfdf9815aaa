// Tone mapping as a postprocess: light that no screen can show becomes values below 1. The result
// is a picture of light again, scene-linear in its file; how it is shown is a `display`'s business.
#pragma once

#include <array>
#include <string_view>

#include "scene/dialects.h"
#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

enum class ToneOperator { reinhard, drago };
constexpr auto choices(ToneOperator) {
    return std::array<std::string_view, 2>{"reinhard", "drago"};
}

namespace dialects {
inline constexpr std::string_view kTonemapToday =
    "is <postprocess type=\"tonemap\"> today; teams calculate it in different ways, one from each "
    "channel, one from the luminance. Here it is the operator `drago` unless something else is "
    "said";
inline constexpr std::array kTonemaps{
    Spelling{.type = "tone_mapping", .today = kTonemapToday, .rewrite = operator_by_flag},
    Spelling{.type = "tonemapping", .today = "is <postprocess type=\"tonemap\"> today"},
    Spelling{.parameter = "useLogScale",
             .today = "is the operator `drago` today; without it, it is `reinhard`",
             .rewrite = operator_by_flag},
};
} // namespace dialects

struct Tonemap {
    static constexpr schema::TypeInfo info{
        .category = "postprocess",
        .type = "tonemap",
        .help = "Brings what is bright below 1. For pictures on a screen `display` has better "
                "curves; this is for files that go on as light.",
        .example =
            "<postprocess type=\"tonemap\" operator=\"reinhard\">\n"
            "  <ref name=\"input\" id=\"picture\"/>\n  <image id=\"mapped\"/>\n</postprocess>",
        .spellings = dialects::kTonemaps};
    ImageId input, image;
    ToneOperator curve = ToneOperator::reinhard;
    float bias = 0.85f;

    template <class F>
    constexpr void describe(F&& f) {
        f("input", input, {.required = true, .help = "The picture, made before this one."});
        f("image", image, {.required = true, .help = "The picture to write."});
        f("operator", curve,
          {.help =
               "reinhard: each channel c becomes c / (1 + c) (Reinhard et al. 2002, equation 3, "
               "by channel, as lightwave has it); drago: a logarithm of the luminance whose "
               "base grows with it, so that the brightest pixel becomes 1 (Drago et al. 2003)."});
        f("bias", bias,
          {.min = 0.01,
           .max = 1,
           .help = "drago: less is brighter in the dark and flatter in the light; 0.7 to 0.9."});
    }
};

} // namespace weft::scene
