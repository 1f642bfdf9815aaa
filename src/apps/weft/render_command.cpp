// weft render SCENE: reads, commits, renders, writes.
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/checkpoint.h"
#include "apps/weft/commands.h"
#include "apps/weft/interrupt.h"
#include "apps/weft/live_view.h"
#include "apps/weft/picture_file.h"
#include "apps/weft/progress_line.h"
#include "apps/weft/scene_loading.h"
#include "apps/weft/texture_options.h"
#include "image/atomic_file.h"
#include "image/write.h"
#include "session/render_state.h"

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
    CheckpointArguments checkpoint;
    std::string shard, samples, time, watch, tev;
    bool preview = false, profile = false;
    session::RenderOptions options;
};

/// "K/N" and "A:B".
session::Part parse_part(std::string const& shard, std::string const& samples) {
    session::Part part;
    auto const pair = [](std::string const& text, char between, auto& a, auto& b) {
        size_t const at = text.find(between);
        return at != std::string::npos && schema::TextForm<int>::read(text.substr(0, at), a) &&
               schema::TextForm<int>::read(text.substr(at + 1), b);
    };
    if (!shard.empty() &&
        (!pair(shard, '/', part.shard, part.shards) || part.shard < 1 || part.shard > part.shards))
        throw InputError("--shard expects K/N with K from 1 to N, found '" + shard + "'");
    int first = 0, last = 0;
    if (!samples.empty()) {
        if (!pair(samples, ':', first, last) || first < 0 || last <= first)
            throw InputError("--samples expects A:B, from sample A to before sample B, found '" +
                             samples + "'");
        part.first = uint32_t(first);
        part.last = uint32_t(last);
    }
    return part;
}

/// What cannot be had together.
void check_part(RenderArguments const& a, io::RenderJob const& job) {
    session::Part const& part = a.options.part;
    if (part.is_whole()) return;
    if (a.options.noise > 0 || a.options.seconds > 0)
        throw InputError("--noise and --time look at the whole picture: parts of one (--shard, "
                         "--samples) expect a number of samples");
    uint32_t const limit = session::sample_limit(job, a.options);
    if (part.last > limit)
        throw InputError(fmt::format("--samples expects a part of the {} samples per pixel, found "
                                     "'{}'; --spp says how many there are",
                                     limit, a.samples));
}

/// Four comma-separated pixel coordinates.
film::Region parse_crop(std::string const& text) {
    auto const v = schema::read_numbers(text);
    bool whole = v && v->size() == 4;
    if (whole)
        for (double x : *v) whole &= x == std::floor(x) && std::abs(x) < 1e6;
    if (!whole) throw InputError("--crop expects x0,y0,x1,y1 in pixels, found '" + text + "'");
    return {{int((*v)[0]), int((*v)[1])}, {int((*v)[2]), int((*v)[3])}};
}

/// What a part of a picture is called where nothing else is said: "shard-2-of-4.samples-0-32.weft".
std::string part_extension(session::Part const& part) {
    if (part.is_whole()) return ".exr";
    std::string text;
    if (part.shards > 1) text = fmt::format(".shard-{}-of-{}", part.shard, part.shards);
    if (part.last > 0) text += fmt::format(".samples-{}-{}", part.first, part.last);
    return text + ".weft";
}

/// Where a job's pictures go: what the user asked for, or NAME.exr beside the scene.
std::vector<std::string> output_paths(RenderArguments const& a, io::RenderJob const& job,
                                      bool only_job) {
    std::string const stem =
        job.image_name.empty() ? fs::path(a.scene).stem().string() : job.image_name;
    if (a.outputs.empty())
        return {(fs::path(job.folder) / (stem + part_extension(a.options.part))).string()};
    std::vector<std::string> paths;
    for (std::string const& output : a.outputs) {
        if (fs::is_directory(output))
            paths.push_back((fs::path(output) / (stem + part_extension(a.options.part))).string());
        else if (only_job)
            paths.push_back(output);
        else
            throw InputError(
                "-o expects an existing folder, since the scene renders several pictures; found '" +
                output + "'");
    }
    return paths;
}

void check_outputs(std::vector<std::string> const& paths, session::Part const& part) {
    for (std::string const& path : paths) {
        if (part.is_whole()) {
            image::check_writable(path);
            continue;
        }
        if (fs::path(path).extension() != ".weft")
            throw InputError("-o expects a .weft file for a part of a picture (`weft merge` joins "
                             "parts), found '" +
                             path + "'");
        image::probe_folder(path);
    }
}

