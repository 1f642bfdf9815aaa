#include "integrator/record.h"

#include "base/feature.h"

namespace weft::integrator {

namespace {

using film::Aov;

/// The guides of denoisers take lobes of less width for mirrors. The value is that of Cycles.
constexpr float kNarrowWidth = 0.075f;
/// Where mirrors do at least this part of the scattering, the guides are those of what they show.
constexpr float kMirrorShare = 0.75f;

bool is_narrow(lobes::Lobe const& lobe) { return width_of(lobe) < kNarrowWidth; }

/// Returns the part of the scattering that lobes like mirrors do.
float mirror_share(lobes::Bsdf const& bsdf) {
    float share = 0;
    for (int i = 0; i < bsdf.size(); ++i)
        if (is_narrow(bsdf[i])) share += bsdf[i].pick;
    return share;
}

/// Returns the mean of the lobes' normals, each by its part in the scattering; the surface's normal
/// where nothing scatters.
Vec3 mean_normal(lobes::Bsdf const& bsdf) {
    Vec3 sum(0);
    for (int i = 0; i < bsdf.size(); ++i) sum += bsdf.frame(bsdf[i]).n * bsdf[i].pick;
    return bsdf.size() > 0 && length_squared(sum) > 0 ? normalize(sum) : bsdf.frame().n;
}

void share_all(RayKind component, uint16_t layer, film::SampleRecord& record) {
    record.clear_shares();
    record.add_share(component, layer, Color(1));
}

/// Shares out what lobes for which `takes_part(lobe)` is true send from wi to wo.
template <class TakesPart>
void share_by_lobe(lobes::Bsdf const& bsdf, Vec3 const& wo, Vec3 const& wi,
                   TakesPart const& takes_part, film::SampleRecord& record) {
    struct {
        lobes::Lobe const* lobe;
        Color value;
    } parts[lobes::Bsdf::capacity];
    int count = 0;
    Color total;
    bsdf.for_each_value(wo, wi, [&](lobes::Lobe const& lobe, Color const& value) {
        if (!takes_part(lobe)) return;
        parts[count].lobe = &lobe;
        parts[count++].value = value;
        total += value;
    });
    record.clear_shares();
    bool const through = !bsdf.reflects(wi);
    auto const share = [](float of, float all) { return all > 0 ? of / all : 0; };
    for (int i = 0; i < count; ++i) {
        auto const& [lobe, v] = parts[i];
        record.add_share(ray_kind({flags_of(*lobe).kind, through}), lobe->layer,
                         {share(v.r, total.r), share(v.g, total.g), share(v.b, total.b)});
    }
}

/// Shares out what the smooth lobes send from wi to wo: where parts are told apart, those of `part`
/// alone.
void share_smooth(Tracer const& t, lobes::Bsdf const& bsdf, Vec3 const& wo, Vec3 const& wi,
                  ScatteringKind part) {
    bool const all = !t.settings.by_part;
    share_by_lobe(
        bsdf, wo, wi,
        [&](lobes::Lobe const& lobe) { return all || same_part(flags_of(lobe).kind, part); },
        *t.record());
}

/// Returns the part of the light from `wi` that lobes like mirrors send to `wo`.
float mirror_part(lobes::Bsdf const& bsdf, Vec3 const& wo, Vec3 const& wi) {
    float mirrors = 0, all = 0;
    bsdf.for_each_value(wo, wi, [&](lobes::Lobe const& lobe, Color const& value) {
        float const v = average(value);
        all += v;
        if (is_narrow(lobe)) mirrors += v;
    });
    return all > 0 ? mirrors / all : 0;
}

/// Returns the part of a surface's colour that is seen along the path. Unlike radiance, a guide
/// does not change by refraction.
Color guide_weight(PathState const& path) { return path.throughput * path.eta_scale; }

} // namespace

namespace {

void log_surface(PathState const& path, SurfaceVertex const& surface, film::PathLog& log) {
    log.push_back({.kind = film::PathEvent::Kind::Surface,
                   .p = surface.point.p,
                   .direction = surface.bsdf().frame().n,
                   .value = path.throughput,
                   .object = int32_t(surface.point.object)});
}

/// Tells the record what a film asks of the first surface, and the guides of a denoiser.
void set_surface(Tracer const& t, PathState const& path, Vertex const& here,
                 film::SampleRecord& record) {
    bool const first = path.bounces() == 0;
    if (!first && record.has_guides()) return;
    shading::SurfacePoint const& point = here.surface()->point;
    shading::Shading const& shading = here.surface()->shading;
    Vec3 const& wo = here.wo;
    Vec3 const n = mean_normal(shading.bsdf);
    Color const albedo = shading.bsdf.albedo(wo);
    if (first) {
        Vec3 const ng = dot(point.ng, wo) < 0 ? -point.ng : point.ng;
        record.meet_surface(point.object);
        record.set(Aov::depth, t.world.camera().depth(point.p));
        record.set(Aov::position, Vec3(Vec3d(point.p) + t.world.origin()));
        record.set(Aov::normal, n);
        record.set(Aov::normal_geometric, ng);
        record.set(Aov::uv, point.uv);
        record.set(Aov::albedo, albedo);
    }
    // What shines is as good as seen, however it scatters.
    if (!is_black(shading.emission) || mirror_share(shading.bsdf) < kMirrorShare)
        record.set_guides(guide_weight(path) * min(albedo + shading.emission, 1), n);
}

void record_medium(PathState const& path, Vertex const& here, film::SampleRecord& record) {
    if (record.log())
        record.log()->push_back(
            {.kind = film::PathEvent::Kind::Medium, .p = here.at.p, .value = path.throughput});
    if (path.bounces() == 0) share_all(RayKind::volume, 0, record);
    record.set_guides(guide_weight(path), Vec3(0));
}

} // namespace

void record_vertex(Tracer const& t, PathState const& path, Vertex const& here) {
    FeatureScope const scope(Feature::Film);
    film::SampleRecord& record = *t.record();
    SurfaceVertex const* const surface = here.surface();
    if (!surface) return record_medium(path, here, record);
    if (record.log()) log_surface(path, *surface, *record.log());
    if (record.layout().has_surface()) set_surface(t, path, here, record);
}

void record_bounce(Tracer const& t, PathState const& path, SurfaceVertex const& surface,
                   lobes::BsdfSample const& sample) {
    FeatureScope const scope(Feature::Film);
    film::SampleRecord& record = *t.record();
    bool const first = path.bounces() == 0;
    bool const passes = surface.passes(sample);
    if (record.log())
        record.log()->push_back(
            {.kind = passes ? film::PathEvent::Kind::Straight : film::PathEvent::Kind::Bounce,
             .direction = sample.wi,
             .value = sample.weight,
             .pdf = sample.pdf,
             .scattering = sample.scattering});
    if (passes) { // as if there were nothing
        if (first) record.forget_surface();
        return;
    }
    Vec3 const wo = -path.ray.direction;
    bool const delta = is_delta(sample.scattering.kind);
    if (first && record.layout().has_light()) {
        if (delta)
            share_all(ray_kind(sample.scattering), sample.layer, record);
        else
            share_smooth(t, surface.bsdf(), wo, sample.wi, sample.scattering.kind);
    }
    if (record.layout().has_surface() && !record.has_guides() && !delta &&
        mirror_part(surface.bsdf(), wo, sample.wi) < 0.5f)
        record.set_guides(guide_weight(path) * surface.bsdf().albedo(wo),
                          mean_normal(surface.bsdf()));
}

void record_connection(Tracer const& t, PathState const& path, Vertex const& here, Vec3 const& wi,
                       ScatteringKind part) {
    FeatureScope const scope(Feature::Film);
    if (here.surface() && path.bounces() == 0 && t.record()->layout().has_light())
        share_smooth(t, here.surface()->bsdf(), here.wo, wi, part);
}

void record_background(PathState const& path, Color const& radiance, film::SampleRecord& record) {
    if (record.log())
        record.log()->push_back({.kind = film::PathEvent::Kind::Background,
                                 .direction = path.ray.direction,
                                 .value = path.throughput});
    // Divided, so that nothing in the way is exactly 0.
    Color const& t = path.throughput;
    if (path.bounces() == 0) record.set(Aov::alpha, 1 - (t.r + t.g + t.b) / 3 - path.held_out);
    record.set_guides(guide_weight(path) * clamp(radiance, 0, 1), Vec3(0));
}

} // namespace weft::integrator
