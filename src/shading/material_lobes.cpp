// Materials that are one kind of scattering each.
#include "lobes/conductor_presets.h"
#include "shading/thin_wall.h"

namespace weft::shading {

namespace {

// The materials of course scenes shadow as Walter et al. 2007 do, and give nothing back.
constexpr auto kCourse = lobes::Shadowing::Separable;

/// Adds the lobes of a sheet of a course material; `roughness`: none of a smooth one.
template <class Distribution, class Material>
void add_course_wall(LobeBuilder const& b, Material const& m, Values const& at,
                     std::optional<float> roughness) {
    auto const facets = [](float alpha) { return Distribution{alpha, alpha, kCourse}; };
    std::optional<Distribution> reflecting, transmitting;
    if (roughness || b.view.look.least_roughness > 0)
        reflecting = facets(b.alpha(roughness.value_or(0)));
    if (roughness) transmitting = facets(alpha_of(roughness_through(*roughness, at(m.ior))));
    ThinWall const wall{{at(m.ior) / b.view.ior_outside}, at(m.reflectance), at(m.transmittance)};
    add_thin_wall(b, 1, wall, b.frame, reflecting, transmitting);
}

} // namespace

void LobeBuilder::operator()(scene::Diffuse const& m, Values const& at) const {
    Color const albedo = at(m.albedo);
    float const roughness = unit(at(m.roughness));
    if (roughness > 0)
        add(Color(1), lobes::OrenNayar(unit(albedo), roughness));
    else
        add(albedo, lobes::Lambert{});
}

void LobeBuilder::operator()(scene::Conductor const& m, Values const& at) const {
    if (view.look.least_roughness > 0) {
        float const alpha = this->alpha(0);
        add(at(m.reflectance), lobes::GgxReflection{{alpha, alpha, kCourse}});
    } else {
        add(at(m.reflectance), lobes::SpecularReflection{});
    }
}

void LobeBuilder::operator()(scene::RoughConductor const& m, Values const& at) const {
    float const alpha = this->alpha(at(m.roughness));
    if (m.distribution == scene::Microfacets::ggx)
        add(at(m.reflectance), lobes::GgxReflection{{alpha, alpha, kCourse}});
    else
        add(at(m.reflectance), lobes::BeckmannReflection{{alpha, alpha, kCourse}});
}

void LobeBuilder::operator()(scene::Dielectric const& m, Values const& at) const {
    if (m.thin_walled) return add_course_wall<lobes::Ggx>(*this, m, at, std::nullopt);
    float const ior = at(m.ior), eta = relative_ior(ior), alpha = this->alpha(0);
    Color const r = at(m.reflectance), t = at(m.transmittance);
    if (view.look.least_roughness > 0 && eta != 1)
        add(Color(1), lobes::GgxDielectric({alpha, alpha, kCourse}, eta, r, t));
    else
        add(Color(1), lobes::SpecularDielectric{eta, r, t});
    to.ior = ior;
}

void LobeBuilder::operator()(scene::RoughDielectric const& m, Values const& at) const {
    if (m.thin_walled) {
        float const roughness = at(m.roughness);
        return m.distribution == scene::Microfacets::ggx
                   ? add_course_wall<lobes::Ggx>(*this, m, at, roughness)
                   : add_course_wall<lobes::Beckmann>(*this, m, at, roughness);
    }
    float const ior = at(m.ior), eta = relative_ior(ior), alpha = this->alpha(at(m.roughness));
    Color const r = at(m.reflectance), t = at(m.transmittance);
    if (eta == 1)
        add(Color(1), lobes::SpecularDielectric{1, r, t});
    else if (m.distribution == scene::Microfacets::ggx)
        add(Color(1), lobes::GgxDielectric({alpha, alpha, kCourse}, eta, r, t));
    else
        add(Color(1), lobes::BeckmannDielectric({alpha, alpha, kCourse}, eta, r, t));
    to.ior = ior;
}

void LobeBuilder::operator()(scene::Principled const& m, Values const& at) const {
    Color const base = unit(at(m.base_color));
    float const metallic = unit(at(m.metallic)), alpha = this->alpha(at(m.roughness));
    float const f0 = 0.08f * (1 - metallic), cos_o = std::abs(dot(frame.n, view.wo));
    float const c = unit(1 - cos_o);
    float const fresnel = at(m.specular) * (f0 + (1 - f0) * c * c * c * c * c);
    add((1 - fresnel) * (1 - metallic) * base, lobes::Lambert{});
    add(Color(fresnel) + (1 - fresnel) * metallic * base,
        lobes::GgxReflection{{alpha, alpha, kCourse}});
}

namespace {

/// Below it a surface is as smooth as floats can tell, and mirrors.
constexpr float kSmooth = 1e-3f;

struct MicrofacetBuilder {
    LobeBuilder const& b;
    scene::Microfacet const& m;
    Values const& at;
    Frame const& around;
    bool is_metal = m.metal != scene::Metal::none;
    bool is_thin = m.thin_walled && !is_metal;
    float ior = at(m.ior), anisotropic = at(m.anisotropic);
    lobes::ThinFilm film{at(m.thin_film_thickness), at(m.thin_film_ior),
                         b.view.entering || is_metal || is_thin ? b.view.ior_outside : ior};

