// What is done to finished pictures: `<postprocess type="...">` beside the integrators of a file.
//
// Integrators and postprocesses run in the order of the file. Each reads pictures that were made
// before it and makes one of its own. To add a kind:
//
//  1. a described struct here, with category "postprocess" and a type of its own. Its member
//     `image` (ImageId, required) is the picture that it makes; every other ImageId member is a
//     picture that it reads. The reader of scene files knows nothing more about it.
//  2. a place in the variant `Postprocess`.
//  3. `Applied apply(scene::Kind const&, Inputs const&)`, declared in post/apply.h.
//
// Schema, help, reference pages, round-trip tests, the check that inputs come first, and files
// follow from that.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "base/match.h"
#include "scene/bloom.h"
#include "scene/dialects.h"
#include "scene/handles.h"
#include "scene/tonemap.h"
#include "schema/describe.h"

namespace weft::scene {

/// What denoises; `automatic` is the first of the others that is there.
enum class DenoiseBackend { automatic, oidn, network, nlm };
constexpr auto choices(DenoiseBackend) {
    return std::array<std::string_view, 4>{"auto", "oidn", "network", "nlm"};
}

/// How much time it may take: see post/denoise.h.
enum class DenoiseQuality { high, balanced };
constexpr auto choices(DenoiseQuality) {
    return std::array<std::string_view, 2>{"high", "balanced"};
}

namespace dialects {
inline constexpr std::array kDenoisers{
    Spelling{.type = "denoise", .today = "is <postprocess type=\"denoising\"> today"},
    Spelling{.parameter = "aovs",
             .today = "has no effect: what tells which edges are real are `albedo` and `normal`"},
};
} // namespace dialects

struct Denoising {
    static constexpr schema::TypeInfo info{
        .category = "postprocess",
        .type = "denoising",
        .help =
            "Takes the noise out of a picture. Albedo and normals of the same scene, as AOVs of "
            "the picture or pictures of their own, tell it which edges are real.",
        .example =
            "<postprocess type=\"denoising\">\n  <ref name=\"input\" id=\"noisy\"/>\n"
            "  <ref name=\"albedo\" id=\"albedo\"/>\n  <ref name=\"normal\" id=\"normal\"/>\n"
            "  <image id=\"clean\"/>\n</postprocess>",
        .spellings = dialects::kDenoisers};
    ImageId input, albedo, normal, image;
    DenoiseBackend backend = DenoiseBackend::automatic;
    DenoiseQuality quality = DenoiseQuality::high;
    int memory = 1024;

    template <class F>
    constexpr void describe(F&& f) {
        f("input", input,
          {.required = true, .help = "The picture with noise, made before this one."});
        f("albedo", albedo,
          {.help = "What the `albedo` integrator draws of the same scene; without it the AOV "
                   "`denoise_albedo` or `albedo` of the input.",
           .aliases = {"albedos"}});
        f("normal", normal,
          {.help = "What the `normal` integrator draws of the same scene; (n + 1) / 2 where no "
                   "value is negative, else n; without it the AOV `denoise_normal` or `normal` of "
                   "the input. Is used only together with the albedo by `oidn` and `network`.",
           .aliases = {"normals"}});
        f("image", image, {.required = true, .help = "The picture to write."});
        f("backend", backend,
          {.help = "oidn: the library Open Image Denoise; network: its published weights, "
                   "evaluated by Weft; nlm: non-local means; auto: the first of these that is "
                   "there."});
        f("quality", quality,
          {.help = "high: albedo and normal are denoised first, and the network is the larger one; "
                   "balanced: a quarter of the time. `nlm` has one quality."});
        f("memory", memory,
          {.unit = "MB",
           .min = 256,
           .max = 1048576,
           .soft_max = 16384,
           .help = "What denoising may take beside the pictures; less means smaller tiles, and "
                   "changes nothing but the time."});
    }
};

using Postprocess = std::variant<Denoising, Bloom, Tonemap>;

namespace detail {

struct PictureCollector {
    std::vector<std::pair<std::string_view, ImageId>>& inputs;
    ImageId& output;

    void operator()(std::string_view name, ImageId& id, schema::Attr const&) {
        if (name == "image")
            output = id;
        else if (id)
            inputs.emplace_back(name, id);
    }
    template <class T>
    void operator()(std::string_view, T&, schema::Attr const&) {}
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }
};

} // namespace detail

/// The pictures that a postprocess reads and makes: indices into those of its file.
struct PostprocessPictures {
    std::vector<std::pair<std::string_view, ImageId>> inputs; ///< with the parameters' names
    ImageId output;
};

inline PostprocessPictures pictures_of(Postprocess postprocess) {
    PostprocessPictures result;
    match(postprocess, [&](auto& p) {
        p.describe(detail::PictureCollector{result.inputs, result.output});
    });
    return result;
}

} // namespace weft::scene
