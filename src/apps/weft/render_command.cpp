// weft render SCENE: reads, commits, renders, writes.
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/interrupt.h"
#include "apps/weft/progress_line.h"
#include "apps/weft/scene_loading.h"
#include "apps/weft/texture_options.h"
#include "image/write.h"
#include "session/render.h"
#include "world/lints.h"

namespace weft::apps {

namespace fs = std::filesystem;

namespace {

struct RenderArguments {
    std::string scene;
    std::vector<std::string> outputs;
    std::string size, crop;
    std::string progress = "auto";
    std::vector<std::string> overrides;
    std::string isa;
    TextureArguments textures;
    session::RenderOptions options;
};

/// Four comma-separated pixel coordinates.
film::Region parse_crop(std::string const& text) {
    auto const v = schema::read_numbers(text);
    bool whole = v && v->size() == 4;
    if (whole)
        for (double x : *v) whole &= x == std::floor(x) && std::abs(x) < 1e6;
    if (!whole) throw InputError("--crop expects x0,y0,x1,y1 in pixels, found '" + text + "'");
    return {{int((*v)[0]), int((*v)[1])}, {int((*v)[2]), int((*v)[3])}};
}

/// Where a job's pictures go: what the user asked for, or NAME.exr beside the scene.
std::vector<std::string> output_paths(RenderArguments const& a, io::RenderJob const& job,
                                      bool only_job) {
    std::string const stem =
        job.image_name.empty() ? fs::path(a.scene).stem().string() : job.image_name;
    if (a.outputs.empty()) return {(fs::path(job.folder) / (stem + ".exr")).string()};
    std::vector<std::string> paths;
    for (std::string const& output : a.outputs) {
        if (fs::is_directory(output))
            paths.push_back((fs::path(output) / (stem + ".exr")).string());
        else if (only_job)
            paths.push_back(output);
        else
            throw InputError(
                "-o expects an existing folder, since the scene renders several pictures; found '" +
                output + "'");
    }
    return paths;
}

/// What is written beside the pixels.
image::Metadata metadata(RenderArguments const& a, session::RenderResult const& r) {
    return {{"Software", "Weft " WEFT_VERSION},
            {"weft:seed", std::to_string(a.options.seed)},
            {"weft:samplesPerPixel", std::to_string(r.least_samples)},
            {"weft:complete", r.cancelled ? "false" : "true"}};
}

void report_bad_samples(session::RenderResult const& r, uint32_t seed) {
    if (r.bad_samples == 0) return;
    fmt::print(stderr, "warning: {} samples were not finite and count as black; the first:\n",
               r.bad_samples);
    for (auto const& b : r.first_bad_samples)
        fmt::print(stderr, "  pixel {},{} sample {} seed {}: {} {} {}\n", b.pixel.x, b.pixel.y,
                   b.sample, seed, b.value.r, b.value.g, b.value.b);
}

int render_job(RenderArguments& a, io::RenderJob const& job, bool only_job,
               image::TextureCache const& textures) {
    auto const paths = output_paths(a, job, only_job);
    for (std::string const& path : paths) image::check_writable(path);
    auto const world = world::World::commit(job.scene, {a.isa, parse_size(a.size, *job.scene)});
    for (std::string const& lint : world::lint_warnings(*world, job.integrator))
        fmt::print(stderr, "warning: {}\n", lint);

    ProgressLine progress(progress_style(a.progress));
    a.options.on_progress = [&](session::Progress const& p) { progress.print(p); };
    if (!a.crop.empty()) a.options.crop = parse_crop(a.crop);
    GracefulInterrupt const interrupt;
    a.options.cancel = &interrupt.flag();
    session::RenderResult const result = session::render(*world, job, a.options);
    if (result.cancelled) progress.stop();
    report_bad_samples(result, a.options.seed);
    if (std::string const failure = textures.failure(); !failure.empty())
        fmt::print(stderr, "warning: a texture was lost during the render: {}\n", failure);
    if (result.least_samples == 0) {
        fmt::print(stderr, "stopped before every pixel had a sample: no file is overwritten\n");
        return kInterrupted;
    }
    for (std::string const& path : paths) {
        image::write_image(path, result.image, metadata(a, result));
        fmt::print("{}\n", path);
    }
    fmt::print(stderr, "{} x {} pixels, {} samples each: {}, {} samples/s\n", result.region.width(),
               result.region.height(), result.least_samples, duration_text(result.seconds),
               count_text(result.pixel_samples / std::max(result.seconds, 1e-9)));
    if (!result.cancelled) return kDone;
    fmt::print(stderr,
               "stopped; what is done is written: {} of {} samples in each pixel, {:.1f} on the "
               "average\n",
               result.least_samples, result.samples,
               result.pixel_samples / (double(result.region.width()) * result.region.height()));
    return kInterrupted;
}

int run(RenderArguments& a) {
    a.textures.show_conversion = a.progress != "none" && a.progress != "json";
    io::SceneFile const file =
        io::read_scene_file(a.scene, a.overrides, make_texture_cache(a.textures));
    for (std::string const& warning : file.warnings) fmt::print(stderr, "warning: {}\n", warning);
    for (io::RenderJob const& job : file.jobs)
        if (int const code = render_job(a, job, file.jobs.size() == 1, *file.textures);
            code != kDone)
            return code;
    return kDone;
}

} // namespace

void add_render_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<RenderArguments>();
    CLI::App* c = app.add_subcommand("render", "Render a scene file");
    c->add_option("scene", a->scene, "The scene file, or a glTF file (.gltf, .glb)")
        ->required()
        ->type_name("SCENE");
    c->add_option(
         "-o,--output", a->outputs,
         "Picture to write: .exr, .hdr, .png, .jpg, .tif, or a folder; may be given several times")
        ->type_name("OUT")
        ->take_all();
    c->add_option("--spp", a->options.spp, "Samples per pixel, instead of the scene's")
        ->check(CLI::Range(1, 1 << 24));
    c->add_option("--size", a->size, "Size of the picture: WxH in pixels, or P% of the scene's")
        ->type_name("WxH|P%");
    c->add_option("--crop", a->crop, "Render only this region of the picture, in pixels")
        ->type_name("x0,y0,x1,y1");
    c->add_option("--threads", a->options.threads, "Number of threads; 0 is one per processor")
        ->check(CLI::Range(0, 1024));
    c->add_option("--seed", a->options.seed, "Another seed gives other noise");
    c->add_option("--tile", a->options.tile_size, "Size of a tile in pixels; changes no pixel")
        ->check(CLI::Range(1, 4096));
    c->add_option("--progress", a->progress, "How to tell how far it is")
        ->check(CLI::IsMember({"auto", "json", "none"}));
    c->add_option("--set", a->overrides,
                  "Set a parameter of the scene, for example --set camera.fov=30")
        ->type_name("PATH.PARAM=VALUE")
        ->take_all();
    c->add_option(
         "--isa", a->isa,
         "Pin the ray kernel's instruction set, so that different machines give the same bits")
        ->check(CLI::IsMember({"sse2", "sse4.2", "avx", "avx2", "avx512"}));
    add_texture_options(*c, a->textures);
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
