#include "integrator/record.h"

#include "base/feature.h"

namespace weft::integrator {

namespace {

using film::Component;
using lobes::LobeFlags;

/// The guides of denoisers take lobes of less width for mirrors. The value is that of Cycles.
constexpr float kNarrowWidth = 0.075f;
/// Where mirrors do at least this part of the scattering, the guides are what is seen in them.
constexpr float kMirrorShare = 0.75f;

bool is_narrow(lobes::Lobe const& lobe) { return width_of(lobe) < kNarrowWidth; }

/// The part of the scattering that lobes like mirrors do.
float mirror_share(lobes::Bsdf const& bsdf) {
    float share = 0;
    for (int i = 0; i < bsdf.size(); ++i)
        if (is_narrow(bsdf[i])) share += bsdf[i].pick;
    return share;
}

/// Of all that scatters, by its part in it; that of the surface where nothing does.
Vec3 mean_normal(lobes::Bsdf const& bsdf) {
    Vec3 sum(0);
    for (int i = 0; i < bsdf.size(); ++i) sum += bsdf.frame(bsdf[i]).n * bsdf[i].pick;
    return bsdf.size() > 0 && length_squared(sum) > 0 ? normalize(sum) : bsdf.frame().n;
}

Component component(LobeFlags flags, bool reflects) {
    if (!reflects) return Component::Transmission;
    if (any(flags, LobeFlags::Subsurface)) return Component::Subsurface;
    return any(flags, LobeFlags::Diffuse) ? Component::Diffuse : Component::Specular;
}

void share_all(Component component, uint16_t layer, film::SampleRecord& record) {
    record.clear_shares();
    record.add_share(component, layer, Color(1));
}

/// Shares out what the smooth lobes for which `takes_part(lobe)` send from wi to wo.
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
    bool const reflects = bsdf.reflects(wi);
    auto const share = [](float of, float all) { return all > 0 ? of / all : 0; };
    for (int i = 0; i < count; ++i) {
        auto const& [lobe, v] = parts[i];
        record.add_share(component(flags_of(*lobe), reflects), lobe->layer,
                         {share(v.r, total.r), share(v.g, total.g), share(v.b, total.b)});
    }
}

void share_by_lobe(lobes::Bsdf const& bsdf, Vec3 const& wo, Vec3 const& wi,
                   film::SampleRecord& record) {
    share_by_lobe(
        bsdf, wo, wi, [](lobes::Lobe const&) { return true; }, record);
}

/// Of the lobes of one part: Bsdf::eval_part.
void share_by_lobe(lobes::Bsdf const& bsdf, Vec3 const& wo, Vec3 const& wi, LobeFlags part,
                   film::SampleRecord& record) {
    share_by_lobe(
        bsdf, wo, wi, [&](lobes::Lobe const& lobe) { return lobes::in_part(flags_of(lobe), part); },
        record);
}

/// The part of what is seen towards `wi` that comes by way of mirrors.
float mirror_part(lobes::Bsdf const& bsdf, Vec3 const& wo, Vec3 const& wi) {
    float mirrors = 0, all = 0;
    bsdf.for_each_value(wo, wi, [&](lobes::Lobe const& lobe, Color const& value) {
        float const v = average(value);
        all += v;
        if (is_narrow(lobe)) mirrors += v;
    });
    return all > 0 ? mirrors / all : 0;
}

/// What came before does not change the radiance of what is seen, as refraction does.
Color guide_weight(PathState const& path) { return path.throughput * path.eta_scale; }

} // namespace

film::Bounce bounce_kind(lobes::LobeFlags flags) {
    using lobes::LobeFlags;
    bool const through = any(flags, LobeFlags::Transmission);
    if (any(flags, LobeFlags::Subsurface)) return film::Bounce::Subsurface;
    if (any(flags, LobeFlags::Delta))
        return through ? film::Bounce::SpecularTransmission : film::Bounce::Specular;
    if (any(flags, LobeFlags::Glossy))
        return through ? film::Bounce::GlossyTransmission : film::Bounce::Glossy;
    return through ? film::Bounce::DiffuseTransmission : film::Bounce::Diffuse;
}

