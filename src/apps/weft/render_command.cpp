// weft render SCENE: reads, commits, renders, writes.
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>

#include "apps/weft/commands.h"
#include "apps/weft/display_options.h"
#include "apps/weft/interrupt.h"
#include "apps/weft/picture_file.h"
#include "apps/weft/progress_line.h"
#include "apps/weft/scene_loading.h"
#include "apps/weft/texture_options.h"
#include "image/write.h"
#include "integrator/pixel_renderer.h"
#include "post/run.h"
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
    std::vector<std::string> overrides, aovs;
    std::string isa;
    TextureArguments textures;
    OptionTexts display;
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

/// Where a picture goes: what the user asked for, or NAME.exr beside the scene.
std::vector<std::string> output_paths(RenderArguments const& a, io::PictureName const& picture,
                                      bool only_picture) {
    std::string const stem =
        picture.name.empty() ? fs::path(a.scene).stem().string() : picture.name;
    if (a.outputs.empty()) return {(fs::path(picture.folder) / (stem + ".exr")).string()};
    std::vector<std::string> paths;
    for (std::string const& output : a.outputs) {
        if (fs::is_directory(output))
            paths.push_back((fs::path(output) / (stem + ".exr")).string());
        else if (only_picture)
            paths.push_back(output);
        else
            throw InputError(
                "-o expects an existing folder, since the scene renders several pictures; found '" +
                output + "'");
    }
    return paths;
}

/// AOVs need a file that can hold them.
void check_aovs(RenderArguments const& a, io::RenderJob const& job,
                std::vector<std::string> const& paths) {
    bool const wanted = !a.options.aovs.empty() || !session::wanted_aovs(job.integrator).empty();
    auto const is_exr = [](std::string const& path) {
        return fs::path(path).extension() == ".exr";
    };
    if (!wanted || std::any_of(paths.begin(), paths.end(), is_exr)) return;
    if (!a.options.aovs.empty())
        throw InputError("--aov expects an output that can hold further channels (.exr), found '" +
                         paths.front() + "'");
    fmt::print(stderr, "warning: the AOVs that the scene asks for are not written: only .exr files "
                       "hold them\n");
}

void report_bad_samples(session::RenderResult const& r, uint32_t seed) {
    if (r.bad_samples == 0) return;
    fmt::print(
        stderr,
        "warning: {} samples were not finite or negative light and count as black; `weft replay` "
        "traces one again; the first:\n",
        r.bad_samples);
    for (auto const& b : r.first_bad_samples)
        fmt::print(stderr, "  pixel {},{} sample {} seed {}: {} {} {}\n", b.pixel.x, b.pixel.y,
                   b.sample, seed, b.value.r, b.value.g, b.value.b);
}

void write_picture(std::vector<std::string> const& paths, post::Picture const& picture,
                   post::DisplayChain const& chain) {
    for (std::string const& path : paths) {
        post::write_picture(path, picture.image, chain, picture.metadata);
        fmt::print("{}\n", path);
    }
}

