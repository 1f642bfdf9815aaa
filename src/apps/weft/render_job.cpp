#include "apps/weft/render_job.h"

#include <filesystem>
#include <fmt/format.h>

#include "apps/weft/commands.h"
#include "apps/weft/interrupt.h"
#include "apps/weft/live_view.h"
#include "apps/weft/picture_file.h"
#include "apps/weft/scene_loading.h"
#include "image/atomic_file.h"
#include "image/write.h"
#include "lights/lints.h"

namespace weft::apps {

namespace fs = std::filesystem;

namespace {

/// What cannot be had together.
void check_part(RenderArguments const& a, scene::RenderJob const& job) {
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
void check_aovs(RenderArguments const& a, scene::RenderJob const& job,
                std::vector<std::string> const& paths) {
    if (!a.options.part.is_whole()) return;
    bool const wanted = !a.options.aovs.empty() || !session::wanted_aovs(job.integrator).empty();
    if (!wanted || std::any_of(paths.begin(), paths.end(), image::is_exr)) return;
    if (!a.options.aovs.empty())
        throw InputError("--aov expects an output that can hold further channels (.exr), found " +
                         (paths.empty() ? "'" + a.outputs.front() +
                                              "' for the picture of a postprocess, which has none"
                                        : "'" + paths.front() + "'"));
    fmt::print(stderr, "warning: the AOVs that the scene asks for are not written: only .exr files "
                       "hold them\n");
}

/// Files that would take each other's place. `fs::weakly_canonical` knows them by whatever path.
void check_checkpoint_file(RenderArguments const& a, std::vector<std::string> const& outputs) {
    if (a.checkpoint.file.empty()) return;
    auto const is_it = [&](std::string const& other) {
        return fs::weakly_canonical(other) == fs::weakly_canonical(a.checkpoint.file);
    };
    if (std::any_of(outputs.begin(), outputs.end(), is_it) || is_it(a.scene) ||
        (!a.watch.empty() && is_it(a.watch)))
        throw InputError("--checkpoint-file expects a file of its own, found '" +
                         a.checkpoint.file + "', which is another of the render's files");
}

void write_part(std::vector<std::string> const& paths, session::RenderResult&& result,
                lights::Stage const& stage, scene::RenderJob const& job,
                session::RenderOptions const& options) {
    std::string note = header_text(picture_header(result, job, stage.world(), options.seed));
    session::RenderState state = session::to_state(std::move(result), stage, job, options);
    state.note = std::move(note);
    for (std::string const& path : paths) {
        session::save_state(path, state);
        fmt::print("{}\n", path);
    }
}

/// Writes what there is, says what was reached, and returns the exit code; `made` becomes the
/// picture.
int finish(session::RenderOptions const& options, std::vector<std::string> const& paths,
           scene::RenderJob const& job, lights::Stage const& stage, post::DisplayChain const& chain,
           ProgressLine& progress, session::RenderResult&& result, post::Picture& made) {
    report_bad_samples(result.bad_samples, result.first_bad_samples, std::to_string(options.seed));
    bool const whole = options.part.is_whole();
    if (result.cancelled && (!whole || result.least_samples == 0)) {
        fmt::print(stderr, "stopped before {}: no file is overwritten\n",
                   whole ? "every pixel had a sample" : "the part was done");
        return kInterrupted;
    }
    if (result.cancelled && paths.empty()) {
        fmt::print(stderr, "stopped before the postprocesses: no file is written\n");
        return kInterrupted;
    }
    progress.phase("write");
    if (whole) {
        image::ExrHeader const header = picture_header(result, job, stage.world(), options.seed);
        write_films(paths, result.film, header, chain);
        made.metadata = plain_texts(header);
    }
    print_summary(result, options);
    progress.done(result);
    made.image = std::move(result.image);
    bool const cancelled = result.cancelled;
    if (!whole) write_part(paths, std::move(result), stage, job, options);
    return cancelled ? kInterrupted : kDone;
}

} // namespace

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

std::vector<std::string> output_paths(RenderArguments const& a, scene::PictureName const& picture,
                                      bool final) {
    std::string const name =
        (picture.name.empty() ? fs::path(a.scene).stem().string() : picture.name) +
        part_extension(a.options.part);
    if (a.outputs.empty()) return {(fs::path(picture.folder) / name).string()};
    std::vector<std::string> paths;
    for (std::string const& output : a.outputs)
        if (fs::is_directory(output))
            paths.push_back((fs::path(output) / name).string());
        else if (final)
            paths.push_back(output);
    return paths;
}

int render_job(RenderArguments const& a, scene::RenderJob const& job, bool final, bool only_picture,
               image::TextureCache const& textures, post::DisplayChain const& chain,
               ProgressLine& progress, post::Picture& made) {
    auto const paths = output_paths(a, {job.image_name, job.folder, {}, {}}, final);
    // What stands beside a picture is named after it, written or not.
    std::string const& main_path = paths.empty() ? a.outputs.front() : paths.front();
    check_outputs(paths, a.options.part);
    check_aovs(a, job, paths);
    check_part(a, job);
    check_checkpoint_file(a, paths);
    progress.phase("commit");
    auto const stage = commit_stage(job, a.isa, a.size);
    for (std::string const& lint : lights::lint_warnings(*stage, job.integrator, job.where))
        fmt::print(stderr, "warning: {}\n", lint);

    session::RenderOptions options = a.options;
    options.on_progress = [&](session::Progress const& p) { progress.print(p); };
    if (!a.crop.empty()) options.crop = parse_crop(a.crop);
    GracefulInterrupt const interrupt;
    options.cancel = &interrupt.flag();
    std::optional<Checkpoint> checkpoint;
    if (a.checkpoint.wanted()) {
        if (!only_picture && !a.checkpoint.file.empty())
            throw InputError("--checkpoint-file expects a scene with one picture; --checkpoint "
                             "names a file for each");
        checkpoint.emplace(a.checkpoint, main_path, session::starting_state(*stage, job, options));
        options.resume = checkpoint->found();
        options.watchers.push_back(checkpoint->watcher());
    }
    std::optional<WatchedPicture> watched;
    if (!a.watch.empty()) {
        watched.emplace(a.watch, chain);
        options.watchers.push_back(watched->watcher());
    }
    std::optional<TevClient> tev;
    if (!a.tev.empty()) {
        tev.emplace(a.tev, main_path);
        options.watchers.push_back(tev->watcher());
    }
    progress.phase("render");
    session::RenderResult result = session::render(*stage, job, options);
    if (result.cancelled) progress.stop();
    progress.add_profile(result.profile);
    if (tev) tev->show(result.film);
    if (watched) watched->show(result.image);
    if (std::string const failure = textures.failure(); !failure.empty())
        fmt::print(stderr, "warning: a texture was lost during the render: {}\n", failure);
    if (checkpoint && result.cancelled) {
        session::RenderResult copy = result;
        checkpoint->save(session::to_state(std::move(copy), *stage, job, options));
        fmt::print(stderr, "{} keeps what is done: the same command goes on from there\n",
                   checkpoint->path());
    }
    int const code = finish(options, paths, job, *stage, chain, progress, std::move(result), made);
    if (checkpoint && code == kDone) checkpoint->remove();
    return code;
}

} // namespace weft::apps
