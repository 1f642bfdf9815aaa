#include "shading/shading.h"

namespace weft::shading {

namespace {

/// From the roughness that users set to the microfacet distribution's width.
float alpha_of(float roughness) { return std::max(square(std::clamp(roughness, 0.f, 1.f)), 1e-3f); }

Color unit(Color const& c) {
    return {std::clamp(c.r, 0.f, 1.f), std::clamp(c.g, 0.f, 1.f), std::clamp(c.b, 0.f, 1.f)};
}

/// Far index over near index.
float relative_ior(float ior, Boundary const& b) {
    return b.entering ? ior / b.ior_outside : b.ior_outside / ior;
}

struct LobeBuilder {
    Values const& at;
    Vec3 const& wo;
    Boundary const& boundary;
    lobes::Bsdf& bsdf;

    float operator()(scene::Diffuse const& m) const {
        bsdf.add(at(m.albedo), lobes::Lambert{});
        return 1;
    }

    float operator()(scene::Conductor const& m) const {
        bsdf.add(at(m.reflectance), lobes::SpecularReflection{});
        return 1;
    }

    void add_reflection(Color const& weight, float alpha, scene::Microfacets kind) const {
        if (kind == scene::Microfacets::ggx)
            bsdf.add(weight, lobes::GgxReflection{{alpha, alpha}});
        else
            bsdf.add(weight, lobes::BeckmannReflection{{alpha, alpha}});
    }

    float operator()(scene::RoughConductor const& m) const {
        add_reflection(at(m.reflectance), alpha_of(at(m.roughness)), m.distribution);
        return 1;
    }

    float operator()(scene::Dielectric const& m) const {
        float const ior = at(m.ior);
        bsdf.add(Color(1), lobes::SpecularDielectric{relative_ior(ior, boundary), at(m.reflectance),
                                                     at(m.transmittance)});
        return ior;
    }

    float operator()(scene::RoughDielectric const& m) const {
        float const ior = at(m.ior), eta = relative_ior(ior, boundary),
                    alpha = alpha_of(at(m.roughness));
        Color const r = at(m.reflectance), t = at(m.transmittance);
        if (eta == 1)
            bsdf.add(Color(1), lobes::SpecularDielectric{1, r, t});
        else if (m.distribution == scene::Microfacets::ggx)
            bsdf.add(Color(1), lobes::GgxDielectric({alpha, alpha}, eta, r, t));
        else
            bsdf.add(Color(1), lobes::BeckmannDielectric({alpha, alpha}, eta, r, t));
        return ior;
    }

    float operator()(scene::Principled const& m) const {
        Color const base = unit(at(m.base_color));
        float const metallic = std::clamp(at(m.metallic), 0.f, 1.f);
        float const f0 = 0.08f * (1 - metallic), cos_o = std::abs(dot(bsdf.frame().n, wo));
        float const c = std::clamp(1 - cos_o, 0.f, 1.f);
        float const fresnel = at(m.specular) * (f0 + (1 - f0) * c * c * c * c * c);
        bsdf.add((1 - fresnel) * (1 - metallic) * base, lobes::Lambert{});
        add_reflection(Color(fresnel) + (1 - fresnel) * metallic * base, alpha_of(at(m.roughness)),
                       scene::Microfacets::ggx);
        return 1;
    }

    float operator()(scene::VolumeBoundary const&) const { return 1; }
};

} // namespace

Frame shading_frame(SurfacePoint const& point, Vec3 const& wo, Vec3 const& ng_facing_wo) {
    Vec3 n = dot(point.ns, ng_facing_wo) < 0 ? -point.ns : point.ns;
    constexpr float least_cosine = 1e-3f;
    if (float const cosine = dot(n, wo); cosine < least_cosine)
        n = normalize(n + wo * (least_cosine - cosine));
    return point.dpdu == Vec3(0) ? Frame(n) : Frame(n, point.dpdu);
}

CompiledMaterial compile(scene::Material const& material, GraphCompiler& compiler,
                         SourceLocation const& where) {
    CompiledMaterial compiled{material, {}};
    std::visit([&](auto& m) { compiled.program = compiler.compile(m, where); },
               compiled.parameters);
    return compiled;
}

float add_lobes(CompiledMaterial const& material, SurfacePoint const& point, Vec3 const& wo,
                Boundary const& boundary, lobes::Bsdf& bsdf) {
    Values values;
    evaluate(material.program, point, values);
    float const ior = match(material.parameters, LobeBuilder{values, wo, boundary, bsdf});
    bsdf.prepare(wo);
    return ior;
}

scene::Input<float> interior_ior(scene::Material const& material) {
    if (auto const* d = std::get_if<scene::Dielectric>(&material)) return d->ior;
    if (auto const* d = std::get_if<scene::RoughDielectric>(&material)) return d->ior;
    return {1};
}

} // namespace weft::shading
