// How a scene is rendered: samplers, pixel filters and integrators.
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "base/match.h"
#include "scene/aov.h"
#include "scene/dialects.h"
#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

namespace dialects {
inline constexpr std::array kSamplers{
    Spelling{.parameter = "seed", .today = "is an option of the program today: --seed"},
};
} // namespace dialects

/// One struct per sampler type: all have the same parameter.
template <class Type>
struct SamplerSettings {
    static constexpr schema::TypeInfo info{.category = "sampler",
                                           .type = Type::name,
                                           .help = Type::help,
                                           .spellings = dialects::kSamplers};
    int count = 64;

    template <class F>
    constexpr void describe(F&& f) {
        f("count", count,
          {.min = 1, .max = 16777216, .soft_max = 4096, .help = "Samples per pixel."});
    }
};
struct SobolType {
    static constexpr std::string_view name = "sobol",
                                      help = "Owen-scrambled Sobol points: the default.";
};
struct HaltonType {
    static constexpr std::string_view name = "halton", help = "Scrambled Halton points.";
};
struct IndependentType {
    static constexpr std::string_view name = "independent", help = "Independent random numbers.";
};
using Sampler = std::variant<SamplerSettings<SobolType>, SamplerSettings<HaltonType>,
                             SamplerSettings<IndependentType>>;

enum class FilterShape { box, tent, gaussian, blackmanHarris };
constexpr auto choices(FilterShape) {
    return std::array<std::string_view, 4>{"box", "tent", "gaussian", "blackmanHarris"};
}

/// What every integrator needs to know: what to render and where to put the picture.
struct RenderTarget {
    SceneId scene;
    SamplerId sampler;
    ImageId image;
    FilterShape filter = FilterShape::box;
    float filter_width = 0;

    template <class F>
    constexpr void describe(F&& f) {
        f("scene", scene, {.required = true, .help = "What is rendered."});
        f("sampler", sampler,
          {.help = "Samples per pixel and their pattern; Sobol with 64 where there is none."});
        f("image", image,
          {.help = "The picture: `<image id=\"name\"/>` is written as name.exr beside the scene."});
        f("filter", filter, {.help = "Pixel filter."});
        f("filterWidth", filter_width,
          {.unit = "pixels",
           .min = 0,
           .max = 16,
           .help = "Full width of the filter; 0 = the usual one (box 1, tent 2, Gaussian 3, "
                   "Blackman-Harris 3)."});
    }
};

struct CameraIntegrator {
    static constexpr schema::TypeInfo info{
        .category = "integrator",
        .type = "camera",
        .help = "Draws the directions of camera rays and a grid, for debugging cameras."};
    RenderTarget target;
    bool grid = true;
    Color grid_color{0};
    float grid_frequency = 10;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(target);
        f("grid", grid,
          {.help = "Draw the grid in the plane z = 1; without it, the direction itself is the "
                   "colour."});
        f("gridColor", grid_color, {.help = "Colour of the grid's lines."});
        f("gridFrequency", grid_frequency, {.min = 0, .help = "Lines per scene unit."});
    }
};

enum class AovVariable { normals, distance, uv, bvh };
constexpr auto choices(AovVariable) {
    return std::array<std::string_view, 4>{"normals", "distance", "uv", "bvh"};
}

namespace dialects {
inline constexpr std::array kAovs{
    Spelling{.type = "normals",
             .today = "is <integrator type=\"aov\" variable=\"normals\"> today",
             .rewrite = normals_as_aov},
    Spelling{.type = "bvh",
             .today = "is <integrator type=\"aov\" variable=\"bvh\"> today",
             .rewrite = bvh_as_aov},
    Spelling{.parameter = "variable",
             .today = "\"albedo\" is <integrator type=\"albedo\"> today",
             .rewrite = albedo_as_integrator},
    Spelling{.parameter = "nee", .today = kFirstHit},
    Spelling{.parameter = "mis", .today = kFirstHit},
};
inline constexpr std::array kNormals{
    Spelling{.parameter = "variable", .today = kFirstHit},
    Spelling{.parameter = "nee", .today = kFirstHit},
    Spelling{.parameter = "mis", .today = kFirstHit},
};
inline constexpr std::array kAlbedos{
    Spelling{.type = "albedos", .today = "is <integrator type=\"albedo\"> today"},
    Spelling{.parameter = "nee", .today = kFirstHit},
    Spelling{.parameter = "mis", .today = kFirstHit},
};
inline constexpr std::array kDirect{
    Spelling{.parameter = "variable",
             .today = "has no effect: this integrator draws light; the normals are <integrator "
                      "type=\"aov\" variable=\"normals\">"},
    Spelling{.parameter = "depth",
             .today = "has no effect: light comes over one surface here; `pathtracer` has a depth"},
    Spelling{.parameter = "nee", .today = kOneStrategy},
    Spelling{.parameter = "mis", .today = kOneStrategy},
};
} // namespace dialects