    Color reflectance() const {
        return m.metal == scene::Metal::artist ? Color(1) : unit(at(m.reflectance));
    }
    Color transmittance() const { return unit(at(m.transmittance)); }
    lobes::BoundaryOptions options() const {
        float const reflection_ior = at(m.reflection_ior);
        return {reflection_ior > 0 ? b.relative_ior(reflection_ior) : 0.f, film};
    }

    lobes::Conductor conductor() const {
        switch (m.metal) {
        case scene::Metal::artist:
            return lobes::artist_conductor(unit(at(m.reflectance)), unit(at(m.edge_tint)));
        case scene::Metal::complex:
            return {at(m.complex_ior), at(m.extinction)};
        default: // the presets stand in the same order, after `none`
            return lobes::conductor_presets[size_t(m.metal) - 1].conductor;
        }
    }
    lobes::Fresnel fresnel() const {
        auto const [eta, k] = conductor();
        if (film) return lobes::ThinFilmFresnel{film, eta, k};
        return lobes::ConductorFresnel{eta, k};
    }

    /// Returns the facets of that roughness; none where they are a smooth surface.
    template <class Distribution>
    std::optional<Distribution> facets(float roughness) const {
        if (roughness < kSmooth) return {};
        auto const [x, y] = stretched_alphas(roughness, anisotropic);
        return Distribution{x, y,
                            m.shadowing == scene::Shadowing::separable
                                ? lobes::Shadowing::Separable
                                : lobes::Shadowing::Correlated};
    }

    template <class Distribution>
    void add() const {
        float const roughness = at(m.roughness);
        auto const rough = facets<Distribution>(std::max(roughness, b.view.look.least_roughness));
        if (is_thin)
            add_thin(rough, facets<Distribution>(roughness_through(roughness, ior)));
        else if (rough && (is_metal || b.relative_ior(ior) != 1))
            add_rough(*rough);
        else
            add_smooth();
    }
    template <class Distribution>
    void add_thin(std::optional<Distribution> const& reflecting,
                  std::optional<Distribution> const& transmitting) const {
        float const own = at(m.reflection_ior);
        lobes::ThinWallFresnel const both_sides{(own > 0 ? own : ior) / b.view.ior_outside, film};
        add_thin_wall(b, 1, {both_sides, reflectance(), transmittance()}, around, reflecting,
                      transmitting);
    }
    void add_smooth() const {
        if (is_metal)
            b.add(reflectance(), lobes::SpecularReflection{fresnel()});
        else
            b.add(Color(1), lobes::SpecularDielectric{b.relative_ior(ior), reflectance(),
                                                      transmittance(), options()});
    }
    template <class Distribution>
    void add_rough(Distribution const& d) const {
        if (is_metal)
            b.add(reflectance(), lobes::MicrofacetReflection<Distribution>{d, fresnel(), true});
        else
            b.add(Color(1),
                  lobes::MicrofacetDielectric<Distribution>(d, b.relative_ior(ior), reflectance(),
                                                            transmittance(), options(), true));
    }
};

} // namespace

void LobeBuilder::operator()(scene::Microfacet const& m, Values const& at) const {
    Frame around = frame_around(at(m.normal));
    if (at(m.anisotropic) > 0) around = around.turned(2 * kPi * at(m.anisotropic_rotation));
    to.bsdf.use_frame(around);
    MicrofacetBuilder const builder{*this, m, at, around};
    if (!builder.is_metal && !builder.is_thin) to.ior = builder.ior;
    switch (m.distribution) {
    case scene::MicrofacetDistribution::beckmann:
        return builder.add<lobes::Beckmann>();
    case scene::MicrofacetDistribution::ggx:
        return builder.add<lobes::Ggx>();
    case scene::MicrofacetDistribution::ashikhminShirley:
        return builder.add<lobes::AshikhminShirley>();
    }
}

void LobeBuilder::operator()(scene::Translucent const& m, Values const& at) const {
    Color const r = unit(at(m.reflectance)), t = unit(at(m.transmittance));
    Color const sum = r + t;
    Color const scale(1 / std::max(sum.r, 1.f), 1 / std::max(sum.g, 1.f), 1 / std::max(sum.b, 1.f));
    add(r * scale, lobes::Lambert{});
    add(t * scale, lobes::DiffuseTransmission{});
}

void LobeBuilder::operator()(scene::Transparent const& m, Values const& at) const {
    add(unit(at(m.transmittance)), lobes::Transparent{});
}

void LobeBuilder::operator()(scene::Hair const& m, Values const& at) const {
    lobes::HairParameters p;
    p.beta_m = unit(at(m.roughness));
    p.beta_n = unit(at(m.radial_roughness));
    p.eta = at(m.ior);
    p.alpha = radians(at(m.scale_angle));
    p.sigma_a = m.coloring == scene::HairColor::melanin
                    ? lobes::sigma_a_from_melanin(at(m.eumelanin), at(m.pheomelanin))
                    : lobes::sigma_a_from_color(at(m.color), p.beta_n);
    // The strip stands for a round fibre: its normal turns from one edge to the other.
    auto const [tangent, h] = fibre_at(point);
    Vec3 const side = cross(tangent, view.wo);
    if (!(length_squared(side) > 1e-12f)) return; // seen along the fibre
    Vec3 const across = normalize(side), facing = cross(across, tangent);
    Vec3 const n = facing * std::sqrt(1 - h * h) - across * h;
    to.bsdf.use_frame({Frame(tangent, cross(n, tangent), n), n});
    add(Color(1), lobes::Hair(p, h));
}

} // namespace weft::shading
