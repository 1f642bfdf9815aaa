// weft replay SCENE --pixel x,y --sample n: one path again, told vertex by vertex.
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/scene_loading.h"
#include "apps/weft/texture_options.h"
#include "schema/text.h"
#include "session/replay.h"

namespace weft::apps {

namespace {

struct ReplayArguments {
    std::string scene, pixel, size, isa;
    std::vector<std::string> overrides;
    int sample = 0;
    TextureArguments textures;
    session::ReplayOptions options;
};

Vec2i parse_pixel(std::string const& text) {
    auto const v = schema::read_numbers(text);
    bool whole = v && v->size() == 2;
    if (whole)
        for (double x : *v) whole &= x == std::floor(x) && std::abs(x) < 1e6;
    if (!whole) throw InputError("--pixel expects x,y, found '" + text + "'");
    return {int((*v)[0]), int((*v)[1])};
}

int run(ReplayArguments& a) {
    a.options.pixel = parse_pixel(a.pixel);
    a.options.sample = uint32_t(a.sample);
    io::SceneFile const file =
        io::read_scene_file(a.scene, a.overrides, make_texture_cache(a.textures));
    for (scene::RenderJob const& job : file.jobs) {
        auto const stage = commit_stage(job, a.isa, a.size);
        session::Replay const replay = session::replay(*stage, job, a.options);
        if (file.jobs.size() > 1) fmt::print("{}\n", job.image_name);
        fmt::print("{}", session::replay_text(*stage, replay));
    }
    return kDone;
}

} // namespace

void add_replay_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<ReplayArguments>();
    CLI::App* c = app.add_subcommand(
        "replay", "Trace one sample of one pixel again and tell what its path met");
    c->add_option("scene", a->scene, "The scene file")->required()->type_name("SCENE");
    c->add_option("--pixel", a->pixel,
                  "The pixel, counted from the upper left corner of the whole "
                  "picture")
        ->required()
        ->type_name("x,y");
    c->add_option("--sample", a->sample, "The number of the sample, from 0")
        ->check(CLI::Range(0, 1 << 24));
    c->add_option("--seed", a->options.seed, "The seed of the render");
    c->add_option("--spp", a->options.spp,
                  "Samples per pixel of the render, where that was not the scene's")
        ->check(CLI::Range(1, 1 << 24));
    c->add_option("--size", a->size, "Size of the picture, as of the render")->type_name("WxH|P%");
    c->add_option("--set", a->overrides, "Parameters of the scene, as of the render")
        ->type_name("PATH.PARAM=VALUE")
        ->take_all();
    c->add_option("--isa", a->isa, "The ray kernel's instruction set, as of the render")
        ->check(CLI::IsMember({"sse2", "sse4.2", "avx", "avx2", "avx512"}));
    add_texture_options(*c, a->textures);
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
