// The principled material as lobes, from the outside in: sheen, clear coat, then metal, glass and
// a matte base under a dielectric interface side by side. Each layer leaves 1 - albedo(wo) to
// those below (Kulla and Conty 2017), so that none adds light; a coat tints by the way that light
// seen along wo takes through it.
#include "lobes/conductor_presets.h"
#include "shading/thin_wall.h"

namespace weft::shading {

namespace {

/// Roughness below which glass is clear, and sampled as such.
constexpr float kMirrorRoughness = 0.01f;

/// The index whose normal reflectance is `f0` < 1.
float ior_of_f0(float f0) {
    float const root = std::sqrt(std::clamp(f0, 0.f, 0.99f));
    return (1 + root) / (1 - root);
}

struct DisneyBuilder {
    LobeBuilder b; ///< its weight shrinks from layer to layer
    scene::Disney const& m;
    Values const& at;
    Color base, specular_tint;
    float roughness, ior;
    lobes::Ggx facets;
    Frame around;
    lobes::ThinFilm film;

    DisneyBuilder(LobeBuilder const& builder, scene::Disney const& material, Values const& values)
        : b(builder), m(material), at(values), base(unit(at(m.base_color))),
          specular_tint(unit(at(m.specular_tint))),
          roughness(std::max(unit(at(m.roughness)), b.view.look.least_roughness)), ior(at(m.ior)),
          around(b.frame_around(at(m.normal))) {
        float const anisotropic = at(m.anisotropic);
        facets = facets_of(roughness);
        if (anisotropic > 0) around = around.turned(2 * kPi * at(m.anisotropic_rotation));
        film = {at(m.thin_film_thickness), at(m.thin_film_ior), b.view.ior_outside};
    }

    lobes::Ggx facets_of(float of) const {
        auto const [x, y] = stretched_alphas(of, at(m.anisotropic));
        return {x, y, lobes::Shadowing::Correlated};
    }

    void layer_over(Color const& reflected) { b.weight *= rest_of(reflected); }

    void add_sheen() {
        float const sheen = unit(at(m.sheen));
        if (sheen == 0) return;
        lobes::Sheen const lobe{unit(at(m.sheen_roughness))};
        Color const color = sheen * unit(at(m.sheen_tint));
        layer_over(color * b.add_layer(color, lobe, around));
    }

    void add_clearcoat() {
        float const clearcoat = unit(at(m.clearcoat));
        if (clearcoat == 0) return;
        Vec3 const normal = at(m.clearcoat_normal);
        Frame const coat = b.frame_around(normal == Vec3(0) ? at(m.normal) : normal);
        b.to.bsdf.use_frame(coat);
        float const coat_ior = std::clamp(at(m.clearcoat_ior), 1.f, 3.f);
        lobes::Clearcoat const lobe(std::min(b.alpha(at(m.clearcoat_roughness)), 0.5f), coat_ior);
        layer_over(clearcoat * b.add_layer(Color(clearcoat), lobe, coat));
        Color const through =
            layer_transmittance(unit(at(m.clearcoat_tint)), 1, coat_ior, dot(coat.n, b.view.wo));
        b.weight *= lerp(Color(1), through, clearcoat);
    }

    void add_metal(float share) {
        lobes::Fresnel fresnel = lobes::schlick_f82(base, specular_tint);
        if (film) {
            lobes::Conductor const c = lobes::artist_conductor(base, specular_tint);
            fresnel = lobes::ThinFilmFresnel{film, c.eta, c.k};
        }
        b.add(Color(share), lobes::GgxReflection{facets, fresnel, true});
    }

    void add_sheet(float share) {
        float const own = at(m.transmission_roughness);
        float const through = own < 0 ? roughness_through(unit(at(m.roughness)), ior) : own;
        auto const rough = [&](float r) {
            return r < kMirrorRoughness ? std::nullopt : std::optional(facets_of(r));
        };
        add_thin_wall(b, share, {{ior / b.view.ior_outside, film}, specular_tint, base}, around,
                      rough(roughness), rough(through));
    }

