#include "session/replay.h"

#include <fmt/format.h>

#include "integrator/pixel_renderer.h"
#include "session/scene_tags.h"

namespace weft::session {

namespace {

using film::PathEvent;

std::string text(Vec3 const& v) { return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z); }
/// A position, in the scene as it was given.
std::string place_text(world::World const& world, Vec3 const& p) {
    if (world.origin() == Vec3d(0, 0, 0)) return text(p);
    Vec3d const at = Vec3d(p) + world.origin();
    return fmt::format("({:.10g}, {:.10g}, {:.10g})", at.x, at.y, at.z);
}
std::string text(Color const& c) { return fmt::format("{:g} {:g} {:g}", c.r, c.g, c.b); }

std::string light_text(lights::Stage const& stage, PathEvent const& e) {
    world::World const& world = stage.world();
    int32_t object = e.object;
    for (uint32_t i = 0; object < 0 && e.light >= 0 && i < world.object_count(); ++i)
        if (stage.lights().of_object(i) == e.light) object = int32_t(i);
    std::string const group = e.light >= 0 ? stage.lights().info(e.light).controls.group : "";
    return (e.light >= 0 ? fmt::format("light {}", e.light) : "an emission that is no light") +
           (object >= 0 ? " on '" + object_name(world, uint32_t(object)) + "'" : "") +
           (group.empty() ? "" : " of the group '" + group + "'");
}

std::string event_text(lights::Stage const& stage, PathEvent const& e, int& vertex) {
    world::World const& world = stage.world();
    switch (e.kind) {
    case PathEvent::Kind::Camera:
        return fmt::format("camera at {} towards {}\n", place_text(world, e.p), text(e.direction));
    case PathEvent::Kind::Surface: {
        std::string const material = material_name(world, uint32_t(e.object));
        return fmt::format("{} surface of '{}', {}, at {}, normal {}\n  throughput {}\n", ++vertex,
                           object_name(world, uint32_t(e.object)),
                           material.empty() ? "no material" : "material '" + material + "'",
                           place_text(world, e.p), text(e.direction), text(e.value));
    }
    case PathEvent::Kind::Medium:
        return fmt::format("{} scattering in a medium at {}\n  throughput {}\n", ++vertex,
                           place_text(world, e.p), text(e.value));
    case PathEvent::Kind::Bounce:
        return fmt::format("  goes on by {} towards {}: times {}, {} {:g}\n", text_of(e.scattering),
                           text(e.direction), text(e.value),
                           is_delta(e.scattering.kind) ? "probability" : "density", e.pdf);
    case PathEvent::Kind::Straight:
        return fmt::format("  goes straight on: times {}\n", text(e.value));
    case PathEvent::Kind::Background:
        return fmt::format("{} background towards {}\n  throughput {}\n", ++vertex,
                           text(e.direction), text(e.value));
    case PathEvent::Kind::Light:
        return fmt::format("  + {} from {}, {}, over {} bounces\n", text(e.value),
                           light_text(stage, e), e.sampled ? "sampled" : "met by the ray",
                           e.bounces);
    }
    return "";
}

} // namespace

Replay replay(lights::Stage const& stage, scene::RenderJob const& job,
              ReplayOptions const& options) {
    Vec2i const size = stage.world().camera().size(), p = options.pixel;
    if (p.x < 0 || p.y < 0 || p.x >= size.x || p.y >= size.y)
        throw InputError(fmt::format("--pixel expects a pixel inside of the picture of {} x {}, "
                                     "found {},{}",
                                     size.x, size.y, p.x, p.y));
    integrator::PixelRenderer const renderer(stage, job.integrator, job.sampler, options.seed,
                                             options.spp);
    if (!renderer.follows_light())
        throw InputError(job.where,
                         "expected an integrator that follows light to replay a path of");
    film::Layout const layout;
    film::SceneTags const tags;
    film::SampleRecord record(layout, tags);
    Replay result;
    record.keep_log(&result.events);
    result.value = renderer.sample(p, options.sample, &record);
    return result;
}

std::string replay_text(lights::Stage const& stage, Replay const& replay) {
    std::string all;
    int vertex = 0;
    for (PathEvent const& e : replay.events) all += event_text(stage, e, vertex);
    char const* const verdict = !is_finite(replay.value)          ? " (not finite)"
                                : min_component(replay.value) < 0 ? " (negative)"
                                                                  : "";
    return all + "= " + text(replay.value) + verdict + "\n";
}

} // namespace weft::session
