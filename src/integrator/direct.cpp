#include "integrator/direct.h"

#include "integrator/controls.h"
#include "integrator/media_walk.h"
#include "integrator/record.h"

namespace weft::integrator {

namespace {

/// A vertex and what a light sends to it.
struct Connection {
    Vertex const& here;
    lights::LightSample const& light;
    lights::LightRules const* rules; ///< the light's controls; null: all of it counts
    uint32_t bounces;                ///< of the light on its way to the camera, `here` included
    bool alone;                      ///< no ray finds the light
    bool combine;                    ///< what rays find of the light is weighed against it
    bool through;                    ///< it comes from the other side of the surface
};

Connection connect(Tracer const& t, PathState const& path, Vertex const& here,
                   lights::LightSample const& light) {
    lights::LightRules const* const rules = rules_of(t, light.light);
    bool const alone = light.delta || (rules && rules->sampling_alone);
    return {here,
            light,
            rules,
            path.bounces() + 1,
            alone,
            t.settings.strategy == scene::Strategy::mis && !alone,
            here.is_through(light.wi)};
}

/// Returns the part of the light that `value` sends on along the path, and that counts.
Color counted(Connection const& c, lobes::LobeValue const& value, ScatteringKind kind) {
    float const weight = c.combine ? power_heuristic(c.light.pdf, value.pdf) : 1;
    if (!c.rules) return value.f * weight;
    return value.f * (weight * c.rules->factor({c.here.at.p, c.here.sets, c.bounces,
                                                ray_kind({kind, c.through}), c.light.distance}));
}

/// What each part of the vertex sends on along the path, of light of radiance 1.
struct Scattered {
    std::span<ScatteringKind const> kinds; ///< of the parts
    std::array<Color, kParts.size()> values{};

    Color sum() const {
        Color all = values[0];
        for (size_t i = 1; i < kinds.size(); ++i) all += values[i];
        return all;
    }
};

Scattered scattered(Tracer const& t, PathState const& path, Connection const& c) {
    Scattered s{c.here.parts(t.settings.by_part)};
    if (s.kinds.size() == 1) {
        s.values[0] = counted(c, c.here.eval(c.light.wi), s.kinds[0]);
        return s;
    }
    for (size_t i = 0; i < s.kinds.size(); ++i) {
        ScatteringKind const kind = s.kinds[i];
        bool const makes_caustic = path.diffused && !is_diffuse(kind);
        if (makes_caustic && !t.settings.caustics) continue;
        s.values[i] = counted(c, c.here.eval_part(c.light.wi, kind), kind);
    }
    return s;
}

/// Returns whether a surface light lies inside of something that hides it from a ray that ends
/// there within `media`.
bool is_hidden(Tracer const& t, int32_t object, media::MediumStack const& media) {
    if (object < 0 || !t.world.object(uint32_t(object)).may_be_hidden) return false;
    return !media.is_visible(uint32_t(object), t.world.object(uint32_t(object)).rank);
}

/// Returns the shadow ray of a connection: from the offset origin to just before the light, whose
/// own offset was added to the vertex. Its t_max is not positive where the light is out of reach.
world::Ray shadow_ray(PathState const& path, Connection const& c, world::RayMask blockers) {
    lights::LightSample const& light = c.light;
    world::Ray shadow;
    shadow.origin = c.here.origin(light.wi);
    shadow.direction = light.wi;
    shadow.time = path.ray.time;
    shadow.mask = blockers;
    shadow.t_max = c.here.reach;
    if (light.distance == kInfinity) return shadow;
    float const moved = dot(shadow.origin - c.here.at.p, light.wi);
    shadow.t_max =
        light.distance > c.here.reach
            ? 0
            : (light.distance - moved) * (1 - 4 * std::numeric_limits<float>::epsilon()) -
                  light.p_error;
    return shadow;
}

/// Returns the part of the light that gets to the vertex past the objects in `blockers`.
Color transmitted(Tracer const& t, PathState const& path, Connection const& c,
                  world::RayMask blockers) {
    world::Ray const shadow = shadow_ray(path, c, blockers);
    if (!(shadow.t_max > 0)) return Color(0);
    Color through =
        blockers ? t.world.visibility(shadow, look_after(t.settings, path.diffused)) : Color(1);
    if (is_black(through) || !t.world.has_media()) return through;
    media::MediumStack media = path.media;
    if (c.through) {
        c.here.surface()->crossings.cross(media);
        through *= c.here.surface()->radiance_through(ScatteringKind::Diffuse);
    }
    uint32_t const alpha_seed =
        t.world.has_alpha() ? t.stream.walk(sampling::Dimension::Light, path.step).next_uint() : 0;
    through *= media_transmittance(t.world, shadow, media, alpha_seed);
    return is_hidden(t, c.light.object, media) ? Color(0) : through;
}

/// Tells the film of the light over a connection.
void add_scattered(Tracer const& t, PathState const& path, Connection const& c,
                   Scattered const& scattered, Color const& arriving) {
    for (size_t i = 0; i < scattered.kinds.size(); ++i) {
        if (is_black(scattered.values[i])) continue;
        if (t.record()) record_connection(t, path, c.here, c.light.wi, scattered.kinds[i]);
        add_clamped(t, {scattered.values[i] * arriving, c.light.light, path.signature, -1,
                        film::Found::BySampling});
    }
}

/// Adds one light sample at `here`.
void add_light(Tracer const& t, PathState const& path, Vertex const& here,
               lights::LightSample const& light) {
    if (is_black(light.radiance)) return;
    Connection const c = connect(t, path, here, light);
    // What rays can find is left to them where the strategy says so.
    if (t.settings.strategy == scene::Strategy::bsdf && !c.alone) return;
    Scattered const to_camera = scattered(t, path, c);
    if (is_black(to_camera.sum())) return;
    Color const visible = transmitted(t, path, c, shadow_mask(t.settings, c.rules));
    if (is_black(visible)) return;
    add_scattered(t, path, c, to_camera, path.throughput * light.radiance * visible / light.pdf);
}

/// Tells the record of one light sample at a shadow catcher.
void catch_light(Tracer const& t, PathState const& path, Vertex const& here,
                 lights::LightSample const& light) {
    Connection c = connect(t, path, here, light);
    c.combine = false; // no ray helps
    Color const arriving =
        path.throughput * scattered(t, path, c).sum() * light.radiance / light.pdf;
    if (is_black(arriving)) return;
    world::RayMask const blockers = shadow_mask(t.settings, c.rules);
    t.record()->add_caught(arriving * transmitted(t, path, c, blockers ? world::kCatcherMask : 0),
                           arriving * transmitted(t, path, c, blockers));
}

/// Calls f(LightSample) for each light that is chosen at `here`.
template <class F>
void for_each_light(Tracer const& t, PathState const& path, Vertex const& here, F&& f) {
    t.lights.sample(t.world, here.at, t.stream.get3(sampling::Dimension::Light, path.step), f);
}

} // namespace

void direct(Tracer const& t, PathState const& path, Vertex const& here) {
    if (t.lights.empty() || !here.is_smooth()) return;
    for_each_light(t, path, here,
                   [&](lights::LightSample const& light) { add_light(t, path, here, light); });
}

void catch_shadow(Tracer const& t, PathState const& path, Vertex const& here) {
    for_each_light(t, path, here,
                   [&](lights::LightSample const& light) { catch_light(t, path, here, light); });
}

} // namespace weft::integrator
