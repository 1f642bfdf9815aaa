// Materials of a glTF file (section 3.9 and appendix B of the specification, and the ratified
// KHR_materials extensions) as `disney` materials.
//
// Where both systems mean the same, the number is taken over; elsewhere:
//   * anisotropy: glTF has alpha_t = lerp(r^2, 1, s^2), alpha_b = r^2; ours is alpha = r^2 times
//     and by sqrt(1 - 0.9 a)^(1/2). Of equal ratio and product are
//     a = (1 - alpha_b / alpha_t) / 0.9 and r' = (alpha_t alpha_b)^(1/4).
//   * specular: our 0.5 is glTF's 1.
//   * sheen: its colour is our tint times the strength.
//   * clear coat: without a normal map of its own it keeps the mesh's normals, whatever the base's.
//   * vertex colours are a factor on the base colour, their alpha one on the opacity.
//   * iridescence is there or not: a factor between has no counterpart.
//   * volume: absorption = -ln(attenuationColor) / attenuationDistance. How thick the body is the
//     geometry says, so thicknessFactor only tells solid (above 0) from thinWalled.
//   * unlit: the base colour shines by itself, and is no lamp for others.
// Emission 1 is a radiance of 1 W/(m^2 sr): unlike lamps, materials are not photometric in
// practice. Both sides of every surface are there, whatever `doubleSided` says. Occlusion is what
// the renderer computes.
#pragma once

#include "io/gltf_texture.h"

namespace weft::io::gltf {

/// What an instance takes from its material.
struct Surface {
    scene::MaterialId bsdf;
    scene::MediumId medium;
    MeshUvs uvs;
    float radiance = 0; ///< with which it lights others, at most
    bool is_unlit = false;
};

class MaterialReader {
  public:
    MaterialReader(File& file, scene::Scene& scene, image::TextureCache& images)
        : file_(file), scene_(scene), textures_(file, scene, images) {}

    /// The material of this index (without an index, glTF's default material) for meshes that have
    /// `vertices`; read once for each.
    Surface const& surface(std::optional<size_t> index, VertexData const& vertices);

  private:
    Surface read(Object& material, VertexData const& vertices);
    void read_base(Object& material, VertexData const& vertices, scene::Disney& to);
    void read_opacity(Object& material, VertexData const& vertices, scene::Disney& to);
    void read_emission(Object& material, scene::Disney& to, Surface& surface);
    void read_coat_and_sheen(Object& material, scene::Disney& to);
    void read_specular(Object& material, scene::Disney& to);
    void read_anisotropy(Object& material, scene::Disney& to);
    void read_iridescence(Object& material, scene::Disney& to);
    void read_transmission(Object& material, scene::Disney& to, Surface& surface);
    /// A property of the vertices; 1 on other meshes.
    scene::TextureId vertex_property(Object const& material, char const* name,
                                     scene::nodes::AnyType type);

    File& file_;
    scene::Scene& scene_;
    TextureReader textures_;
    std::map<std::pair<std::optional<size_t>, VertexData>, Surface> surfaces_;
};

} // namespace weft::io::gltf
