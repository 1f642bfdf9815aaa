#include "lobes/bsdf.h"

#include <cstdio>
#include <cstdlib>

namespace weft::lobes {

namespace {

/// What one lobe said to `sample`, in local space.
struct Picked {
    Vec3 wi;
    float eta_scale;
    ScatteringKind kind;
    Color delta_weight{};
    float delta_probability = 0;
};

template <class L>
Picked sample_lobe(L const& lobe, Vec3 const& wo, Vec3 const& u) {
    if constexpr (DeltaLobe<L>) {
        DeltaSample const s = lobe.sample(wo, u);
        return {s.wi, s.eta_scale, lobe.flags().kind, s.weight, s.probability};
    } else {
        Vec3 const wi = lobe.sample(wo, u);
        return {wi, eta_scale_towards(lobe, wi), lobe.flags().kind};
    }
}

/// Mirrors `wi` at the plane across unit `ng`.
Vec3 fold(Vec3 const& wi, Vec3 const& ng) { return wi - ng * (2 * dot(wi, ng)); }

/// Returns whether `wi`, which is `local` in the frame, is on one side of both normals.
bool same_sides(LobeFrame const& frame, Vec3 const& wi, Vec3 const& local) {
    return dot(wi, frame.ng) * local.z > 0;
}

/// The part of diffuse light that a surface with a bent normal scatters (Chiang, Li and Burley
/// 2019, eq. 2 and 3), by the cosines between wi and the surface's normal, wi and the bent one, and
/// both normals. It is 1 where the bent normal makes the surface darker, and 0 where wi grazes it.
float terminator(float surface_i, float bent_i, float surface_bent) {
    float const g = surface_i / (bent_i * surface_bent);
    // Normals that are one but for rounding leave all bits as they are.
    if (!(g < 0.9999f)) return 1;
    return g > 0 ? g * (1 + g * (1 - g)) : 0;
}

} // namespace

// Materials are refused when they are compiled if they may have too many lobes. So this is a
// mistake in the program, and to go on would lose light in silence.
void Bsdf::no_room() {
    std::fprintf(stderr, "weft: internal error: no room for another lobe beside %d\n", capacity);
    std::abort();
}

inline LobeValue Bsdf::eval_local(Span const& span, Vec3 const& wo, Vec3 const& wi,
                                  float fade) const {
    Sides const side = wi.z > 0 ? Sides::Reflection : Sides::Transmission;
    if (!any(smooth_sides_, side)) return {};
    LobeValue sum;
    for (int i = span.begin; i < span.end; ++i) {
        Lobe const& lobe = lobes_[i];
        LobeValue const v = match(lobe.kind, [&](auto const& l) {
            if constexpr (SmoothLobe<std::remove_cvref_t<decltype(l)>>) return l.eval(wo, wi);
            return LobeValue{};
        });
        bool const fades = fade != 1 && is_diffuse(flags_of(lobe).kind);
        sum.f += lobe.weight * (fades ? fade * v.f : v.f);
        sum.pdf += lobe.pick * v.pdf;
    }
    return sum;
}

inline LobeValue Bsdf::eval_span(Span const& span, Vec3 const& wo, Vec3 const& wi) const {
    auto const& [shading, ng, bent] = span.frame;
    Vec3 const wo_local = shading.to_local(wo), wi_local = shading.to_local(wi);
    float const height = dot(wi, ng);
    LobeValue value;
    if (height * wi_local.z > 0) {
        float const fade =
            bent == BentNormals::Softened ? terminator(height, wi_local.z, dot(shading.n, ng)) : 1;
        value = eval_local(span, wo_local, wi_local, fade);
    }
    if (bent != BentNormals::Folded) return value;
    // Where the normals are one this is -wi_local.z, and nothing is folded.
    float const folded_z = wi_local.z - 2 * height * dot(shading.n, ng);
    if (folded_z * height > 0) [[unlikely]] {
        LobeValue const v = eval_local(span, wo_local, shading.to_local(fold(wi, ng)));
        value.f += v.f;
        value.pdf += v.pdf;
    }
    return value;
}

LobeValue Bsdf::eval_one(int i, Vec3 const& wo, Vec3 const& wi) const {
    return eval_span({i, i + 1, frames_[lobes_[i].frame]}, wo, wi);
}

LobeValue Bsdf::eval(Vec3 const& wo, Vec3 const& wi) const {
    LobeValue sum;
    for (int first = 0; first < count_;) {
        Span const span = lobes_from(first);
        LobeValue const v = eval_span(span, wo, wi);
        sum.f += v.f;
        sum.pdf += v.pdf;
        first = span.end;
    }
    return sum;
}

Color Bsdf::albedo(Vec3 const& wo) const {
    Color sum;
    for (int i = 0; i < count_; ++i) {
        Vec3 const local = frame(lobes_[i]).to_local(wo);
        sum += lobes_[i].weight *
               match(lobes_[i].kind, [&](auto const& l) { return l.albedo(local); });
    }
    return sum;
}

void Bsdf::prepare(Vec3 const& wo) {
    if (count_ == 1) {
        if (!lobes_[0].looked_up)
            match(lobes_[0].kind, [&](auto& l) { look_up(l, frame(lobes_[0]).to_local(wo)); });
        return;
    }
    // The floor keeps a lobe alive whose tabulated albedo rounds to 0.
    constexpr float least_albedo = 1e-2f;
    float total = 0;
    for (int i = 0; i < count_; ++i) {
        Lobe& lobe = lobes_[i];
        if (!lobe.looked_up) {
            Vec3 const local = frame(lobe).to_local(wo);
            lobe.albedo = match(lobe.kind, [&](auto& l) { return look_up_albedo(l, local); });
            lobe.looked_up = true;
        }
        lobe.pick = average(lobe.weight * (lobe.albedo + Color(least_albedo)));
        total += lobe.pick;
    }
    for (int i = 0; i < count_; ++i) lobes_[i].pick /= total;
}

LobeValue Bsdf::eval_part(Vec3 const& wo, Vec3 const& wi, ScatteringKind part) const {
    LobeValue sum;
    for (int i = 0; i < count_; ++i) {
        if (!same_part(flags_of(lobes_[i]).kind, part)) continue;
        LobeValue const v = eval_one(i, wo, wi);
        sum.f += v.f;
        sum.pdf += v.pdf;
    }
    return sum;
}

void Bsdf::keep_diffuse() {
    int count = 0;
    float total = 0;
    sides_ = smooth_sides_ = Sides::None;
    for (int i = 0; i < count_; ++i) {
        LobeFlags const flags = flags_of(lobes_[i]);
        if (!is_diffuse(flags.kind) && flags.kind != ScatteringKind::Straight) continue;
        lobes_[count++] = lobes_[i];
        total += lobes_[i].pick;
        add_sides(flags);
    }
    count_ = count;
    for (int i = 0; i < count_; ++i) lobes_[i].pick /= total;
}

BsdfSample Bsdf::sample(Vec3 const& wo, Vec3 const& u, bool by_part) const {
    if (count_ == 0) return {};
    int picked = 0;
    float rest = u.z;
    while (picked + 1 < count_ && rest >= lobes_[picked].pick) rest -= lobes_[picked++].pick;
    Lobe const& lobe = lobes_[picked];
    Vec3 const u_lobe{u.x, u.y, std::min(rest / lobe.pick, kOneMinusEpsilon)};

    LobeFrame const& frame = frames_[lobe.frame];
    Vec3 const wo_local = frame.shading.to_local(wo);
    Picked const p =
        match(lobe.kind, [&](auto const& l) { return sample_lobe(l, wo_local, u_lobe); });
    Vec3 wi = frame.shading.to_world(p.wi);
    if (!same_sides(frame, wi, p.wi)) { // or the lobe failed: the zero vector is on no side
        if (frame.bent != BentNormals::Folded) return {};
        wi = fold(wi, frame.ng);
        if (!same_sides(frame, wi, p.wi)) return {};
    }

    BsdfSample result{wi, {}, 0, {p.kind, !(p.wi.z > 0)}, p.eta_scale, lobe.layer};
    if (is_delta(p.kind)) {
        result.weight = lobe.weight * p.delta_weight * (1 / lobe.pick);
        result.pdf = lobe.pick * p.delta_probability;
        return result;
    }
    // Of result.wi, as callers see it: a copy in registers may have been rounded otherwise.
    LobeValue const v = by_part ? eval_part(wo, result.wi, p.kind) : eval(wo, result.wi);
    if (!(v.pdf > 0)) return {};
    result.weight = v.f / v.pdf;
    result.pdf = v.pdf;
    return result;
}

} // namespace weft::lobes