struct AovIntegrator {
    static constexpr schema::TypeInfo info{.category = "integrator",
                                           .type = "aov",
                                           .help = "Draws one property of the first hit.",
                                           .spellings = dialects::kAovs};
    RenderTarget target;
    AovVariable variable = AovVariable::normals;
    float scale = 1;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(target);
        f("variable", variable,
          {.help = "normals: shading normal as (n + 1) / 2; distance; uv; bvh: the kernel does not "
                   "count its steps, so this draws 1 on a hit and 0 elsewhere."});
        f("scale", scale, {.min = 1e-12, .help = "Divides the value."});
    }
};

struct NormalIntegrator {
    static constexpr schema::TypeInfo info{
        .category = "integrator",
        .type = "normal",
        .help = "Draws the shading normal at the first hit; black where there is none.",
        .spellings = dialects::kNormals};
    RenderTarget target;
    bool remap = true;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(target);
        f("remap", remap, {.help = "Draw (n + 1) / 2 instead of n."});
    }
};

struct AlbedoIntegrator {
    static constexpr schema::TypeInfo info{
        .category = "integrator",
        .type = "albedo",
        .help = "Draws the fraction of light that the first surface scatters.",
        .spellings = dialects::kAlbedos};
    RenderTarget target;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(target);
    }
};

struct DirectIntegrator {
    static constexpr schema::TypeInfo info{
        .category = "integrator",
        .type = "direct",
        .help = "Light that reaches the camera over at most one surface.",
        .spellings = dialects::kDirect};
    RenderTarget target;
    Outputs outputs;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(target);
        f.group(outputs);
    }
};

inline constexpr schema::Attr kDepthAttr{
    .min = -1,
    .max = 100000,
    .soft_max = 64,
    .help = "Number of surfaces, media and background seen along a path, the first hit counted "
            "(2 is direct light alone); -1 is no limit."};

enum class Strategy { mis, nee, bsdf };
constexpr auto choices(Strategy) { return std::array<std::string_view, 3>{"mis", "nee", "bsdf"}; }
inline constexpr schema::Attr kStrategyAttr{
    .help = "How light is found: by the lights (nee), by the surfaces (bsdf), or both combined by "
            "multiple importance sampling (mis). All have the same mean."};

/// See lobes::BentNormals.
enum class BentNormals { drop, fold };
constexpr auto choices(BentNormals) { return std::array<std::string_view, 2>{"drop", "fold"}; }

struct PathIntegrator {
    static constexpr schema::TypeInfo info{
        .category = "integrator",
        .type = "path",
        .help = "All light, over any number of surfaces and media.",
        .example =
            "<integrator type=\"path\" depth=\"16\">\n  <ref id=\"scene\"/>\n"
            "  <sampler type=\"sobol\" count=\"256\"/>\n  <image id=\"picture\"/>\n</integrator>",
        .spellings = dialects::kStrategies};
    RenderTarget target;
    int depth = 16;
    Strategy strategy = Strategy::mis;
    int roulette_depth = 3;
    int light_samples = 1;
    BentNormals normals = BentNormals::drop;
    bool full_materials = false;
    bool caustics = true;
    bool secondary_specular = true;
    float secondary_roughness = 0;
    float indirect_clamp = 0;
    bool controls = true;
    Outputs outputs;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(target);
        f("depth", depth, kDepthAttr);
        f("strategy", strategy, kStrategyAttr);
        f("rouletteDepth", roulette_depth,
          {.min = 1,
           .max = 100000,
           .help = "Vertices of a path that Russian roulette leaves alone."});
        f("lightSamples", light_samples,
          {.min = 1,
           .max = 1024,
           .soft_max = 16,
           .help = "Up to so many lights are sampled at once where a path scatters first; fewer "
                   "where few matter. Worth it where direct light from several lights is what is "
                   "noisy."});
        f("normals", normals,
          {.help = "What becomes of light that normal maps and vertex normals send below the "
                   "surface: it is lost, as elsewhere (drop), or mirrored back, which keeps all "
                   "energy and flattens relief at low angles (fold)."});
        f("fullMaterials", full_materials,
          {.help = "Materials are themselves also where they name a simpler one for `secondary` "
                   "rays; `weft compare` of both pictures tells what that costs in truth."});
        f("caustics", caustics,
          {.help = "Without them, light is left out that mirrors, glass and glossy surfaces throw "
                   "onto diffuse ones."});
        f("secondarySpecular", secondary_specular,
          {.help = "Without it, surfaces seen after a diffuse bounce lose their mirrors, glass and "
                   "gloss, and are the darker for it."});
        f("secondaryRoughness", secondary_roughness,
          {.min = 0,
           .max = 1,
           .help = "Least roughness of surfaces seen after a bounce that scatters: takes the noise "
                   "of caustics for some blur."});
        f("indirectClamp", indirect_clamp,
          {.unit = "W/(m^2 sr)",
           .min = 0,
           .help = "No single contribution over two or more bounces counts for more than this in "
                   "any channel; 0 is no limit."});
        f("controls", controls,
          {.help = "Without it, nothing of the above applies, nor what lights and instances say of "
                   "links, visibility and distances: what `weft compare` then finds is what they "
                   "took away."});
        f.group(outputs);
    }
};

