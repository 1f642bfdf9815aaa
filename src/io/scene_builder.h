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
#include "scene/display.h"

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
    std::vector<XmlElement const*> pictures;     ///< the <image>s; an ImageId is an index into them
    std::map<int32_t, PlacedDisplay> displays;   ///< of the pictures that have one, by ImageId
    std::map<int32_t, scene::ImageOutput> files; ///< the pictures that are files, by ImageId
    std::vector<std::string> warnings;
};

/// Collects the ids of `document.root`.
void index_ids(Document& document);

/// Whether files are read, or only looked for.
enum class Files { read, find };

class SceneBuilder {
  public:
    SceneBuilder(Document& document, scene::Scene& scene, Files files = Files::read)
        : document_(document), scene_(scene), facts_(scene), files_(files) {}

    /// Follows a `<ref>`; any other element is returned as it is.
    XmlElement const& resolve(XmlElement const& element) const;

    /// The object that an element (or the element it refers to) describes, read once.
    template <class Kind>
    schema::Id<Kind> object(XmlElement const& element);

    scene::Texture const& texture(scene::TextureId id) const {
        return scene_.textures[size_t(id.index)];
    }
    /// Returns the type of what a node gives.
    scene::ValueType type_of(scene::TextureId id) { return facts_.type_of(id); }

    /// Reads one element of a category with several types.
    template <class Variant>
    Variant read_variant(XmlElement const& element);
    template <class T>
    T read_struct(XmlElement const& element);

    /// Reads an object that nothing refers to, for its mistakes.
    void check_definition(XmlElement const& element);

    scene::Sampler sampler;                          ///< the last one read
    XmlElement const* scene_element = nullptr;       ///< the last one referred to
    XmlElement const* integrator_element = nullptr;  ///< likewise
    XmlElement const* postprocess_element = nullptr; ///< likewise

  private:
    /// Reads an object and appends it to the scene's vector of its kind.
    template <class Kind>
    int32_t add(Kind, XmlElement const& element);
    int32_t add(scene::InstanceKind, XmlElement const& element);
    int32_t add(scene::VolumeKind, XmlElement const& element);
    int32_t add(scene::ShapeKind, XmlElement const& element);
    int32_t add(scene::SamplerKindTag, XmlElement const& element);
    /// Scenes, images, integrators and postprocesses are read by whoever asked for them.
    int32_t add(scene::SceneKind, XmlElement const& element);
    int32_t add(scene::ImageKind, XmlElement const& element);
    int32_t add(scene::DisplayKind, XmlElement const& element);
    int32_t add(scene::IntegratorKind, XmlElement const& element);
    int32_t add(scene::PostprocessKind, XmlElement const& element);

    /// Reads the files that an object names. What it asks beside them is the business of
    /// scene/check.h.
    template <class T>
    void load(T&, XmlElement const&) {}
    void load(scene::ImageTexture& texture, XmlElement const& element);
    void load(scene::ThinLens& camera, XmlElement const& element);
    void load(scene::MeshShape& mesh, XmlElement const& element);
    void load(scene::Group& group, XmlElement const& element);
    void load(scene::IesLight& light, XmlElement const& element);
    void load(scene::Display& display, XmlElement const& element);
    void load(scene::ImageOutput& picture, XmlElement const& element);

    int32_t load_image(std::string const& path, scene::ColorSpace encoding, bool mip_levels,
                       SourceLocation const& where);
    /// The set of files that `path`, which holds <UDIM>, stands for.
    int32_t load_udim(std::string const& folder, std::string const& path,
                      scene::ColorSpace encoding, bool mip_levels, SourceLocation const& where);
    int32_t load_mesh(std::string const& path, SourceLocation const& where);

    Document& document_;
    scene::Scene& scene_;
    scene::Facts facts_;
    Files files_;
    int depth_ = 0; ///< of the object being read
    std::vector<PlacedDisplay> displays_;
    /// Elements already in the scene, by what they were read as; -1: being read.
    std::map<std::pair<XmlElement const*, std::string_view>, int32_t> read_;
};

} // namespace weft::io