void record_surface(world::World const& world, PathState const& path,
                    shading::SurfacePoint const& point, shading::Shading const& shading,
                    film::SampleRecord& record) {
    FeatureScope const scope(Feature::Film);
    if (record.log())
        record.log()->push_back({.kind = film::PathEvent::Kind::Surface,
                                 .p = point.p,
                                 .direction = shading.bsdf.frame().n,
                                 .value = path.throughput,
                                 .object = int32_t(point.object)});
    if (!record.layout().has_surface()) return;
    bool const first = path.signature.length() == 0;
    if (!first && record.has_guides()) return;
    Vec3 const wo = -path.ray.direction;
    Vec3 const n = mean_normal(shading.bsdf);
    Color const albedo = shading.bsdf.albedo(wo);
    if (first) {
        Vec3 const ng = dot(point.ng, wo) < 0 ? -point.ng : point.ng;
        record.set_surface(
            {point.object, world.camera().depth(point.p), point.p, n, ng, point.uv, albedo});
    }
    // What shines is as good as seen, however it scatters.
    if (!is_black(shading.emission) || mirror_share(shading.bsdf) < kMirrorShare)
        record.set_guides(guide_weight(path) * min(albedo + shading.emission, 1), n);
}

void record_bounce(PathSettings const& settings, PathState const& path, lobes::Bsdf const& bsdf,
                   Vec3 const& wo, lobes::BsdfSample const& sample, bool see_through,
                   film::SampleRecord& record) {
    FeatureScope const scope(Feature::Film);
    bool const first = path.signature.length() == 0;
    bool const straight = see_through && any(sample.flags, LobeFlags::Straight);
    bool const delta = any(sample.flags, LobeFlags::Delta);
    if (record.log())
        record.log()->push_back(
            {.kind = straight ? film::PathEvent::Kind::Straight : film::PathEvent::Kind::Bounce,
             .direction = sample.wi,
             .value = sample.weight,
             .pdf = sample.pdf,
             .delta = delta,
             .bounce = bounce_kind(sample.flags)});
    if (straight) { // as if there were nothing
        if (first) record.forget_surface();
        return;
    }
    if (first && record.layout().has_light()) {
        if (delta)
            share_all(component(sample.flags, any(sample.flags, LobeFlags::Reflection)),
                      sample.layer, record);
        else if (settings.by_part)
            share_by_lobe(bsdf, wo, sample.wi, sample.flags, record);
        else
            share_by_lobe(bsdf, wo, sample.wi, record);
    }
    if (record.layout().has_surface() && !record.has_guides() && !delta &&
        mirror_part(bsdf, wo, sample.wi) < 0.5f)
        record.set_guides(guide_weight(path) * bsdf.albedo(wo), mean_normal(bsdf));
}

void record_connection(PathState const& path, lobes::Bsdf const& bsdf, Vec3 const& wo,
                       Vec3 const& wi, film::SampleRecord& record) {
    FeatureScope const scope(Feature::Film);
    if (path.signature.length() == 0 && record.layout().has_light())
        share_by_lobe(bsdf, wo, wi, record);
}

void record_connection(PathState const& path, lobes::Bsdf const& bsdf, Vec3 const& wo,
                       Vec3 const& wi, LobeFlags part, film::SampleRecord& record) {
    if (path.signature.length() == 0 && record.layout().has_light())
        share_by_lobe(bsdf, wo, wi, part, record);
}

void record_volume(PathState const& path, film::SampleRecord& record) {
    if (record.log())
        record.log()->push_back({.kind = film::PathEvent::Kind::Medium,
                                 .p = path.ray.origin,
                                 .value = path.throughput});
    if (path.signature.length() == 1) share_all(Component::Volume, 0, record);
    record.set_guides(guide_weight(path), Vec3(0));
}

void record_background(PathState const& path, Color const& radiance, film::SampleRecord& record) {
    if (record.log())
        record.log()->push_back({.kind = film::PathEvent::Kind::Background,
                                 .direction = path.ray.direction,
                                 .value = path.throughput});
    // Divided, so that nothing in the way is exactly 0.
    Color const& t = path.throughput;
    if (path.signature.length() == 0) record.set_alpha(1 - (t.r + t.g + t.b) / 3 - path.held_out);
    record.set_guides(guide_weight(path) * clamp(radiance, 0, 1), Vec3(0));
}

} // namespace weft::integrator
