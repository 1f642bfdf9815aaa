// weft info SCENE: what is in it, and what looks like a mistake.
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/scene_loading.h"
#include "apps/weft/texture_options.h"
#include "lights/lints.h"
#include "session/render.h"

namespace weft::apps {

namespace {

struct InfoArguments {
    std::string scene;
    TextureArguments textures;
};

void print_textures(image::TextureStatistics const& s) {
    fmt::print("textures: {} in memory, {:.1f} MB", s.in_memory, double(s.memory_bytes) / 1e6);
    if (s.in_tiles > 0)
        fmt::print("; {} in tiles, {:.1f} MB of which at most {:.1f} MB at a time", s.in_tiles,
                   double(s.tile_bytes) / 1e6, double(s.tile_limit) / 1e6);
    fmt::print("\n");
}

int run(InfoArguments const& args) {
    io::SceneFile const file =
        io::read_scene_file(args.scene, {}, make_texture_cache(args.textures));
    for (scene::RenderJob const& job : file.jobs) {
        auto const stage = lights::Stage::commit(job.scene);
        world::WorldStatistics const& s = stage->world().statistics();
        Vec2i const size = stage->world().camera().size();
        fmt::print("{}: {} at {} x {}, {} samples per pixel\n", to_string(job.where),
                   match(job.integrator, [](auto const& i) { return i.info.type; }), size.x, size.y,
                   session::sample_count(job.sampler));
        fmt::print("  objects    {}\n  triangles  {} ({} stored)\n  lights     {}\n  textures   {} "
                   "images\n  memory     {:.1f} MB of geometry and of textures in memory\n",
                   s.objects, s.triangles, s.unique_triangles, stage->lights().size(),
                   job.scene->images.size(),
                   double(s.memory_bytes + stage->lights().memory_bytes()) / 1e6);
        for (std::string const& warning : lights::lint_warnings(*stage, job.integrator, job.where))
            fmt::print("  warning: {}\n", warning);
    }
    print_textures(file.textures->statistics());
    for (std::string const& warning : file.warnings) fmt::print("warning: {}\n", warning);
    for (std::string const& note : file.notes) fmt::print("note: {}\n", note);
    return kDone;
}

} // namespace

void add_info_command(CLI::App& app, Command& chosen) {
    auto args = std::make_shared<InfoArguments>();
    CLI::App* c =
        app.add_subcommand("info", "Tell what a scene holds, and what looks like a mistake");
    c->add_option("scene", args->scene, "The scene file, or a glTF file")
        ->required()
        ->type_name("SCENE");
    add_texture_options(*c, args->textures);
    c->callback([args, &chosen] { chosen = [args] { return run(*args); }; });
}

} // namespace weft::apps
