// Textures of a glTF file (section 3.8 of the specification) as inputs of materials.
//
// glTF packs several quantities into the channels of one image, multiplies each by a factor, and
// places each use of a texture by itself. All of that becomes nodes: `image`, `extract`,
// `multiply`, `place2d` (KHR_texture_transform), `normalmap`; an image is loaded once. One set of
// uvs is the mesh's own; further ones are vertex properties of the name "TEXCOORD_n".
#pragma once

#include "image/texture_cache.h"
#include "io/gltf_graph.h"
#include "io/gltf_mesh.h"

namespace weft::io::gltf {

/// What a number is read from.
enum class Channel { red, green, blue, alpha };

class TextureReader {
  public:
    TextureReader(File& file, scene::Scene& scene, image::TextureCache& images)
        : nodes(scene), file_(file), scene_(scene), images_(images) {}

    /// To be called before the textures of a material for meshes that have `vertices`. `uv_set`
    /// is the mesh's own set of uvs.
    void begin(VertexData const& vertices, uint64_t uv_set);
    /// Returns what the textures read since then need of the mesh.
    MeshUvs const& uvs() const { return uvs_; }

    /// `factor` times the colour of the texture that the texture info `key` of `owner` names
    /// (sRGB), or the factor alone. Throws InputError for a broken reference or image, as the next
    /// do.
    scene::Input<Color> color(Object& owner, char const* key, Color const& factor);
    /// `factor` times a channel of the texture, or the factor alone.
    scene::Input<float> number(Object& owner, char const* key, Channel channel, float factor);
    /// The shading normal of a tangent-space normal map; unconnected where there is none.
    scene::Input<Vec3> normal(Object& owner, char const* key);

    Nodes nodes;

  private:
    enum class Wrap { repeat, clamp, mirror };
    /// An element of "textures".
    struct Source {
        std::optional<size_t> image;
        Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
        scene::TextureFilter filter = scene::TextureFilter::mipmap;
    };
    struct Lookup {
        image::Transfer transfer = image::Transfer::linear;
        image::Channels channels = image::Channels::color;
        auto operator<=>(Lookup const&) const = default;
    };
    /// Where a texture info wants its texture. KHR_texture_transform is about glTF's uv, whose v
    /// runs downwards.
    struct Placement {
        uint64_t set = 0;    ///< of uvs
        double rotation = 0; ///< radians
        std::array<double, 2> offset{0, 0}, scale{1, 1};
        auto operator<=>(Placement const&) const = default;
    };
    /// The node that looks the texture up; none where there is no texture.
    scene::TextureId look_up(Object& owner, char const* key, Lookup const& lookup);
    Source const& source(size_t texture);
    void read_sampler(Object& texture, Source& to);
    scene::TextureId image(Source const& source, scene::TextureId uv, Lookup const& lookup);
    int32_t load(size_t image, Lookup const& lookup, bool mip_levels);
    Placement placement(Object& info);
    scene::TextureId texcoord(Placement const& placement);
    scene::TextureId wrap(Source const& source, scene::TextureId uv);

    File& file_;
    scene::Scene& scene_;
    image::TextureCache& images_;
    VertexData vertices_;
    MeshUvs uvs_;
    std::map<size_t, Source> sources_;
    /// Nodes of this material: uses of a texture that are placed alike share theirs.
    std::map<Placement, scene::TextureId> texcoords_;
    std::map<std::tuple<size_t, int32_t, Lookup>, scene::TextureId> lookups_;
};

} // namespace weft::io::gltf
