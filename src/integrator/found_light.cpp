#include "integrator/found_light.h"

#include "integrator/controls.h"
#include "integrator/direct.h"
#include "integrator/record.h"

namespace weft::integrator {

namespace {

/// Returns the weight of light that the path's ray found and that light sampling finds with the
/// density `light_pdf` per solid angle.
float found_weight(scene::Strategy strategy, PathState const& path, float light_pdf) {
    float const pdf = path.last.pdf;
    if (strategy == scene::Strategy::bsdf || pdf == 0 || light_pdf == 0) return 1;
    return strategy == scene::Strategy::nee ? 0 : power_heuristic(pdf, light_pdf);
}

/// Returns whether the path is a camera ray that met nothing which lets light through: no surface,
/// no medium. Instances with holes let rays through unseen.
bool is_from_camera(Tracer const& t, PathState const& path) {
    return path.step == 1 && path.media.current().medium < 0 && !t.world.has_alpha();
}

/// Returns whether the camera sees `p` straight and in focus, to a pixel.
bool is_sharp(Tracer const& t, PathState const& path, Vec3 const& p) {
    return is_from_camera(t, path) && t.world.camera().blur(p) <= 1;
}

/// Returns what part of a light counts that the ray met `distance` away from the last scattering.
float found_part(Tracer const& t, PathState const& path, int32_t light, float light_pdf,
                 float distance) {
    return found_weight(t.settings.strategy, path, light_pdf) *
           found_factor(t, path, light, distance);
}

} // namespace

void add_emission(Tracer const& t, PathState const& path, SurfaceVertex const& surface) {
    Color const& emission = surface.shading.emission;
    if (is_black(emission)) return;
    shading::SurfacePoint const& point = surface.point;
    int32_t const light = t.lights.of_object(point.object);
    lights::LitPoint const& from = path.last.at;
    float const light_pdf = light >= 0 && path.last.pdf > 0 ? t.lights.pdf(light, from, point) : 0;
    float const part = found_part(t, path, light, light_pdf, length(point.p - from.p));
    add_clamped(t, {.value = path.throughput * emission * part,
                    .light = light,
                    .path = path.signature,
                    .object = int32_t(point.object),
                    .is_sharp = is_sharp(t, path, point.p)});
}

void add_lamps(Tracer const& t, PathState const& path, float limit) {
    bool const seen = path.bounces() == 0;
    if (seen && !t.lights.camera_sees_lamps()) return;
    world::Ray ray = path.ray;
    ray.t_max = std::min(limit, path.ray.t_max);
    int32_t const medium = path.media.current().medium;
    lights::LitPoint const& from = path.last.at;
    t.lights.lamps(
        t.world, ray, from, [&](int32_t light, Vec3 const& p, Color const& radiance, float pdf) {
            if (seen && t.lights.info(light).hidden_from_camera) return;
            float const light_pdf = path.last.pdf > 0 ? pdf : 0;
            Color value = path.throughput * radiance *
                          found_part(t, path, light, light_pdf, length(p - from.p));
            // Wherever the path scatters in the medium, the lamp's light on this line is the same.
            if (medium >= 0)
                value *= media::transmittance(t.world.medium(medium), length(p - path.ray.origin));
            add_clamped(t, {.value = value,
                            .light = light,
                            .path = path.signature,
                            .is_sharp = is_sharp(t, path, p)});
        });
}

void add_background(Tracer const& t, PathState const& path) {
    Color seen;
    bool const sharp = is_from_camera(t, path) && t.world.camera().blur_at_infinity() <= 1;
    t.lights.background(t.world, path.last.at, path.ray.direction,
                        [&](int32_t light, Color const& radiance, float pdf) {
                            if (path.bounces() == 0 && t.lights.info(light).hidden_from_camera)
                                return;
                            seen += radiance;
                            float const part = found_part(t, path, light, pdf, kInfinity);
                            add_clamped(t, {.value = path.throughput * radiance * part,
                                            .light = light,
                                            .path = path.signature,
                                            .found = film::Found::InBackground,
                                            .is_sharp = sharp});
                        });
    if (t.record()) record_background(path, seen, *t.record());
}

} // namespace weft::integrator