/// `made` becomes the picture.
int render_job(RenderArguments& a, io::RenderJob const& job, bool only_picture,
               image::TextureCache const& textures, post::DisplayChain const& chain,
               post::Picture& made) {
    auto const paths = output_paths(a, {job.image_name, job.folder, {}, {}}, only_picture);
    for (std::string const& path : paths) image::check_writable(path);
    check_aovs(a, job, paths);
    auto const world =
        world::World::commit(job.scene, {a.isa, parse_size(a.size, *job.scene),
                                         integrator::combines_strategies(job.integrator)});
    for (std::string const& lint : world::lint_warnings(*world, job.integrator))
        fmt::print(stderr, "warning: {}\n", lint);

    ProgressLine progress(progress_style(a.progress));
    a.options.on_progress = [&](session::Progress const& p) { progress.print(p); };
    if (!a.crop.empty()) a.options.crop = parse_crop(a.crop);
    GracefulInterrupt const interrupt;
    a.options.cancel = &interrupt.flag();
    session::RenderResult result = session::render(*world, job, a.options);
    if (result.cancelled) progress.stop();
    report_bad_samples(result, a.options.seed);
    if (std::string const failure = textures.failure(); !failure.empty())
        fmt::print(stderr, "warning: a texture was lost during the render: {}\n", failure);
    if (result.least_samples == 0) {
        fmt::print(stderr, "stopped before every pixel had a sample: no file is overwritten\n");
        return kInterrupted;
    }
    for (std::string const& path : paths) {
        write_render(path, result, job, *world, a.options.seed, chain);
        fmt::print("{}\n", path);
    }
    made = {result.image, render_metadata(result, a.options.seed)};
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

io::PictureName const& output_of(io::SceneFile const& file, io::PostprocessJob const& job) {
    return file.pictures[size_t(scene::pictures_of(job.postprocess).output.index)];
}

/// Whether a picture is an input of a postprocess from `next` on.
bool is_read(int32_t picture, std::vector<io::PostprocessJob>::const_iterator next,
             io::SceneFile const& file) {
    return std::any_of(next, file.postprocesses.end(), [&](io::PostprocessJob const& job) {
        auto const inputs = scene::pictures_of(job.postprocess).inputs;
        return std::any_of(inputs.begin(), inputs.end(),
                           [&](auto const& input) { return input.second.index == picture; });
    });
}

/// How the file and the options want each picture shown, by ImageId::index; -1: one without an
/// <image>.
std::map<int32_t, post::DisplayChain> display_chains(RenderArguments const& a,
                                                     io::SceneFile const& file) {
    std::map<int32_t, post::DisplayChain> chains;
    for (size_t i = 0; i < file.pictures.size(); ++i)
        chains.emplace(int32_t(i), display_chain(a.display, file.pictures[i].display,
                                                 file.pictures[i].display_where));
    if (std::any_of(file.jobs.begin(), file.jobs.end(),
                    [](io::RenderJob const& job) { return !job.target.image; }))
        chains.emplace(-1, display_chain(a.display));
    std::set<std::string> told;
    for (auto const& [picture, chain] : chains)
        if (told.insert(chain.warning).second) print_warning(chain);
    return chains;
}

/// Integrators and postprocesses in the order of the file.
int run_file(RenderArguments& a, io::SceneFile const& file) {
    bool const only_picture = file.jobs.size() + file.postprocesses.size() == 1;
    auto const chains = display_chains(a, file);
    for (io::PostprocessJob const& job : file.postprocesses) {
        auto const& picture = output_of(file, job);
        for (std::string const& path : output_paths(a, picture, only_picture))
            image::check_writable(path);
    }
    post::Pictures pictures;
    auto next = file.postprocesses.begin();
    for (size_t i = 0; i < file.jobs.size(); ++i) {
        post::Picture made;
        int32_t const image = file.jobs[i].target.image.index;
        int const code =
            render_job(a, file.jobs[i], only_picture, *file.textures, chains.at(image), made);
        if (code != kDone) return code;
        pictures[image] = std::move(made);
        for (; next != file.postprocesses.end() && next->jobs_before == i + 1; ++next) {
            post::Picture result = post::run(*next, pictures);
            int32_t const output = scene::pictures_of(next->postprocess).output.index;
            write_picture(output_paths(a, output_of(file, *next), only_picture), result,
                          chains.at(output));
            pictures[output] = std::move(result);
        }
        std::erase_if(pictures, [&](auto const& p) { return !is_read(p.first, next, file); });
    }
    return kDone;
}

int run(RenderArguments& a) {
    if (std::find(a.aovs.begin(), a.aovs.end(), "list") != a.aovs.end()) {
        fmt::print("{}", aovs_text());
        return kDone;
    }
    if (a.scene.empty()) throw InputError("weft render expects a scene file, found none");
    a.options.aovs = parse_aovs(a.aovs);
    a.textures.show_conversion = a.progress != "none" && a.progress != "json";
    io::SceneFile const file =
        io::read_scene_file(a.scene, a.overrides, make_texture_cache(a.textures));
    for (std::string const& warning : file.warnings) fmt::print(stderr, "warning: {}\n", warning);
    return run_file(a, file);
}

} // namespace

void add_render_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<RenderArguments>();
    CLI::App* c = app.add_subcommand("render", "Render a scene file");
    c->add_option("scene", a->scene, "The scene file, or a glTF file (.gltf, .glb)")
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
    c->add_option("--aov", a->aovs,
                  "Further pictures of the same samples in the EXR file, for example "
                  "albedo,normal,depth; may be given several times; `list` lists them")
        ->type_name("NAMES")
        ->take_all();
    c->add_option(
         "--isa", a->isa,
         "Pin the ray kernel's instruction set, so that different machines give the same bits")
        ->check(CLI::IsMember({"sse2", "sse4.2", "avx", "avx2", "avx512"}));
    add_texture_options(*c, a->textures);
    add_display_options(*c, a->display);
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
