#include "apps/weft/render_job.h"

#include <filesystem>
#include <fmt/format.h>

#include "apps/weft/commands.h"
#include "apps/weft/interrupt.h"
#include "apps/weft/picture_file.h"
#include "apps/weft/scene_loading.h"
#include "image/atomic_file.h"
#include "image/write.h"
#include "lights/lints.h"
#include "scene/scene_hash.h"
#include "schema/text.h"

namespace weft::apps {

namespace fs = std::filesystem;

namespace {

/// Throws InputError for a part of a picture that cannot be made.
void check_part(RenderArguments const& a, scene::RenderJob const& job) {
    session::Part const& part = a.options.picture.part;
    if (part.is_whole()) return;
    if (a.options.limits.noise > 0 || a.options.limits.seconds > 0)
        throw InputError("--noise and --time look at the whole picture: parts of one (--shard, "
                         "--samples) expect a number of samples");
    uint32_t const limit = session::sample_limit(job, a.options.limits);
    if (part.last > limit)
        throw InputError(fmt::format("--samples expects a part of the {} samples per pixel, found "
                                     "'{}'; --spp says how many there are",
                                     limit, a.part.samples));
}

/// Reads four comma-separated pixel coordinates. Throws InputError.
film::Region parse_crop(std::string const& text) {
    auto const v = schema::read_numbers(text);
    bool whole = v && v->size() == 4;
    if (whole)
        for (double x : *v) whole &= x == std::floor(x) && std::abs(x) < 1e6;
    if (!whole) throw InputError("--crop expects x0,y0,x1,y1 in pixels, found '" + text + "'");
    return {{int((*v)[0]), int((*v)[1])}, {int((*v)[2]), int((*v)[3])}};
}

/// Returns how the name of a part's file ends where the user does not say:
/// ".shard-2-of-4.samples-0-32.weft".
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

/// Throws InputError, or warns, where no file can hold the AOVs that are wanted.
void check_aovs(RenderArguments const& a, JobTask const& task, std::vector<std::string> paths) {
    if (!a.options.picture.part.is_whole()) return;
    bool const wanted =
        !a.options.picture.aovs.empty() || !session::wanted_aovs(task.job.integrator).empty();
    paths.insert(paths.end(), task.later.begin(), task.later.end());
    if (!wanted || std::any_of(paths.begin(), paths.end(), image::is_exr)) return;
    if (!a.options.picture.aovs.empty())
        throw InputError("--aov expects an output that can hold further channels (.exr), found '" +
                         (paths.empty() ? a.outputs.front() : paths.front()) + "'");
    fmt::print(stderr, "warning: the AOVs that the scene asks for are not written: only .exr files "
                       "hold them\n");
}

/// Throws InputError where the checkpoint would take the place of another file, by whatever path.
void check_checkpoint_file(RenderArguments const& a, std::vector<std::string> const& outputs) {
    if (a.checkpoint.file.empty()) return;
    auto const is_it = [&](std::string const& other) {
        return fs::weakly_canonical(other) == fs::weakly_canonical(a.checkpoint.file);
    };
    if (std::any_of(outputs.begin(), outputs.end(), is_it) || is_it(a.scene) ||
        (!a.live.watch.empty() && is_it(a.live.watch)))
        throw InputError("--checkpoint-file expects a file of its own, found '" +
                         a.checkpoint.file + "', which is another of the render's files");
}

void check_arguments(RenderArguments const& a, JobTask const& task,
                     std::vector<std::string> const& paths) {
    check_outputs(paths, a.options.picture.part);
    check_aovs(a, task, paths);
    check_part(a, task.job);
    check_checkpoint_file(a, paths);
    if (!task.is_only && !a.checkpoint.file.empty())
        throw InputError("--checkpoint-file expects a scene with one picture; --checkpoint names a "
                         "file for each");
}

/// A render that is about to begin, and what its files will say of it.
struct Rendering {
    session::Plan const plan;
    uint64_t const scene_hash;
    std::vector<std::string> const paths; ///< of the picture's files
    session::RenderOptions options;

