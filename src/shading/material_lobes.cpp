// Materials that are one kind of scattering each.
#include "lobes/conductor_presets.h"
#include "shading/lobe_builder.h"

namespace weft::shading {

void LobeBuilder::operator()(scene::Diffuse const& m, Values const& at) const {
    Color const albedo = at(m.albedo);
    float const roughness = unit(at(m.roughness));
    if (roughness > 0)
        add(Color(1), lobes::OrenNayar(unit(albedo), roughness));
    else
        add(albedo, lobes::Lambert{});
}

void LobeBuilder::operator()(scene::Conductor const& m, Values const& at) const {
    add(at(m.reflectance), lobes::SpecularReflection{});
}

void LobeBuilder::operator()(scene::RoughConductor const& m, Values const& at) const {
    float const alpha = alpha_of(at(m.roughness));
    if (m.distribution == scene::Microfacets::ggx)
        add(at(m.reflectance), lobes::GgxReflection{{alpha, alpha}});
    else
        add(at(m.reflectance), lobes::BeckmannReflection{{alpha, alpha}});
}

void LobeBuilder::operator()(scene::Dielectric const& m, Values const& at) const {
    float const ior = at(m.ior);
    add(Color(1),
        lobes::SpecularDielectric{relative_ior(ior), at(m.reflectance), at(m.transmittance)});
    to.ior = ior;
}

void LobeBuilder::operator()(scene::RoughDielectric const& m, Values const& at) const {
    float const ior = at(m.ior), eta = relative_ior(ior), alpha = alpha_of(at(m.roughness));
    Color const r = at(m.reflectance), t = at(m.transmittance);
    if (eta == 1)
        add(Color(1), lobes::SpecularDielectric{1, r, t});
    else if (m.distribution == scene::Microfacets::ggx)
        add(Color(1), lobes::GgxDielectric({alpha, alpha}, eta, r, t));
    else
        add(Color(1), lobes::BeckmannDielectric({alpha, alpha}, eta, r, t));
    to.ior = ior;
}

void LobeBuilder::operator()(scene::Principled const& m, Values const& at) const {
    Color const base = unit(at(m.base_color));
    float const metallic = unit(at(m.metallic)), alpha = alpha_of(at(m.roughness));
    float const f0 = 0.08f * (1 - metallic), cos_o = std::abs(dot(frame.n, view.wo));
    float const c = unit(1 - cos_o);
    float const fresnel = at(m.specular) * (f0 + (1 - f0) * c * c * c * c * c);
    add((1 - fresnel) * (1 - metallic) * base, lobes::Lambert{});
    add(Color(fresnel) + (1 - fresnel) * metallic * base, lobes::GgxReflection{{alpha, alpha}});
}

namespace {

/// Below it a surface is as smooth as floats can tell, and mirrors.
constexpr float kSmooth = 1e-3f;

lobes::Fresnel metal_fresnel(scene::Microfacet const& m, Values const& at,
                             lobes::ThinFilm const& film) {
    lobes::Conductor conductor;
    switch (m.metal) {
    case scene::Metal::artist:
        conductor = lobes::artist_conductor(unit(at(m.reflectance)), unit(at(m.edge_tint)));
        break;
    case scene::Metal::complex:
        conductor = {at(m.complex_ior), at(m.extinction)};
        break;
    default: // the presets stand in the same order, after `none`
        conductor = lobes::conductor_presets[size_t(m.metal) - 1].conductor;
    }
    if (film) return lobes::ThinFilmFresnel{film, conductor.eta, conductor.k};
    return lobes::ConductorFresnel{conductor.eta, conductor.k};
}

template <class Distribution>
void add_microfacet(LobeBuilder const& b, scene::Microfacet const& m, Values const& at,
                    Distribution const& distribution, lobes::ThinFilm const& film) {
    Color const reflectance = m.metal == scene::Metal::artist ? Color(1) : unit(at(m.reflectance));
    if (m.metal != scene::Metal::none) {
        b.add(reflectance, lobes::MicrofacetReflection<Distribution>{
                               distribution, metal_fresnel(m, at, film), true});
        return;
    }
    float const ior = at(m.ior), reflection_ior = at(m.reflection_ior);
    lobes::BoundaryOptions const options{reflection_ior > 0 ? b.relative_ior(reflection_ior) : 0.f,
                                         film};
    b.add(Color(1),
          lobes::MicrofacetDielectric<Distribution>(distribution, b.relative_ior(ior), reflectance,
                                                    unit(at(m.transmittance)), options, true));
    b.to.ior = ior;
}

void add_smooth(LobeBuilder const& b, scene::Microfacet const& m, Values const& at,
                lobes::ThinFilm const& film) {
    Color const reflectance = m.metal == scene::Metal::artist ? Color(1) : unit(at(m.reflectance));
    if (m.metal != scene::Metal::none) {
        b.add(reflectance, lobes::SpecularReflection{metal_fresnel(m, at, film)});
        return;
    }
    float const ior = at(m.ior), reflection_ior = at(m.reflection_ior);
    lobes::BoundaryOptions const options{reflection_ior > 0 ? b.relative_ior(reflection_ior) : 0.f,
                                         film};
    b.add(Color(1), lobes::SpecularDielectric{b.relative_ior(ior), reflectance,
                                              unit(at(m.transmittance)), options});
    b.to.ior = ior;
}

} // namespace

void LobeBuilder::operator()(scene::Microfacet const& m, Values const& at) const {
    Frame around = frame_around(at(m.normal));
    float const roughness = at(m.roughness), anisotropic = at(m.anisotropic);
    if (anisotropic > 0) around = around.turned(2 * kPi * at(m.anisotropic_rotation));
    to.bsdf.use_frame(around);
    lobes::ThinFilm const film{at(m.thin_film_thickness), at(m.thin_film_ior),
                               view.entering || m.metal != scene::Metal::none ? view.ior_outside
                                                                              : at(m.ior)};
    if (roughness < kSmooth || (m.metal == scene::Metal::none && relative_ior(at(m.ior)) == 1)) {
        add_smooth(*this, m, at, film);
        return;
    }
    auto const [x, y] = stretched_alphas(roughness, anisotropic);
    switch (m.distribution) {
    case scene::MicrofacetDistribution::beckmann:
        return add_microfacet(*this, m, at, lobes::Beckmann{x, y}, film);
    case scene::MicrofacetDistribution::ggx:
        return add_microfacet(*this, m, at, lobes::Ggx{x, y}, film);
    case scene::MicrofacetDistribution::ashikhminShirley:
        return add_microfacet(*this, m, at, lobes::AshikhminShirley{x, y}, film);
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
    // The strip stands for a round fibre: its normal turns with v from one edge to the other.
    Frame const along(frame.n, point.dpdu);
    Vec3 const& tangent = along.s;
    Vec3 const side = cross(tangent, view.wo);
    if (!(length_squared(side) > 1e-12f)) return; // seen along the fibre
    float const h = std::clamp(2 * (point.uv.y - std::floor(point.uv.y)) - 1, -0.999f, 0.999f);
    Vec3 const across = normalize(side), facing = cross(across, tangent);
    Vec3 const n = facing * std::sqrt(1 - h * h) - across * h;
    to.bsdf = lobes::Bsdf(Frame(tangent, cross(n, tangent), n), n);
    add(Color(1), lobes::Hair(p, h));
}

} // namespace weft::shading