namespace dialects {
inline constexpr std::array kPathtracers{
    Spelling{.type = "neepathtracer", .today = "is <integrator type=\"pathtracer\"> today"},
    Spelling{.type = "bsdfpathtracer",
             .today = "is <integrator type=\"pathtracer\" strategy=\"bsdf\"> today",
             .rewrite = path_without_lights},
    Spelling{.type = "volumePathtracer",
             .today = "is <integrator type=\"pathtracer\"> today, which follows light through "
                      "media, too"},
    kStrategies[0],
    kStrategies[1],
    kStrategies[2],
};
inline constexpr std::array kMisPathtracers{
    Spelling{.type = "pathtracer_mis", .today = "is <integrator type=\"mis\"> today"},
    Spelling{.type = "mispathtracer", .today = "is <integrator type=\"mis\"> today"},
    kStrategies[0],
    kStrategies[1],
    kStrategies[2],
};
} // namespace dialects

/// lightwave's names for the path integrator, each with a usual strategy.
template <class Type>
struct NamedPathIntegrator {
    static constexpr schema::TypeInfo info{.category = "integrator",
                                           .type = Type::name,
                                           .help = Type::help,
                                           .spellings = Type::spellings};
    RenderTarget target;
    int depth = 2;
    Strategy strategy = Type::strategy;
    Outputs outputs;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(target);
        f("depth", depth, kDepthAttr);
        f("strategy", strategy, kStrategyAttr);
        f.group(outputs);
    }
};
struct PathtracerType {
    static constexpr std::string_view name = "pathtracer", help = "`path` with strategy nee.";
    static constexpr Strategy strategy = Strategy::nee;
    static constexpr std::span<schema::Spelling const> spellings = dialects::kPathtracers;
};
struct MisType {
    static constexpr std::string_view name = "mis", help = "`path` with strategy mis.";
    static constexpr Strategy strategy = Strategy::mis;
    static constexpr std::span<schema::Spelling const> spellings = dialects::kMisPathtracers;
};

using Integrator = std::variant<CameraIntegrator, AovIntegrator, NormalIntegrator, AlbedoIntegrator,
                                DirectIntegrator, PathIntegrator,
                                NamedPathIntegrator<PathtracerType>, NamedPathIntegrator<MisType>>;

/// An integrator that follows light has AOVs and fills the film's records; any other draws one
/// property of the first hit. Having `outputs` is what tells them apart, here and nowhere else.
template <class I>
concept FollowsLight = requires(I const& integrator) {
    { integrator.outputs } -> std::same_as<Outputs const&>;
};

/// Returns what the integrator can make beside its picture; null where it does not follow light.
inline Outputs const* outputs_of(Integrator const& integrator) {
    return match(integrator, []<class I>(I const& i) -> Outputs const* {
        if constexpr (FollowsLight<I>)
            return &i.outputs;
        else
            return nullptr;
    });
}

/// The picture that an integrator or a postprocess makes, or one that a postprocess reads from a
/// file.
struct ImageOutput {
    static constexpr schema::TypeInfo info{
        .category = "image",
        .type = "",
        .help = "A picture; its id names the file. As what a postprocess reads it may be a file "
                "that is there already.",
        .example =
            "<postprocess type=\"tonemap\">\n  <image name=\"input\" filename=\"sky.hdr\"/>\n"
            "  <image id=\"mapped\"/>\n</postprocess>"};
    FileName filename;
    bool linear = false;
    DisplayId display;

    template <class F>
    constexpr void describe(F&& f) {
        f("filename", filename,
          {.help = "A file to read the picture from, relative to the scene file: only for what a "
                   "postprocess reads."});
        f("linear", linear,
          {.help =
               "A file of 8 or 16 bits holds light; without it, a gamma of 2.2 is taken back."});
        f("display", display,
          {.help = "How it is shown where it is written as PNG, JPEG or TIFF; by default clipped "
                   "and encoded as sRGB."});
    }
};

namespace dialects {
inline constexpr std::array kTests{
    Spelling{.parameter = "scene",
             .today = "stands inside of the integrator that refers to it today",
             .rewrite = scene_into_integrator},
};
} // namespace dialects

struct ImageTest {
    static constexpr schema::TypeInfo info{
        .category = "test",
        .type = "image",
        .help = "Renders its integrator, or does its postprocess, to ID_test.exr beside the scene "
                "and compares with ID_ref.exr.",
        .spellings = dialects::kTests};
    IntegratorId integrator;
    PostprocessId postprocess;
    float mae = 0.1f;
    float me = 2e-4f;
    bool allow_negative = true;

    template <class F>
    constexpr void describe(F&& f) {
        f("integrator", integrator, {.help = "What is rendered."});
        f("postprocess", postprocess, {.help = "What is done instead, to pictures made before."});
        f("mae", mae,
          {.min = 0, .help = "Largest mean absolute error over all pixels and channels."});
        f("me", me, {.min = 0, .help = "Largest absolute value of the mean signed error."});
        f("allowNegative", allow_negative,
          {.help = "Without it, a picture fails that has a negative value."});
    }
};

} // namespace weft::scene