    image::ExrHeader header(session::RenderResult const& result) const {
        return picture_header(result, plan, scene_hash, options.picture.seed);
    }
};

/// Writes a part of a picture to its files.
void write_part(Rendering const& r, session::RenderResult&& result) {
    std::string note = header_text(r.header(result));
    session::RenderState state = session::to_state(std::move(result), r.plan, r.options);
    state.note = std::move(note);
    for (std::string const& path : r.paths) {
        session::save_state(path, state);
        fmt::print("{}\n", path);
    }
}

/// Returns why the render leaves no file, or "".
std::string why_unwritten(Rendering const& r, session::RenderResult const& result) {
    bool const whole = r.options.picture.part.is_whole();
    if (!result.cancelled) return "";
    if (!whole) return "stopped before the part was done: no file is overwritten";
    if (result.least_samples == 0)
        return "stopped before every pixel had a sample: no file is overwritten";
    if (r.paths.empty()) return "stopped before the postprocesses: no file is written";
    return "";
}

/// Writes what there is and says what was reached.
JobResult finish(Rendering const& r, post::DisplayChain const& chain,
                 session::RenderResult&& result, ProgressLine& progress) {
    report_bad_samples(result.bad_samples, result.first_bad_samples,
                       std::to_string(r.options.picture.seed));
    if (result.lost_samples > 0)
        fmt::print(stderr,
                   "warning: {} samples were inside of more than {} closed objects at once; what "
                   "the innermost of them do to light is left out there\n",
                   result.lost_samples, media::MediumStack::kMostObjects);
    if (std::string const why = why_unwritten(r, result); !why.empty()) {
        fmt::print(stderr, "{}\n", why);
        return {kInterrupted, {}};
    }
    JobResult made{result.cancelled ? kInterrupted : kDone, {}};
    bool const whole = r.options.picture.part.is_whole();
    progress.phase("write");
    if (whole) {
        made.picture = {result.film.image(), r.header(result), {}};
        write_pictures(r.paths, made.picture, chain);
    }
    print_summary(result, r.plan, r.options);
    progress.done(result);
    if (!whole) write_part(r, std::move(result));
    return made;
}

/// Renders, keeping a checkpoint and showing views where the user asked for them.
JobResult run_rendering(RenderArguments const& a, JobTask const& task, Rendering r,
                        std::string const& name, ProgressLine& progress) {
    GracefulInterrupt const interrupt;
    r.options.limits.cancel = &interrupt.flag();
    r.options.observers.on_progress = [&](session::Progress const& p) { progress.print(p); };
    std::optional<Checkpoint> checkpoint;
    if (a.checkpoint.wanted()) {
        checkpoint.emplace(a.checkpoint, name, session::starting_state(r.plan, r.options));
        r.options.resume = checkpoint->found();
        r.options.observers.watchers.push_back(checkpoint->watcher());
    }
    LiveViews views(a.live, task.chain, name);
    views.watch(r.options.observers.watchers);
    progress.phase("render");
    session::RenderResult result = session::render(r.plan, r.options);
    if (result.cancelled) progress.stop();
    progress.add_profile(result.profile);
    views.show(result.film);
    if (std::string const failure = task.textures.failure(); !failure.empty())
        fmt::print(stderr, "warning: a texture was lost during the render: {}\n", failure);
    if (checkpoint && result.cancelled) {
        session::RenderResult copy = result;
        checkpoint->save(session::to_state(std::move(copy), r.plan, r.options));
        fmt::print(stderr, "{} keeps what is done: the same command goes on from there\n",
                   checkpoint->path());
    }
    JobResult made = finish(r, task.chain, std::move(result), progress);
    if (checkpoint && made.code == kDone) checkpoint->remove();
    return made;
}

} // namespace

session::Part parse_part(PartArguments const& texts) {
    auto const& [shard, samples] = texts;
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
        part_extension(a.options.picture.part);
    if (a.outputs.empty()) return {(fs::path(picture.folder) / name).string()};
    std::vector<std::string> paths;
    for (std::string const& output : a.outputs)
        if (fs::is_directory(output))
            paths.push_back((fs::path(output) / name).string());
        else if (final)
            paths.push_back(output);
    return paths;
}

JobResult render_job(RenderArguments const& a, JobTask const& task, ProgressLine& progress) {
    scene::RenderJob const& job = task.job;
    auto paths = output_paths(a, {job.image_name, job.folder, {}, {}}, task.is_final);
    // What stands beside a picture is named after it, written or not.
    std::string const name = paths.empty() ? a.outputs.front() : paths.front();
    check_arguments(a, task, paths);
    progress.phase("commit");
    auto const stage = commit_stage(job, a.isa, a.size);
    for (std::string const& lint : lights::lint_warnings(*stage, job.integrator, job.where))
        fmt::print(stderr, "warning: {}\n", lint);
    session::RenderOptions options = a.options;
    if (!a.crop.empty()) options.picture.crop = parse_crop(a.crop);
    session::Plan plan = session::make_plan(*stage, job, options);
    uint64_t const scene_hash = scene::scene_hash(*job.scene);
    options.identity = session::identify(plan, options, scene_hash);
    return run_rendering(a, task, {std::move(plan), scene_hash, std::move(paths), options}, name,
                         progress);
}

} // namespace weft::apps
