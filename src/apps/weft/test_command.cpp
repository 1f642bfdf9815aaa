// weft test FILE...: runs lightwave's <test> files, and compares pictures of postprocesses with
// their references, NAME_ref.exr, where there are such.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "apps/weft/commands.h"
#include "apps/weft/picture_file.h"
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

/// How many tests came out in which way.
struct Tally {
    int passed = 0, failed = 0, broken = 0;

    /// Runs a test. What keeps it from being run is told, and counts; the next one goes on.
    template <class Run>
    void attempt(Run const& run) {
        try {
            run();
        } catch (InputError const& e) {
            tell(e);
        } catch (image::IoError const& e) {
            tell(e);
        }
    }
    void tell(std::exception const& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        ++broken;
    }
};

bool has_negative(image::Image const& picture) {
    return std::any_of(picture.pixels.begin(), picture.pixels.end(), [](float v) { return v < 0; });
}

/// Writes the picture of a test, compares it and prints the verdict.
void judge(std::string const& folder, std::string const& name, image::Image const& picture,
           scene::ImageTest const& limits, double seconds, Tally& tally) {
    image::Image const reference = read_picture(path_of(folder, name, "_ref.exr"));
    image::write_exr(path_of(folder, name, "_test.exr"), picture);
    image::Difference const d = image::compare(picture, reference);
    bool const negative = !limits.allow_negative && has_negative(picture);
    bool const passed = d.mae <= double(limits.mae) && std::abs(d.me) <= double(limits.me) &&
                        d.non_finite == 0 && !negative;
    fmt::print("{}  {:<32} MAE {:.3e} (<= {:.1e})  ME {:+.3e} (<= {:.1e}){}{}  {:.1f} s\n",
               passed ? "pass" : "FAIL", name, d.mae, limits.mae, d.me, limits.me,
               d.non_finite ? fmt::format("  {} values not finite", d.non_finite) : "",
               negative ? "  negative values" : "", seconds);
    std::fflush(stdout);
    ++(passed ? tally.passed : tally.failed);
}

/// Throws where a test's picture cannot be written or its reference cannot be read.
void check_files(std::string const& folder, std::string const& name) {
    image::check_writable(path_of(folder, name, "_test.exr"));
    read_picture(path_of(folder, name, "_ref.exr"));
}

void run_test(scene::RenderJob const& job, session::RenderOptions const& options, Tally& tally) {
    check_files(job.folder, job.image_name);
    auto const stage = commit_stage(job);
    session::RenderResult const result = session::render(*stage, job, options);
    judge(job.folder, job.image_name, result.image, *job.test, result.seconds, tally);
}

/// A postprocess that is a test: of itself, or because there is a reference for its picture.
struct PostprocessTest {
    std::string folder, name;
    scene::ImageTest limits;
};

std::optional<PostprocessTest> test_of(io::SceneFile const& file,
                                       scene::PostprocessJob const& job) {
    scene::PictureName const& picture =
        file.pictures[size_t(scene::pictures_of(job.postprocess).output.index)];
    if (job.test) return PostprocessTest{picture.folder, job.test_name, *job.test};
    if (!fs::exists(path_of(picture.folder, picture.name, "_ref.exr"))) return {};
    return PostprocessTest{picture.folder, picture.name, {}};
}

/// Runs the file's integrators and postprocesses, and judges the pictures that are tests.
void run_postprocess_tests(io::SceneFile const& file, session::RenderOptions const& options,
                           Tally& tally) {
    post::Pictures pictures;
    auto next = file.postprocesses.begin();
    double seconds = 0;
    auto const process = [&](scene::PostprocessJob const& job) {
        auto const test = test_of(file, job);
        if (test) check_files(test->folder, test->name);
        auto const ids = scene::pictures_of(job.postprocess);
        read_picture_files(file, job, pictures);
        for (auto const& [name, id] : ids.inputs)
            if (!pictures.contains(id.index))
                throw InputError(job.where,
                                 "'" + std::string(name) + "' is a picture that could not be made");
        pictures[ids.output.index] = post::run(job, pictures);
        if (test)
            judge(test->folder, test->name, pictures[ids.output.index].image, test->limits, seconds,
                  tally);
    };
    for (size_t i = 0; i <= file.jobs.size(); ++i) {
        for (; next != file.postprocesses.end() && next->jobs_before == i; ++next)
            tally.attempt([&] { process(*next); });
        if (i == file.jobs.size() || file.jobs[i].test) continue;
        tally.attempt([&] {
            scene::RenderJob const& job = file.jobs[i];
            auto const stage = commit_stage(job);
            session::RenderResult result = session::render(*stage, job, options);
            seconds += result.seconds;
            pictures[job.target.image.index].image = std::move(result.image);
        });
    }
}

/// Throws InputError where the file has no test.
void run_file(io::SceneFile const& file, std::string const& name,
              session::RenderOptions const& options, Tally& tally) {
    int tests = 0;
    for (scene::RenderJob const& job : file.jobs)
        if (job.test) {
            ++tests;
            tally.attempt([&] { run_test(job, options, tally); });
        }
    std::string references;
    bool tested = false;
    for (scene::PostprocessJob const& job : file.postprocesses) {
        scene::PictureName const& picture =
            file.pictures[size_t(scene::pictures_of(job.postprocess).output.index)];
        tested |= test_of(file, job).has_value();
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
    for (std::string const& name : files)
        tally.attempt([&] {
            io::SceneFile const file = io::read_scene_file(name, {}, make_texture_cache(textures));
            print_messages(file);
            run_file(file, name, options, tally);
        });
    fmt::print("{} passed, {} failed\n", tally.passed, tally.failed + tally.broken);
    return tally.broken ? kInputError : tally.failed ? kFailed : kDone;
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
