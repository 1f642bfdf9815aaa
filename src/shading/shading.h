// What a material says at a point: from parameters and textures to a list of lobes.
#pragma once

#include "lobes/bsdf.h"
#include "scene/material.h"
#include "shading/graph_compiler.h"
#include "shading/surface_point.h"

namespace weft::shading {

/// The indices of refraction on the two sides of a boundary, as `wo` finds them.
struct Boundary {
    bool entering = true;  ///< wo is on the front side, so that transmission goes in
    float ior_outside = 1; ///< of what surrounds the object here
};

struct Shading {
    lobes::Bsdf bsdf;
    Color emission; ///< towards wo
    float ior = 1;  ///< of the object's inside
    explicit Shading(lobes::Bsdf const& b) : bsdf(b) {}
};

/// The frame in which lobes work: around the shading normal on wo's side, bent just enough to
/// be visible from wo where interpolation turned it away (so that silhouettes are not black).
Frame shading_frame(SurfacePoint const& point, Vec3 const& wo, Vec3 const& ng_facing_wo);

/// A material whose inputs read the registers of its program.
struct CompiledMaterial {
    scene::Material parameters;
    Program program;
};
/// Throws InputError at `where` for a network of nodes that is too large.
CompiledMaterial compile(scene::Material const& material, GraphCompiler& compiler,
                         SourceLocation const& where);

/// Appends the material's lobes at `point`, seen from unit `wo`, to `bsdf`, and prepares it.
/// Returns the index of refraction of the object's inside (1 where light does not go in).
float add_lobes(CompiledMaterial const& material, SurfacePoint const& point, Vec3 const& wo,
                Boundary const& boundary, lobes::Bsdf& bsdf);

/// Index of refraction of a closed object of this material.
scene::Input<float> interior_ior(scene::Material const& material);

/// Whether the material has no surface of its own: rays pass straight on.
inline bool is_null_boundary(scene::Material const& material) {
    return std::holds_alternative<scene::VolumeBoundary>(material);
}

/// Whether light goes through into the object's inside.
inline bool is_transmissive(scene::Material const& material) {
    return std::holds_alternative<scene::Dielectric>(material) ||
           std::holds_alternative<scene::RoughDielectric>(material) || is_null_boundary(material);
}

} // namespace weft::shading
