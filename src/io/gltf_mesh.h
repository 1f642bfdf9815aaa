// Triangle meshes from the primitives of a glTF file (section 3.7.2 of the specification).
//
// Triangles, strips and fans; positions, normals, uvs, COLOR_0. Of several sets of uvs one is the
// mesh's own, others are properties, as is the alpha of colours.
// Tangents are not read: Weft derives them from the uvs, which is what MikkTSpace does up to
// smoothing. Points and lines, morph targets and further attributes are told and left out.
#pragma once

#include "io/gltf_file.h"
#include "scene/mesh.h"

namespace weft::io::gltf {

/// What the vertices of a primitive have for its material.
struct VertexData {
    int color_components = 0; ///< of COLOR_0: 3, 4, or 0 for none
    uint64_t uv_sets = 0;     ///< TEXCOORD_0 to TEXCOORD_n - 1 are there
    auto operator<=>(VertexData const&) const = default;
};
VertexData vertex_data(File& file, Object const& primitive);

/// The sets of uvs that a material's textures are looked up with.
struct MeshUvs {
    uint64_t own = 0; ///< the mesh's own, which make its tangents
    std::set<uint64_t> further;
};
/// The names of further sets and of the colours' alpha among the mesh's properties.
inline std::string uv_property(uint64_t set) { return "TEXCOORD_" + std::to_string(set); }
inline constexpr char kAlphaProperty[] = "COLOR_0.a";

/// The mesh of one primitive; nothing, with a warning, where it makes no triangles. Without
/// normals it is faceted, as the specification says. `material` is left to the caller. Throws
/// InputError.
std::optional<scene::Mesh> read_primitive(File& file, Object& primitive, MeshUvs const& uvs);

} // namespace weft::io::gltf
