// weft test FILE...: runs lightwave's <test> files, and compares pictures of postprocesses with
// their references, NAME_ref.exr, where there are such.
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/scene_loading.h"
#include "apps/weft/texture_options.h"
#include "image/compare.h"
#include "image/write.h"
#include "post/run.h"
#include "session/render.h"

namespace weft::apps {

namespace fs = std::filesystem;

namespace {

/// NAME_test.exr or NAME_ref.exr beside the scene.
std::string path_of(std::string const& folder, std::string const& name, char const* suffix) {
    return (fs::path(folder) / (name + suffix)).string();
}

/// How many tests of a file came out in which way.
struct Tally {
    int passed = 0, failed = 0;
};

/// Writes the picture of a test, compares it and prints the verdict.
void judge(std::string const& folder, std::string const& name, image::Image const& picture,
           scene::ImageTest const& limits, double seconds, Tally& tally) {
    image::Image const reference = image::read_image(path_of(folder, name, "_ref.exr"));
    image::write_exr(path_of(folder, name, "_test.exr"), picture);
    image::Difference const d = image::compare(picture, reference);
    bool const passed =
        d.mae <= double(limits.mae) && std::abs(d.me) <= double(limits.me) && d.non_finite == 0;
    fmt::print("{}  {:<32} MAE {:.3e} (<= {:.1e})  ME {:+.3e} (<= {:.1e}){}  {:.1f} s\n",
               passed ? "pass" : "FAIL", name, d.mae, limits.mae, d.me, limits.me,
               d.non_finite ? fmt::format("  {} values not finite", d.non_finite) : "", seconds);
    std::fflush(stdout);
    ++(passed ? tally.passed : tally.failed);
}

void run_test(scene::RenderJob const& job, session::RenderOptions const& options, Tally& tally) {
    image::check_writable(path_of(job.folder, job.image_name, "_test.exr"));
    image::read_image(path_of(job.folder, job.image_name, "_ref.exr"));
    auto const stage = commit_stage(job);
    session::RenderResult const result = session::render(*stage, job, options);
    judge(job.folder, job.image_name, result.image, *job.test, result.seconds, tally);
}

/// Whether the picture of a postprocess has a reference, and so is a test.
bool is_tested(scene::PictureName const& picture) {
    return fs::exists(path_of(picture.folder, picture.name, "_ref.exr"));
}

/// Runs the file's integrators and postprocesses, and judges the pictures that have a reference.
void run_postprocess_tests(io::SceneFile const& file, session::RenderOptions const& options,
                           Tally& tally) {
    post::Pictures pictures;
    auto next = file.postprocesses.begin();
    double seconds = 0;
    for (size_t i = 0; i < file.jobs.size(); ++i) {
        scene::RenderJob const& job = file.jobs[i];
        if (!job.test) {
            auto const stage = commit_stage(job);
            session::RenderResult result = session::render(*stage, job, options);
            seconds += result.seconds;
            pictures[job.target.image.index].image = std::move(result.image);
        }
        for (; next != file.postprocesses.end() && next->jobs_before == i + 1; ++next) {
            int32_t const output = scene::pictures_of(next->postprocess).output.index;
            scene::PictureName const& name = file.pictures[size_t(output)];
            pictures[output] = post::run(*next, pictures);
            if (is_tested(name))
                judge(name.folder, name.name, pictures[output].image, {}, seconds, tally);
        }
    }
}

/// Throws InputError where the file has no test, too.
void run_file(io::SceneFile const& file, std::string const& name,
              session::RenderOptions const& options, Tally& tally) {
    int tests = 0;
    for (scene::RenderJob const& job : file.jobs)
        if (job.test) {
            ++tests;
            run_test(job, options, tally);
        }
    std::string references;
    bool tested = false;
    for (scene::PostprocessJob const& job : file.postprocesses) {
        scene::PictureName const& picture =
            file.pictures[size_t(scene::pictures_of(job.postprocess).output.index)];
        tested |= is_tested(picture);
        references += " or " + path_of(picture.folder, picture.name, "_ref.exr");
    }
    if (tested) run_postprocess_tests(file, options, tally);
    if (tests == 0 && !tested)
        throw InputError(SourceLocation{name, 0, 0},
                         "expected a <test>" + references + ", found none");
}

int run(std::vector<std::string> const& files, session::RenderOptions const& options,
        TextureArguments const& textures) {
    Tally tally;
    int broken = 0;
    auto const cannot_run = [&](std::exception const& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        ++broken;
    };
    for (std::string const& name : files) {
        try {
            run_file(io::read_scene_file(name, {}, make_texture_cache(textures)), name, options,
                     tally);
        } catch (InputError const& e) {
            cannot_run(e);
        } catch (image::IoError const& e) {
            cannot_run(e);
        }
    }
    fmt::print("{} passed, {} failed\n", tally.passed, tally.failed + broken);
    return broken ? kInputError : tally.failed ? kFailed : kDone;
}

} // namespace

void add_test_command(CLI::App& app, Command& chosen) {
    struct TestArguments {
        std::vector<std::string> files;
        session::RenderOptions options;
        TextureArguments textures;
    };
    auto a = std::make_shared<TestArguments>();
    CLI::App* c =
        app.add_subcommand("test", "Run the <test>s of scene files against their reference images");
    c->add_option("files", a->files, "Scene files")->required()->type_name("FILE...");
    c->add_option("--threads", a->options.threads, "Number of threads; 0 is one per processor")
        ->check(CLI::Range(0, 1024));
    c->add_option("--seed", a->options.picture.seed, "Another seed gives other noise");
    add_texture_options(*c, a->textures);
    c->callback([a, &chosen] { chosen = [a] { return run(a->files, a->options, a->textures); }; });
}

} // namespace weft::apps