/// AOVs need a file that can hold them.
void check_aovs(RenderArguments const& a, io::RenderJob const& job,
                std::vector<std::string> const& paths) {
    if (!a.options.part.is_whole()) return;
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

void write_part(std::vector<std::string> const& paths, session::RenderResult&& result,
                world::World const& world, io::RenderJob const& job,
                session::RenderOptions const& options) {
    std::string note = header_text(picture_header(result, job, world, options.seed));
    session::RenderState state = session::to_state(std::move(result), world, job, options);
    state.note = std::move(note);
    for (std::string const& path : paths) {
        session::save_state(path, state);
        fmt::print("{}\n", path);
    }
}

/// Writes what there is, says what was reached, and returns the exit code.
int finish(session::RenderOptions const& options, std::vector<std::string> const& paths,
           io::RenderJob const& job, world::World const& world, ProgressLine& progress,
           session::RenderResult&& result) {
    report_bad_samples(result, options.seed);
    bool const whole = options.part.is_whole();
    if (result.cancelled && (!whole || result.least_samples == 0)) {
        fmt::print(stderr, "stopped before {}: no file is overwritten\n",
                   whole ? "every pixel had a sample" : "the part was done");
        return kInterrupted;
    }
    progress.phase("write");
    if (whole) {
        image::ExrHeader const header = picture_header(result, job, world, options.seed);
        for (std::string const& path : paths) {
            write_picture(path, result.film, header);
            fmt::print("{}\n", path);
        }
    }
    print_summary(result, options);
    progress.done(result);
    bool const cancelled = result.cancelled;
    if (!whole) write_part(paths, std::move(result), world, job, options);
    return cancelled ? kInterrupted : kDone;
}

int render_job(RenderArguments const& a, io::RenderJob const& job, bool only_job,
               image::TextureCache const& textures, ProgressLine& progress) {
    auto const paths = output_paths(a, job, only_job);
    check_outputs(paths, a.options.part);
    check_aovs(a, job, paths);
    check_part(a, job);
    progress.phase("commit");
    auto const world = world::World::commit(job.scene, {a.isa, parse_size(a.size, *job.scene)});
    for (std::string const& lint : lint_warnings(*world)) fmt::print(stderr, "warning: {}\n", lint);

    session::RenderOptions options = a.options;
    options.on_progress = [&](session::Progress const& p) { progress.print(p); };
    if (!a.crop.empty()) options.crop = parse_crop(a.crop);
    GracefulInterrupt const interrupt;
    options.cancel = &interrupt.flag();
    std::optional<Checkpoint> checkpoint;
    if (a.checkpoint.wanted()) {
        if (!only_job && !a.checkpoint.file.empty())
            throw InputError("--checkpoint-file expects a scene with one picture; --checkpoint "
                             "names a file for each");
        checkpoint.emplace(a.checkpoint, paths.front(),
                           session::starting_state(*world, job, options));
        options.resume = checkpoint->found();
        options.watchers.push_back(checkpoint->watcher());
    }
    if (!a.watch.empty()) options.watchers.push_back(png_watcher(a.watch));
    std::optional<TevClient> tev;
    if (!a.tev.empty()) {
        tev.emplace(a.tev, paths.front());
        options.watchers.push_back(tev->watcher());
    }
    progress.phase("render");
    session::RenderResult result = session::render(*world, job, options);
    if (result.cancelled) progress.stop();
    if (tev) tev->show(result.film);
    if (!a.watch.empty()) image::write_image(a.watch, result.image);
    if (std::string const failure = textures.failure(); !failure.empty())
        fmt::print(stderr, "warning: a texture was lost during the render: {}\n", failure);
    if (checkpoint && result.cancelled) {
        session::RenderResult copy = result;
        checkpoint->save(session::to_state(std::move(copy), *world, job, options));
        fmt::print(stderr, "{} keeps what is done: the same command goes on from there\n",
                   checkpoint->path());
    }
    int const code = finish(options, paths, job, *world, progress, std::move(result));
    if (checkpoint && code == kDone) checkpoint->remove();
    return code;
}

/// Enough for light and materials to be told apart.
constexpr int kPreviewSamples = 8;

int run(RenderArguments& a) {
    if (std::find(a.aovs.begin(), a.aovs.end(), "list") != a.aovs.end()) {
        fmt::print("{}", aovs_text());
        return kDone;
    }
    if (a.scene.empty()) throw InputError("weft render expects a scene file, found none");
    a.options.aovs = parse_aovs(a.aovs);
    a.options.part = parse_part(a.shard, a.samples);
    a.options.version = WEFT_VERSION;
    a.options.kernel = a.isa;
    if (!a.time.empty()) a.options.seconds = parse_duration(a.time, "--time");
    if (a.preview) {
        if (a.size.empty()) a.size = "50%";
        if (a.options.spp == 0) a.options.spp = kPreviewSamples;
    }
    ProgressLine progress(progress_style(a.progress));
    progress.phase("read");
    a.textures.show_conversion = a.progress != "none" && a.progress != "json";
    io::SceneFile const file =
        io::read_scene_file(a.scene, a.overrides, make_texture_cache(a.textures));
    for (std::string const& warning : file.warnings) fmt::print(stderr, "warning: {}\n", warning);
    for (io::RenderJob const& job : file.jobs)
        if (int const code = render_job(a, job, file.jobs.size() == 1, *file.textures, progress);
            code != kDone)
            return code;
    if (a.profile) progress.print_profile();
    return kDone;
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
    c->add_option("--noise", a->options.noise,
                  "Render until the estimated relative error is below this everywhere, for example "
                  "0.02; --spp is then the most that a pixel gets (65536 if not said)")
        ->type_name("X")
        ->check(CLI::Range(1e-5, 10.0));
    c->add_option("--time", a->time,
                  "Render until this time is up, in whole passes: 90s, 10m, 2h; with --noise and "
                  "--spp, whichever comes first")
        ->type_name("TIME");
    add_checkpoint_options(*c, a->checkpoint);
    c->add_option("--shard", a->shard,
                  "Render every N-th tile only, from the K-th; `weft merge` joins the parts")
        ->type_name("K/N");
    c->add_option("--samples", a->samples,
                  "Render these of each pixel's samples only, from A to before B; `weft merge` "
                  "joins the parts")
        ->type_name("A:B");
    c->add_flag("--preview", a->preview,
                "A quick look: half the size and 8 samples per pixel, unless --size and --spp say "
                "otherwise; all materials and lights as they are");
    c->add_option("--watch", a->watch,
                  "Write the picture so far to this file every two seconds, for a viewer that "
                  "reloads it")
        ->type_name("PNG");
    c->add_option("--tev", a->tev, "Show the picture so far in the viewer tev, every second")
        ->type_name("HOST:PORT");
    c->add_flag("--profile", a->profile, "Say at the end where the time went, by phase");
    add_texture_options(*c, a->textures);
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
