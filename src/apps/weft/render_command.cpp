// weft render SCENE: reads, commits, renders, writes.
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>

#include "apps/weft/commands.h"
#include "apps/weft/number_check.h"
#include "apps/weft/picture_file.h"
#include "apps/weft/render_job.h"
#include "apps/weft/scene_loading.h"
#include "image/write.h"

namespace weft::apps {

namespace {

scene::PictureName const& output_of(io::SceneFile const& file, scene::PostprocessJob const& job) {
    return file.pictures[size_t(scene::pictures_of(job.postprocess).output.index)];
}

/// Whether a picture is an input of a postprocess from `next` on.
bool is_read(int32_t picture, std::vector<scene::PostprocessJob>::const_iterator next,
             io::SceneFile const& file) {
    return std::any_of(next, file.postprocesses.end(), [&](scene::PostprocessJob const& job) {
        auto const inputs = scene::pictures_of(job.postprocess).inputs;
        return std::any_of(inputs.begin(), inputs.end(),
                           [&](auto const& input) { return input.second.index == picture; });
    });
}

/// Returns the postprocesses that give a picture other colours, or one that they have made of it.
std::vector<scene::PostprocessJob> made_of(int32_t picture, io::SceneFile const& file) {
    std::set<int32_t> family{picture};
    std::vector<scene::PostprocessJob> jobs;
    for (scene::PostprocessJob const& job : file.postprocesses) {
        auto const ids = scene::pictures_of(job.postprocess);
        for (auto const& [name, id] : ids.inputs)
            if (name == "input" && family.contains(id.index)) {
                family.insert(ids.output.index);
                jobs.push_back(job);
            }
    }
    return jobs;
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
                    [](scene::RenderJob const& job) { return !job.target.image; }))
        chains.emplace(-1, display_chain(a.display));
    std::set<std::string> told;
    for (auto const& [picture, chain] : chains)
        if (told.insert(chain.warning).second) print_warning(chain);
    return chains;
}

/// The picture that a file named by -o is for.
struct Final {
    int32_t image = -1; ///< ImageId::index; -1: that of an integrator without an <image>
    bool known = false;
};

/// Where -o names files, the one picture that nothing reads any further. Throws InputError where
/// there are several.
Final final_picture(RenderArguments const& a, io::SceneFile const& file, bool whole) {
    std::vector<std::pair<int32_t, std::string>> finals;
    for (scene::RenderJob const& job : file.jobs)
        if (!whole || !is_read(job.target.image.index, file.postprocesses.begin(), file))
            finals.emplace_back(job.target.image.index, job.image_name);
    for (auto job = file.postprocesses.begin(); whole && job != file.postprocesses.end(); ++job) {
        int32_t const output = scene::pictures_of(job->postprocess).output.index;
        if (!is_read(output, job + 1, file))
            finals.emplace_back(output, output_of(file, *job).name);
    }
    if (finals.size() == 1) return {finals.front().first, true};
    std::string names;
    for (auto const& [image, name] : finals)
        names += (names.empty() ? "'" : ", '") + (name.empty() ? "without a name" : name) + "'";
    for (std::string const& output : a.outputs)
        if (!std::filesystem::is_directory(output))
            throw InputError(
                "-o expects an existing folder, since the scene renders several pictures (" +
                names + "); found '" + output + "'");
    return {};
}

/// Integrators and postprocesses in the order of the file.
int run_file(RenderArguments& a, io::SceneFile const& file, ProgressLine& progress) {
    bool const only_picture = file.jobs.size() + file.postprocesses.size() == 1;
    auto const chains = display_chains(a, file);
    bool const whole = a.options.picture.part.is_whole();
    Final const final = final_picture(a, file, whole);
    auto const is_final = [&](int32_t image) { return final.known && final.image == image; };
    auto const paths_of = [&](scene::PostprocessJob const& job) {
        int32_t const output = scene::pictures_of(job.postprocess).output.index;
        return output_paths(a, output_of(file, job), is_final(output));
    };
    auto const later = [&](int32_t image) {
        std::vector<std::string> paths;
        for (scene::PostprocessJob const& job : made_of(image, file))
            for (std::string& path : paths_of(job)) paths.push_back(std::move(path));
        return paths;
    };
    if (!whole && !file.postprocesses.empty())
        fmt::print(stderr, "warning: postprocesses need the whole picture and are left out\n");
    for (scene::PostprocessJob const& job : file.postprocesses)
        for (std::string const& path : paths_of(job))
            if (whole) image::check_writable(path);
    post::Pictures pictures;
    auto next = file.postprocesses.begin();
    auto const process = [&](size_t jobs_done) {
        for (; next != file.postprocesses.end() && next->jobs_before == jobs_done; ++next) {
            read_picture_files(file, *next, pictures);
            post::Picture result = post::run(*next, pictures);
            int32_t const output = scene::pictures_of(next->postprocess).output.index;
            write_pictures(paths_of(*next), result, chains.at(output));
            pictures[output] = std::move(result);
        }
        std::erase_if(pictures, [&](auto const& p) { return !is_read(p.first, next, file); });
    };
    if (whole) process(0);
    for (size_t i = 0; i < file.jobs.size(); ++i) {
        int32_t const image = file.jobs[i].target.image.index;
        JobResult made = render_job(a,
                                    {file.jobs[i], *file.textures, chains.at(image),
                                     is_final(image), only_picture, later(image)},
                                    progress);
        if (made.code != kDone) return made.code;
        if (!whole) continue;
        pictures[image] = std::move(made.picture);
        process(i + 1);
    }
    return kDone;
}

