// Turns the values of one material at one point into weighted lobes. An overload per material; the
// sources group them: material_lobes.cpp has single kinds of scattering, disney_lobes.cpp the
// principled material, layered_lobes.cpp what is made of other materials.
#pragma once

#include "shading/lobe_count.h"
#include "shading/materials.h"

namespace weft::shading {

/// Returns the alpha of a microfacet distribution for the roughness that users set.
inline float alpha_of(float roughness) {
    return std::max(square(std::clamp(roughness, 0.f, 1.f)), 1e-3f);
}

struct LobeBuilder {
    Materials const& materials;
    SurfacePoint const& point;
    View const& view;
    Shading& to;
    Frame frame;       ///< of the surface or layer
    Color weight{1};   ///< the fraction of light that the layers above let through
    bool part = false; ///< of another material, see add_presence
    std::vector<scene::Layer> const* layers = nullptr; ///< of the `layered` material being built
    std::vector<uint16_t> const* labels = nullptr; ///< of its parts, as MaterialTraits lists them
    uint16_t label = 0;         ///< of the innermost labelled layer around this material; 0: none
    LobeCount* count = nullptr; ///< where set, lobes are counted and not added

    void build(scene::MaterialId id) const;
    /// The same with the registers of the material's program filled.
    void build(CompiledMaterial const& material, Values const& values) const;
    /// Builds a part of this material, which gets the share `w` of the light. Its lobes lie around
    /// `f` and carry the label `l`.
    void build_part(scene::MaterialId id, Color const& w, Frame const& f, uint16_t l) const;
    /// Adds what a part's opacity lets straight through, leaves the rest of the weight to the part,
    /// and adds what it emits. The world looks after opacity and emission of a whole material.
    template <class M>
    void add_presence(M const& m, Values const& at);
    /// Returns the label of the i-th part, or this material's own where the part has none.
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
    /// Returns the albedo of a lobe around `f` for the view's wo.
    template <class L>
    Color albedo(L const& lobe, Frame const& f) const {
        return lobe.albedo(f.to_local(view.wo));
    }
    /// Returns the shading frame around the value of a `normal` input, in world space. (0, 0, 0),
    /// where nothing is connected, gives the current frame.
    Frame frame_around(Vec3 const& normal) const {
        return normal == Vec3(0) ? frame : shading_frame(point, normalize(normal), view);
    }
    /// Returns the alpha for a material's roughness, or for the view's least roughness if greater.
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

/// Returns the fraction of light that a clear layer of index `ior` lets through on its way in and
/// out, seen under the cosine `cos_o`. A layer of thickness 1 lets `tint` through along the normal.
inline Color layer_transmittance(Color const& tint, float thickness, float ior, float cos_o) {
    if (tint == Color(1)) return tint;
    float const cos_t = safe_sqrt(1 - (1 - cos_o * cos_o) / square(ior));
    float const way = thickness / std::max(cos_t, 1e-3f);
    return {std::pow(tint.r, way), std::pow(tint.g, way), std::pow(tint.b, way)};
}

} // namespace weft::shading
