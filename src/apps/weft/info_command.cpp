// weft info SCENE: what is in it, and what looks like a mistake.
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/scene_loading.h"
#include "session/render.h"

namespace weft::apps {

namespace {

int run(std::string const& path) {
    io::SceneFile const file = io::read_scene_file(path);
    for (io::RenderJob const& job : file.jobs) {
        auto const world = world::World::commit(job.scene);
        world::WorldStatistics const& s = world->statistics();
        Vec2i const size = world->camera().size();
        fmt::print("{}: {} at {} x {}, {} samples per pixel\n", to_string(job.where),
                   match(job.integrator, [](auto const& i) { return i.info.type; }), size.x, size.y,
                   session::sample_count(job.sampler));
        fmt::print("  objects    {}\n  triangles  {} ({} stored)\n  lights     {}\n  textures   {} "
                   "images\n  memory     {:.1f} MB of geometry and textures\n",
                   s.objects, s.triangles, s.unique_triangles, s.lights, job.scene->images.size(),
                   double(s.memory_bytes) / 1e6);
        for (std::string const& warning : lint_warnings(*world))
            fmt::print("  warning: {}\n", warning);
    }
    for (std::string const& warning : file.warnings) fmt::print("warning: {}\n", warning);
    return kDone;
}

} // namespace

void add_info_command(CLI::App& app, Command& chosen) {
    auto scene = std::make_shared<std::string>();
    CLI::App* c =
        app.add_subcommand("info", "Tell what a scene holds, and what looks like a mistake");
    c->add_option("scene", *scene, "The scene file")->required()->type_name("SCENE");
    c->callback([scene, &chosen] { chosen = [scene] { return run(*scene); }; });
}

} // namespace weft::apps