/// Enough for light and materials to be told apart.
constexpr int kPreviewSamples = 8;

/// Turns texts into `a.options`. Throws InputError.
void parse_options(RenderArguments& a) {
    session::PictureOptions& picture = a.options.picture;
    session::Limits& limits = a.options.limits;
    picture.aovs = parse_aovs(a.aovs);
    picture.part = parse_part(a.part);
    picture.version = WEFT_VERSION;
    picture.kernel = a.isa;
    a.options.observers.profile = a.profile;
    if (!a.time.empty()) limits.seconds = parse_duration(a.time, "--time");
    if (a.preview) {
        if (a.size.empty()) a.size = "50%";
        if (limits.spp == 0) limits.spp = kPreviewSamples;
    }
}

int run(RenderArguments& a) {
    if (std::find(a.aovs.begin(), a.aovs.end(), "list") != a.aovs.end()) {
        fmt::print("{}", aovs_text());
        return kDone;
    }
    if (a.scene.empty()) throw InputError("weft render expects a scene file, found none");
    parse_options(a);
    ProgressLine progress(progress_style(a.progress));
    progress.phase("read");
    a.textures.show_conversion = a.progress != "none" && a.progress != "json";
    io::SceneFile const file =
        io::read_scene_file(a.scene, a.overrides, make_texture_cache(a.textures));
    print_messages(file);
    int const code = run_file(a, file, progress);
    if (a.profile) progress.print_profile();
    return code;
}

} // namespace

namespace {

void add_picture_options(CLI::App& c, RenderArguments& a) {
    c.add_option(
         "-o,--output", a.outputs,
         "Picture to write: .exr, .hdr, .png, .jpg, .tif, or a folder for all that the scene "
         "makes; may be given several times")
        ->type_name("OUT")
        ->take_all();
    c.add_option("--size", a.size, "Size of the picture: WxH in pixels, or P% of the scene's")
        ->type_name("WxH|P%");
    c.add_option("--crop", a.crop, "Render only this region of the picture, in pixels")
        ->type_name("x0,y0,x1,y1");
    c.add_option("--seed", a.options.picture.seed, "Another seed gives other noise");
    c.add_option("--set", a.overrides,
                 "Set a parameter of the scene, for example --set camera.fov=30")
        ->type_name("PATH.PARAM=VALUE")
        ->take_all();
    c.add_option("--aov", a.aovs,
                 "Further pictures of the same samples in the EXR file, for example "
                 "albedo,normal,depth; may be given several times; `list` lists them")
        ->type_name("AOV,...")
        ->take_all();
    c.add_flag("--preview", a.preview,
               "A quick look: half the size and 8 samples per pixel, unless --size and --spp say "
               "otherwise; all materials and lights as they are");
}

void add_limit_options(CLI::App& c, RenderArguments& a) {
    c.add_option("--spp", a.options.limits.spp, "Samples per pixel, instead of the scene's")
        ->check(CLI::Range(1, 1 << 24));
    c.add_option("--noise", a.options.limits.noise,
                 "Render until the estimated relative error is below this everywhere, for example "
                 "0.02; --spp is then the most that a pixel gets (65536 if not said)")
        ->type_name("X")
        ->check(number_within(1e-5, 10));
    c.add_option("--time", a.time,
                 "Render until this time is up, but at least one sample per pixel: 90s, 10m, 2h; "
                 "with --noise and --spp, whichever comes first")
        ->type_name("TIME");
}

void add_machine_options(CLI::App& c, RenderArguments& a) {
    c.add_option("--threads", a.options.threads, "Number of threads; 0 is one per processor")
        ->check(CLI::Range(0, 1024));
    c.add_option("--tile", a.options.tile_size, "Size of a tile in pixels; changes no pixel")
        ->check(CLI::Range(1, 4096));
    c.add_option(
         "--isa", a.isa,
         "Pin the ray kernel's instruction set, so that different machines give the same bits")
        ->check(CLI::IsMember({"sse2", "sse4.2", "avx", "avx2", "avx512"}));
}

void add_part_options(CLI::App& c, PartArguments& a) {
    c.add_option("--shard", a.shard,
                 "Render every N-th tile only, from the K-th; `weft merge` joins the parts")
        ->type_name("K/N");
    c.add_option("--samples", a.samples,
                 "Render these of each pixel's samples only, from A to before B; `weft merge` "
                 "joins the parts")
        ->type_name("A:B");
}

void add_watching_options(CLI::App& c, RenderArguments& a) {
    c.add_option("--progress", a.progress, "How to tell how far it is")
        ->check(CLI::IsMember({"auto", "json", "none"}));
    c.add_option("--watch", a.live.watch,
                 "Write the picture so far to this file every two seconds, for a viewer that "
                 "reloads it")
        ->type_name("OUT.png");
    c.add_option("--tev", a.live.tev, "Show the picture so far in the viewer tev, every second")
        ->type_name("HOST:PORT");
    c.add_flag("--profile", a.profile,
               "Say at the end where the time went: by phase and, while rendering, by feature "
               "(textures, shadow rays, ...)");
}

} // namespace

void add_render_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<RenderArguments>();
    CLI::App* c = app.add_subcommand("render", "Render a scene file");
    c->add_option("scene", a->scene, "The scene file, or a glTF file (.gltf, .glb)")
        ->type_name("SCENE");
    add_picture_options(*c, *a);
    add_limit_options(*c, *a);
    add_machine_options(*c, *a);
    add_checkpoint_options(*c, a->checkpoint);
    add_part_options(*c, a->part);
    add_watching_options(*c, *a);
    add_texture_options(*c, a->textures);
    add_display_options(*c, a->display);
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
