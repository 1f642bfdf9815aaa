#include "io/scene_builder.h"

#include <algorithm>
#include <filesystem>

#include "io/append.h"
#include "io/gltf.h"
#include "io/ies.h"
#include "io/obj.h"
#include "io/object_reader_impl.h"
#include "io/ply.h"

namespace weft::io {

namespace fs = std::filesystem;

void index_ids(Document& document) {
    std::vector<XmlElement const*> stack{document.root.get()};
    while (!stack.empty()) {
        XmlElement const* e = stack.back();
        stack.pop_back();
        if (XmlAttribute const* id = e->find("id"); id && e->tag != "ref")
            document.ids.emplace(id->value, e);
        for (size_t i = e->children.size(); i-- > 0;) stack.push_back(e->children[i].get());
    }
}

XmlElement const& SceneBuilder::resolve(XmlElement const& element) const {
    if (element.tag != "ref") return element;
    XmlAttribute const* id = element.find("id");
    if (!id) throw InputError(element.where, "<ref> expects id=\"...\"");
    for (XmlAttribute const& a : element.attributes)
        if (a.name != "id" && a.name != "name")
            throw InputError(a.where, "unknown parameter " + in_quotes(a.name) +
                                          " of <ref>; known: id, name");
    if (!element.children.empty())
        throw InputError(element.children.front()->where,
                         "<ref> has no child tags, found " +
                             element_title(*element.children.front()));
    auto const [first, last] = document_.ids.equal_range(id->value);
    if (first == last) {
        std::vector<std::string> known;
        for (auto const& entry : document_.ids)
            if (known.empty() || known.back() != entry.first) known.push_back(entry.first);
        throw InputError(id->where, "no object has the id " + in_quotes(id->value) +
                                        suggestion(id->value, known));
    }
    if (std::next(first) != last)
        throw InputError(id->where, "the id " + in_quotes(id->value) +
                                        " is ambiguous: it is given at " +
                                        to_string(first->second->where) + " and at " +
                                        to_string(std::next(first)->second->where));
    return *first->second;
}

namespace {

/// Calls `read`; what is wrong with the file is told with the place that names it.
template <class Read>
auto read_at(SourceLocation const& where, Read const& read) {
    try {
        return read();
    } catch (InputError const& e) {
        throw InputError(std::string(e.what()) + " (file named at " + to_string(where) + ")");
    }
}

} // namespace

int32_t SceneBuilder::add(scene::VolumeKind kind, XmlElement const& e) {
    if (e.get("type") == "grid")
        throw InputError(e.where,
                         "<volume type=\"grid\"> is not supported yet; expected type=\"constant\"");
    return add<scene::VolumeKind>(kind, e);
}

/// Teams of lightwave have the grid of densities as a shape.
int32_t SceneBuilder::add(scene::ShapeKind kind, XmlElement const& e) {
    if (e.get("type") == "grid")
        throw InputError(e.where,
                         "<shape type=\"grid\"> is a medium whose density varies, which is "
                         "not supported yet; expected a closed shape with a `volume` bsdf");
    return add<scene::ShapeKind>(kind, e);
}

/// A bare shape stands for an instance of it.
int32_t SceneBuilder::add(scene::InstanceKind kind, XmlElement const& e) {
    if (e.tag != "shape") return add<scene::InstanceKind>(kind, e);
    scene::Instance instance;
    instance.shape = object<scene::ShapeKind>(e);
    return scene::add(scene_, kind, std::move(instance), e.where, std::string(e.get("id"))).index;
}

int32_t SceneBuilder::add(scene::SamplerKindTag, XmlElement const& e) {
    sampler = read_variant<scene::Sampler>(e);
    return 0;
}

int32_t SceneBuilder::add(scene::SceneKind, XmlElement const& e) {
    scene_element = &e;
    return 0;
}

int32_t SceneBuilder::add(scene::ImageKind, XmlElement const& e) {
    auto const output = read_struct<scene::ImageOutput>(e);
    int32_t const index = index_of(document_.pictures, &e);
    if (output.display) document_.displays[index] = displays_[size_t(output.display.index)];
    if (!output.filename.path.empty()) document_.files[index] = output;
    return index;
}

int32_t SceneBuilder::add(scene::DisplayKind, XmlElement const& e) {
    return append(displays_, PlacedDisplay{read_struct<scene::Display>(e), e.where});
}

int32_t SceneBuilder::add(scene::IntegratorKind, XmlElement const& e) {
    integrator_element = &e;
    return 0;
}

int32_t SceneBuilder::add(scene::PostprocessKind, XmlElement const& e) {
    postprocess_element = &e;
    return 0;
}

int32_t SceneBuilder::load_image(std::string const& path, scene::ColorSpace encoding,
                                 bool mip_levels, SourceLocation const& where) {
    return index_of(scene_.images, read_at(where, [&] {
                        return document_.textures->load(path, scene::encoding_of(encoding),
                                                        mip_levels);
                    }));
}

int32_t SceneBuilder::load_udim(std::string const& folder, std::string const& path,
                                scene::ColorSpace encoding, bool mip_levels,
                                SourceLocation const& where) {
    size_t const at = path.find(scene::kUdim);
    std::vector<scene::UdimTile> tiles;
    for (int number = 1001; number <= 1100; ++number) {
        std::string file = path;
        file.replace(at, scene::kUdim.size(), std::to_string(number));
        if (!fs::exists(fs::path(folder) / file)) continue;
        std::string const found = existing_file(folder, file, where);
        tiles.push_back(
            {number, files_ == Files::read ? load_image(found, encoding, mip_levels, where) : -1});
    }
    if (tiles.empty())
        throw InputError(where, "expected files " + in_quotes(path) +
                                    " with <UDIM> from 1001 to 1100, found none");
    return append(scene_.udims, std::move(tiles));
}

int32_t SceneBuilder::load_mesh(std::string const& path, SourceLocation const& where) {
    auto& mesh = document_.meshes[path];
    if (!mesh) {
        std::string const ending = fs::path(path).extension().string();
        bool const obj = ending == ".obj" || ending == ".OBJ";
        mesh = std::make_shared<scene::Mesh const>(
            read_at(where, [&] { return obj ? read_obj(path) : read_ply(path); }));
    }
    return index_of(scene_.meshes, mesh);
}

void SceneBuilder::load(scene::ImageTexture& texture, XmlElement const& element) {
    SourceLocation const& where = location_of(element, "filename");
    auto const encoding = texture.linear ? scene::ColorSpace::lin_rec709 : texture.color_space;
    bool const mip_levels = texture.filter == scene::TextureFilter::mipmap;
    if (texture.filename.path.find(scene::kUdim) != std::string::npos) {
        texture.filename.resource =
            load_udim(element.folder, texture.filename.path, encoding, mip_levels, where);
        return;
    }
    std::string const path = existing_file(element.folder, texture.filename.path, where);
    if (files_ == Files::read)
        texture.filename.resource = load_image(path, encoding, mip_levels, where);
}

void SceneBuilder::load(scene::ThinLens& camera, XmlElement const& element) {
    if (camera.bokeh.path.empty()) return;
    SourceLocation const& where = location_of(element, "bokeh");
    std::string const path = existing_file(element.folder, camera.bokeh.path, where);
    if (files_ == Files::read)
        camera.bokeh.resource = load_image(path, scene::ColorSpace::srgb_texture, false, where);
}

void SceneBuilder::load(scene::MeshShape& shape, XmlElement const& element) {
    SourceLocation const& where = location_of(element, "filename");
    std::string const path = existing_file(element.folder, shape.filename.path, where);
    if (files_ == Files::read) shape.filename.resource = load_mesh(path, where);
}

void SceneBuilder::load(scene::Group& group, XmlElement const& element) {
    if (group.filename.path.empty()) return;
    SourceLocation const& where = location_of(element, "filename");
    std::string const path = existing_file(element.folder, group.filename.path, where);
    if (!is_gltf(path))
        throw InputError(where, "'filename' of " + element_title(element) +
                                    " expects a .gltf or .glb file, found " +
                                    in_quotes(group.filename.path));
    if (files_ != Files::read) return;
    GltfContents const contents =
        read_at(where, [&] { return read_gltf(path, scene_, *document_.textures); });
    group.instances.insert(group.instances.end(), contents.instances.begin(),
                           contents.instances.end());
    for (std::string const& warning : contents.warnings) document_.warnings.push_back(warning);
    if (!contents.lights.empty())
        document_.warnings.push_back(to_string(where) +
                                     ": the file's lamps are left out: a group holds instances");
}

void SceneBuilder::load(scene::Display& display, XmlElement const& element) {
    if (display.ocio.path.empty()) return;
    display.ocio.path =
        existing_file(element.folder, display.ocio.path, location_of(element, "ocio"));
}

void SceneBuilder::load(scene::ImageOutput& picture, XmlElement const& element) {
    if (picture.filename.path.empty()) {
        if (picture.linear)
            throw InputError(location_of(element, "linear"),
                             "'linear' of <image> is for a picture that is read from a 'filename'");
        return;
    }
    picture.filename.path =
        existing_file(element.folder, picture.filename.path, location_of(element, "filename"));
}

void SceneBuilder::load(scene::IesLight& light, XmlElement const& element) {
    SourceLocation const& where = location_of(element, "filename");
    std::string const path = existing_file(element.folder, light.filename.path, where);
    if (files_ != Files::read) return;
    auto& lamp = document_.photometries[path];
    if (!lamp)
        lamp = std::make_shared<scene::Photometry const>(
            read_at(where, [&] { return read_ies(path); }));
    light.filename.resource = index_of(scene_.photometries, lamp);
}

void SceneBuilder::check_definition(XmlElement const& element) {
    if (element.tag == "transform") {
        read_transform(element);
        return;
    }
    bool found = false;
    auto check = [&](auto kind) {
        using Kind = decltype(kind);
        if (found || element.tag != Kind::category) return;
        object<Kind>(element);
        found = true;
    };
    auto check_all = [&](auto... kinds) { (check(kinds), ...); };
    check_all(schema::TextureKind{}, scene::CameraKind{}, scene::MaterialKind{},
              scene::EmissionKind{}, scene::VolumeKind{}, scene::MediumKind{}, scene::ShapeKind{},
              scene::InstanceKind{}, scene::LightKind{}, scene::ImageKind{}, scene::DisplayKind{});
}

} // namespace weft::io
