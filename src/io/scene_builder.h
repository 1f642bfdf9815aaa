// Fills one `scene::Scene` from elements: which tag and type become which struct, references by
// id, and the files that objects name.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "image/texture_cache.h"
#include "io/object_reader.h"
#include "scene/bloom.h"
#include "scene/display.h"
#include "scene/scene.h"

namespace weft::io {

/// A <display>, and where it is written.
struct PlacedDisplay {
    scene::Display display;
    SourceLocation where;
};

/// What the scenes of one document share: the elements with an id, and the files read so far.
struct Document {
    std::unique_ptr<XmlElement> root;
    std::multimap<std::string, XmlElement const*, std::less<>> ids;
    std::map<std::string, std::shared_ptr<scene::Mesh const>> meshes;             ///< by path
    std::map<std::string, std::shared_ptr<scene::Photometry const>> photometries; ///< likewise
    std::shared_ptr<image::TextureCache> textures; ///< the images among them
    std::set<XmlElement const*> used;              ///< the elements that became objects
    std::vector<XmlElement const*> pictures;   ///< the <image>s; an ImageId is an index into them
    std::map<int32_t, PlacedDisplay> displays; ///< of the pictures that have one, by ImageId
    std::vector<std::string> warnings;
};

/// Collects the ids of `document.root`.
void index_ids(Document& document);

/// Whether files are read, or only looked for.
enum class Files { read, find };

class SceneBuilder {
  public:
    SceneBuilder(Document& document, scene::Scene& scene, Files files = Files::read)
        : document_(document), scene_(scene), files_(files) {}

    /// Follows a `<ref>`; any other element is returned as it is.
    XmlElement const& resolve(XmlElement const& element) const;

    /// The object that an element (or the element it refers to) describes, read once.
    template <class Kind>
    schema::Id<Kind> object(XmlElement const& element);

    scene::Texture const& texture(scene::TextureId id) const {
        return scene_.textures[size_t(id.index)];
    }
    /// What a node gives.
    scene::ValueType texture_type(scene::TextureId id) const {
        return texture_types_[size_t(id.index)];
    }

    /// Reads one element of a category with several types.
    template <class Variant>
    Variant read_variant(XmlElement const& element);
    template <class T>
    T read_struct(XmlElement const& element);

    /// Reads an object that nothing refers to, for its mistakes.
    void check_definition(XmlElement const& element);

    scene::Sampler sampler;                         ///< the last one read
    XmlElement const* scene_element = nullptr;      ///< the last one referred to
    XmlElement const* integrator_element = nullptr; ///< likewise

  private:
    int32_t add(schema::TextureKind, XmlElement const& element);
    int32_t add(scene::CameraKind, XmlElement const& element);
    int32_t add(scene::MaterialKind, XmlElement const& element);
    int32_t add(scene::LayerKind, XmlElement const& element);
    int32_t add(scene::EmissionKind, XmlElement const& element);
    int32_t add(scene::VolumeKind, XmlElement const& element);
    int32_t add(scene::MediumKind, XmlElement const& element);
    int32_t add(scene::ShapeKind, XmlElement const& element);
    int32_t add(scene::InstanceKind, XmlElement const& element);
    int32_t add(scene::LightKind, XmlElement const& element);
    int32_t add(scene::PortalKind, XmlElement const& element);
    int32_t add(scene::SamplerKindTag, XmlElement const& element);
    /// Scenes, images and integrators are read by whoever asked for them.
    int32_t add(scene::SceneKind, XmlElement const& element);
    int32_t add(scene::ImageKind, XmlElement const& element);
    int32_t add(scene::DisplayKind, XmlElement const& element);
    int32_t add(scene::IntegratorKind, XmlElement const& element);

    /// What a type needs beyond its parameters: files, and rules between parameters.
    template <class T>
    void complete(T&, XmlElement const&) {}
    void complete(scene::Instance& instance, XmlElement const& element);
    void complete(scene::nodes::Convert& node, XmlElement const& element);
    void complete(scene::ImageTexture& texture, XmlElement const& element);
    void complete(scene::Layer& layer, XmlElement const& element);
    void complete(scene::Layered& material, XmlElement const& element);
    void complete(scene::Coat& material, XmlElement const& element);
    void complete(scene::Mix& material, XmlElement const& element);
    void complete(scene::Secondary& material, XmlElement const& element);
    void complete(scene::ThinLens& camera, XmlElement const& element);
    void complete(scene::MeshShape& mesh, XmlElement const& element);
    void complete(scene::Group& group, XmlElement const& element);
    void complete(scene::PointLight& light, XmlElement const& element);
    void complete(scene::DirectionalLight& light, XmlElement const& element);
    void complete(scene::SpotLight& light, XmlElement const& element);
    void complete(scene::IesLight& light, XmlElement const& element);
    void complete(scene::AreaLight& light, XmlElement const& element);
    void complete(scene::SkyLight& light, XmlElement const& element);
    void complete(scene::Portal& portal, XmlElement const& element);
    void complete(scene::Bloom& bloom, XmlElement const& element);
    void complete(scene::Display& display, XmlElement const& element);
    void complete(scene::SceneContents& contents, XmlElement const& element);

    /// Throws where a part of a material is what only whole materials can be.
    void check_part(scene::MaterialId part, XmlElement const& element) const;
    /// Throws where inputs of a node that takes any type do not go together.
    template <class Node>
    void check_input_types(Node& node, XmlElement const& element) const;

    /// What an instance amounts to, the members of groups included.
    struct Summary {
        double objects; ///< may exceed any integer
        bool emits;
    };
    Summary summary(scene::Instance const& instance) const;
    int32_t load_image(std::string const& path, scene::ColorSpace encoding, bool mip_levels,
                       SourceLocation const& where);
    /// The set of files that `path`, which holds <UDIM>, stands for.
    int32_t load_udim(std::string const& folder, std::string const& path,
                      scene::ColorSpace encoding, bool mip_levels, SourceLocation const& where);
    int32_t load_mesh(std::string const& path, SourceLocation const& where);

    Document& document_;
    scene::Scene& scene_;
    Files files_;
    int depth_ = 0; ///< of the object being read
    std::vector<PlacedDisplay> displays_;
    std::vector<Summary> summaries_; ///< one per instance of the scene
    std::vector<scene::ValueType> texture_types_;
    /// Elements already in the scene, by what they were read as; -1: being read.
    std::map<std::pair<XmlElement const*, std::string_view>, int32_t> read_;
};

} // namespace weft::io
