// weft test FILE...: runs lightwave's <test> files.
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/scene_loading.h"
#include "apps/weft/texture_options.h"
#include "image/compare.h"
#include "image/write.h"
#include "session/render.h"

namespace weft::apps {

namespace fs = std::filesystem;

namespace {

/// Renders one test and prints its verdict; whether it passed.
bool run_test(io::RenderJob const& job, session::RenderOptions const& options) {
    auto const path = [&](char const* suffix) {
        return (fs::path(job.folder) / (job.image_name + suffix)).string();
    };
    image::check_writable(path("_test.exr"));
    image::Image const reference = image::read_image(path("_ref.exr"));
    auto const world = commit_world(job);
    session::RenderResult const result = session::render(*world, job, options);
    image::write_exr(path("_test.exr"), result.image);
    image::Difference const d = image::compare(result.image, reference);
    bool const passed = d.mae <= double(job.test->mae) && std::abs(d.me) <= double(job.test->me) &&
                        d.non_finite == 0;
    fmt::print("{}  {:<32} MAE {:.3e} (<= {:.1e})  ME {:+.3e} (<= {:.1e}){}  {:.1f} s\n",
               passed ? "pass" : "FAIL", job.image_name, d.mae, job.test->mae, d.me, job.test->me,
               d.non_finite ? fmt::format("  {} values not finite", d.non_finite) : "",
               result.seconds);
    std::fflush(stdout);
    return passed;
}

int run(std::vector<std::string> const& files, session::RenderOptions const& options,
        TextureArguments const& textures) {
    int passed = 0, failed = 0, broken = 0;
    for (std::string const& name : files) {
        try {
            io::SceneFile const file = io::read_scene_file(name, {}, make_texture_cache(textures));
            int tests = 0;
            for (io::RenderJob const& job : file.jobs)
                if (job.test) {
                    ++tests;
                    ++(run_test(job, options) ? passed : failed);
                }
            if (tests == 0)
                throw InputError(SourceLocation{name, 0, 0}, "expected a <test>, found none");
        } catch (InputError const& e) {
            fmt::print(stderr, "error: {}\n", e.what());
            ++broken;
        }
    }
    fmt::print("{} passed, {} failed\n", passed, failed + broken);
    return broken ? kInputError : failed ? kFailed : kDone;
}

} // namespace

void add_test_command(CLI::App& app, Command& chosen) {
    struct Arguments {
        std::vector<std::string> files;
        session::RenderOptions options;
        TextureArguments textures;
    };
    auto a = std::make_shared<Arguments>();
    CLI::App* c =
        app.add_subcommand("test", "Run the <test>s of scene files against their reference images");
    c->add_option("files", a->files, "Scene files")->required()->type_name("FILE...");
    c->add_option("--threads", a->options.threads, "Number of threads; 0 is one per processor")
        ->check(CLI::Range(0, 1024));
    c->add_option("--seed", a->options.seed, "Another seed gives other noise");
    add_texture_options(*c, a->textures);
    c->callback([a, &chosen] { chosen = [a] { return run(a->files, a->options, a->textures); }; });
}

} // namespace weft::apps
