// Turns the values of one material at one point into weighted lobes. An overload per material; the
// sources group them: material_lobes.cpp has single kinds of scattering, disney_lobes.cpp the
// principled material, layered_lobes.cpp what is made of other materials.
#pragma once

#include "shading/lobe_count.h"
#include "shading/materials.h"

namespace weft::shading {

/// From the roughness that users set to the microfacet distribution's width.
inline float alpha_of(float roughness) {
    return std::max(square(std::clamp(roughness, 0.f, 1.f)), 1e-3f);
}

struct LobeBuilder {
    Materials const& materials;
    SurfacePoint const& point;
    View const& view;
    Shading& to;
    Frame frame;                                       ///< of the surface or layer
    Color weight{1};                                   ///< what layers above leave of the light
    bool part = false;                                 ///< of another material, see add_presence
    std::vector<scene::Layer> const* layers = nullptr; ///< of a `layered` one
    std::vector<uint16_t> const* labels = nullptr;     ///< of the parts
    uint16_t label = 0;                                ///< of the layer that all of it is in
    LobeCount* count = nullptr; ///< where set, lobes are counted and not added

    void build(scene::MaterialId id) const;
    /// The same with the registers of the material's program filled.
    void build(CompiledMaterial const& material, Values const& values) const;
    /// The same for a part that gets the share `w` of the light, around `f`, in the layer `l`.
    void build_part(scene::MaterialId id, Color const& w, Frame const& f, uint16_t l) const;
    /// What the opacity of a part lets straight through, which leaves the rest of the weight, and
    /// what the part emits. The world looks after those of a whole material.
    template <class M>
    void add_presence(M const& m, Values const& at);
    /// The label of a part of this material, or else that of the whole.
    uint16_t label_of(size_t i) const { return (*labels)[i] ? (*labels)[i] : label; }

    void operator()(scene::Diffuse const& m, Values const& at) const;
    void operator()(scene::Conductor const& m, Values const& at) const;
    void operator()(scene::RoughConductor const& m, Values const& at) const;
    void operator()(scene::Dielectric const& m, Values const& at) const;
    void operator()(scene::RoughDielectric const& m, Values const& at) const;
    void operator()(scene::Principled const& m, Values const& at) const;
    void operator()(scene::Microfacet const& m, Values const& at) const;
    void operator()(scene::Translucent const& m, Values const& at) const;
    void operator()(scene::Transparent const& m, Values const& at) const;
    void operator()(scene::Hair const& m, Values const& at) const;
    void operator()(scene::Disney const& m, Values const& at) const;
    void operator()(scene::Layered const& m, Values const& at) const;
    void operator()(scene::Coat const& m, Values const& at) const;
    void operator()(scene::Mix const& m, Values const& at) const;
    void operator()(scene::Secondary const& m, Values const& at) const;
    void operator()(scene::VolumeBoundary const&, Values const&) const {}

    template <class L>
    void add(Color const& w, L const& lobe) const {
        if (count)
            count->add(w);
        else
            to.bsdf.add(weight * w, lobe, label);
    }
    /// Adds a lobe around `f`, the frame in use, and returns its albedo: what of the light does not
    /// get through to the layers below.
    template <class L>
    Color add_layer(Color const& w, L lobe, Frame const& f) const {
        Color const albedo = look_up_albedo(lobe, f.to_local(view.wo));
        if (count)
            count->add(w);
        else
            to.bsdf.add_looked_up(weight * w, lobe, label, albedo);
        return albedo;
    }
    /// How much light from everywhere a lobe around `f` sends towards wo.
    template <class L>
    Color albedo(L const& lobe, Frame const& f) const {
        return lobe.albedo(f.to_local(view.wo));
    }
    /// Around the world-space normal of a `normal` input; (0, 0, 0), nothing connected, is `frame`.
    Frame frame_around(Vec3 const& normal) const {
        return normal == Vec3(0) ? frame : shading_frame(point, normalize(normal), view);
    }
    /// The width of facets for a material's roughness, not below what the view asks for.
    float alpha(float roughness) const {
        return alpha_of(std::max(roughness, view.look.least_roughness));
    }
    /// Far index over near index.
    float relative_ior(float ior) const {
        return view.entering ? ior / view.ior_outside : view.ior_outside / ior;
    }
};

/// Widths along and across a brushed surface's tangent (Burley 2012, 5.4); both in [1e-3, 1].
struct Alphas {
    float x, y;
};
inline Alphas stretched_alphas(float roughness, float anisotropic) {
    float const alpha = alpha_of(roughness);
    float const aspect = std::sqrt(1 - 0.9f * std::clamp(anisotropic, 0.f, 1.f));
    return {std::min(alpha / aspect, 1.f), std::max(alpha * aspect, 1e-3f)};
}

inline Color unit(Color const& c) { return clamp(c, 0, 1); }
inline float unit(float x) { return std::clamp(x, 0.f, 1.f); }
/// 1 - c, at least 0.
inline Color rest_of(Color const& c) { return unit(Color(1) - c); }

/// What a clear layer of index `ior` lets through, in and out, of the light seen under `cos_o`: a
/// layer of thickness 1 lets `tint` through along the normal.
inline Color layer_transmittance(Color const& tint, float thickness, float ior, float cos_o) {
    if (tint == Color(1)) return tint;
    float const cos_t = safe_sqrt(1 - (1 - cos_o * cos_o) / square(ior));
    float const way = thickness / std::max(cos_t, 1e-3f);
    return {std::pow(tint.r, way), std::pow(tint.g, way), std::pow(tint.b, way)};
}

} // namespace weft::shading
