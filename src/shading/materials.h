// What a material says at a point: from parameters and node networks to a list of lobes.
//
// Every material has one program for its own inputs. Materials made of others (layers, coats,
// mixtures) add the lobes of their parts with the weight that is left for each, so whatever an
// artist stacks ends up as one flat list.
#pragma once

#include "lobes/bsdf.h"
#include "scene/aov.h"
#include "scene/scene.h"
#include "shading/graph_compiler.h"
#include "shading/surface_point.h"

namespace weft::shading {

/// How much of a material is looked at; by default all of it.
struct Look {
    bool secondary = false;    ///< after a scattering: simpler stand-ins take a material's place
    float least_roughness = 0; ///< of all that reflects or lets through
    bool diffuse_only = false; ///< nothing mirrors or is glossy; light still goes straight on
    bool fold = false;         ///< bent normals fold light, whatever the material does with it
};

/// From where a point is looked at, and how.
struct View {
    Vec3 wo{0, 0, 1}; ///< unit
    Vec3 ng{0, 0, 1}; ///< unit, on wo's side: the surface's normal; see `surface_normal`
    lobes::BentNormals bent = lobes::BentNormals::Dropped;
    bool entering = true;  ///< wo is on the front side, so that transmission goes in
    float ior_outside = 1; ///< of what surrounds the object here
    Look look;
};

struct Shading {
    lobes::Bsdf bsdf;
    Color emission; ///< towards wo
    float ior = 1;  ///< of the object's inside; 1 where light does not go in
    explicit Shading(lobes::Bsdf const& b) : bsdf(b) {}
};

/// Returns the unit normal, on the side of the point's wo, that tells reflection from transmission:
/// that of the smooth surface where the point is lifted to it, else that of the geometry.
Vec3 surface_normal(SurfacePoint const& point, lobes::BentNormals bent);

/// Returns the frame in which lobes work. Its normal is `n`, a shading normal of the front, turned
/// to wo's side. Where bent normals are softened, `n` is turned back until it mirrors wo to above
/// the surface, and where they are folded, until it is just visible. s lies along the point's dpdu,
/// where that is known.
Frame shading_frame(SurfacePoint const& point, Vec3 const& n, View const& view);

/// Returns a list of no lobes yet around the point's own shading normal.
inline lobes::Bsdf empty_bsdf(SurfacePoint const& point, View const& view) {
    return lobes::Bsdf({shading_frame(point, point.ns, view), view.ng, view.bent});
}

/// A material whose inputs read the registers of its program.
struct CompiledMaterial {
    scene::Material parameters;
    std::vector<scene::Layer> layers; ///< of a `layered` one
    std::vector<uint16_t> labels;     ///< in Materials::labels, of its layers, coat or two parts
    std::vector<scene::MaterialId> parts; ///< what it is made of
    Program program;
    bool done = false; ///< compiled
    bool fits = false; ///< a Bsdf has room for it
    /// As a part of another material, for camera and for secondary rays; -1: not counted.
    std::array<int, 2> most_lobes{-1, -1};
};

class Materials {
  public:
    Materials() = default;
    explicit Materials(scene::Scene const& scene) : compiled_(scene.materials.size()) {}

    /// Compiles a material and all that it is made of, unless that is done. Throws InputError for
    /// a network of nodes that is too large, and for a material that may have more lobes than a
    /// Bsdf has room for.
    void compile(scene::Scene const& scene, scene::MaterialId id, GraphCompiler& compiler);

    /// Returns what the programs of a compiled material and of its parts need to know of a point.
    Needs needs(scene::MaterialId id) const;
    /// Returns whether the material or a part needs the direction in which u grows.
    bool uses_tangents(scene::MaterialId id) const;
    /// Adds the lobes at `point` and prepares them, adds emission, and sets the index inside.
    void shade(scene::MaterialId id, SurfacePoint const& point, View const& view,
               Shading& to) const;

    /// Returns the fraction of light that goes straight through towards view.wo: the weights of the
    /// `Transparent` lobes.
    Color straight(scene::MaterialId id, SurfacePoint const& point, View const& view) const;

    /// The names of layers, in the order of `lobes::Lobe::layer`.
    std::vector<std::string> const& labels() const { return labels_; }

    CompiledMaterial const& operator[](scene::MaterialId id) const {
        return compiled_[size_t(id.index)];
    }

  private:
    void compile_with_parts(scene::Scene const& scene, scene::MaterialId id,
                            GraphCompiler& compiler);
    uint16_t label_index(std::string const& label, SourceLocation const& where);

    std::vector<CompiledMaterial> compiled_; ///< as the scene's
    std::vector<std::string> labels_{scene::kDefaultGroup};
};

} // namespace weft::shading