    void add_glass(float share) {
        b.to.ior = ior;
        float const eta = b.relative_ior(ior), below = at(m.transmission_roughness);
        lobes::BoundaryOptions options{0, film};
        // Only glass is seen from within; there the film's outer side is the glass.
        if (!b.view.entering) options.film.outer_ior = ior;
        if (eta == 1 || (roughness < kMirrorRoughness && below < kMirrorRoughness)) {
            b.add(Color(share), lobes::SpecularDielectric{eta, specular_tint, base, options});
        } else if (below < 0 || below == roughness) {
            b.add(Color(share),
                  lobes::GgxDielectric(facets, eta, specular_tint, base, options, true));
        } else {
            add_two_surfaces(share, eta, b.alpha(below), options);
        }
    }

    /// Glass of which one rough surface reflects and another one refracts. They do not share light
    /// out by one Fresnel term: what the first leaves is refracted, up to twice of what the second
    /// would; where that is not enough, as beyond its critical angle, the rest is reflected.
    void add_two_surfaces(float share, float eta, float alpha_below,
                          lobes::BoundaryOptions const& options) {
        lobes::Ggx const through{alpha_below, alpha_below, lobes::Shadowing::Correlated};
        auto const reflects = [&](Color const& tint) {
            return lobes::GgxDielectric(facets, eta, tint, Color(0), options, true);
        };
        auto const refracts = [&](Color const& tint) {
            return lobes::GgxDielectric(through, eta, Color(0), tint, options, true);
        };
        Color const r = b.albedo(reflects(Color(1)), around);
        Color const t = b.albedo(refracts(Color(1)), around);
        auto const each = [](auto const& f, Color const& x, Color const& y) {
            return Color(f(x.r, y.r), f(x.g, y.g), f(x.b, y.b));
        };
        // Short of 1 by what the albedos may lack.
        auto const ratio = [](float x, float y) { return y > 0 ? 0.998f * x / y : 0.f; };
        auto const refracted =
            each([](float x, float y) { return std::min(x, 2 * y); }, rest_of(r), t);
        b.add(share * each(ratio, rest_of(refracted), r), reflects(specular_tint));
        b.add(share * each(ratio, refracted, t), refracts(base));
    }

    /// Plastic, wood, skin: a dielectric interface over what scatters below.
    void add_dielectric(float share) {
        float const f0 = lobes::fresnel_f0(ior) * 2 * unit(at(m.specular));
        Color reflected(0);
        if (f0 > 0) {
            lobes::Fresnel fresnel = lobes::DielectricFresnel{ior_of_f0(f0)};
            if (film) {
                fresnel = lobes::ThinFilmFresnel{film, Color(ior_of_f0(f0)), Color(0)};
            } else if (specular_tint != Color(1)) {
                // What is weaker than any stone fades at the edge, too.
                fresnel = lobes::SchlickFresnel{f0 * specular_tint, Color(std::min(50 * f0, 1.f))};
            }
            reflected =
                b.add_layer(Color(share), lobes::GgxReflection{facets, fresnel, true}, around);
        }
        Color const below = share * rest_of(reflected) * base;
        float const subsurface = unit(at(m.subsurface));
        b.add(below * (1 - subsurface), lobes::BurleyDiffuse{roughness});
        float const across = m.thin_walled ? 0.5f : 0; // of it, as OpenPBR has it
        b.add(below * subsurface * (1 - across), lobes::SubsurfaceDiffuse{{roughness}});
        b.add(below * subsurface * across, lobes::DiffuseTransmission{});
    }

    void build() {
        if (around != b.frame) b.to.bsdf.use_frame(around);
        add_sheen();
        add_clearcoat();
        b.to.bsdf.use_frame(around);
        float const metallic = unit(at(m.metallic)), transmission = unit(at(m.transmission));
        float const glass = (1 - metallic) * transmission;
        float const matte = (1 - metallic) * (1 - transmission);
        if (metallic > 0) add_metal(metallic);
        if (glass > 0 && m.thin_walled) add_sheet(glass);
        if (glass > 0 && !m.thin_walled) add_glass(glass);
        if (matte > 0) add_dielectric(matte);
    }
};

} // namespace

void LobeBuilder::operator()(scene::Disney const& m, Values const& at) const {
    DisneyBuilder(*this, m, at).build();
}

} // namespace weft::shading
