#include "io/scene_builder.h"

#include <filesystem>

#include "io/object_reader_impl.h"
#include "io/obj.h"
#include "io/ply.h"

namespace weft::io {

namespace fs = std::filesystem;

void index_ids(Document& document) {
    std::vector<XmlElement const*> stack{document.root.get()};
    while (!stack.empty()) {
        XmlElement const* e = stack.back();
        stack.pop_back();
        if (XmlAttribute const* id = e->find("id"); id && e->tag != "ref") document.ids.emplace(id->value, e);
        for (auto const& child : e->children) stack.push_back(child.get());
    }
}

XmlElement const& SceneBuilder::resolve(XmlElement const& element) const {
    if (element.tag != "ref") return element;
    XmlAttribute const* id = element.find("id");
    if (!id) throw InputError(element.where, "<ref> expects id=\"...\"");
    for (XmlAttribute const& a : element.attributes)
        if (a.name != "id" && a.name != "name")
            throw InputError(a.where, "unknown parameter '" + a.name + "' of <ref>; known: id, name");
    auto const [first, last] = document_.ids.equal_range(id->value);
    if (first == last) {
        std::vector<std::string> known;
        for (auto const& [name, target] : document_.ids)
            if (known.empty() || known.back() != name) known.push_back(name);
        throw InputError(id->where, "no object has the id '" + id->value + "'" + suggestion(id->value, known));
    }
    if (std::next(first) != last)
        throw InputError(id->where, "the id '" + id->value + "' is ambiguous: it is given at " + to_string(first->second->where) +
                                        " and at " + to_string(std::next(first)->second->where));
    return *first->second;
}

Color const* SceneBuilder::constant_texture(schema::Id<schema::TextureKind> id) const {
    auto const* constant = std::get_if<scene::ConstantTexture>(&scene_.textures[size_t(id.index)]);
    return constant ? &constant->value : nullptr;
}

namespace {

template <class T>
int32_t push(std::vector<T>& to, T value) {
    to.push_back(std::move(value));
    return int32_t(to.size()) - 1;
}

/// Screen colours to linear ones. They are integers over 255 or 65535, so a table has them all.
void decode(image::Image& image, scene::ColorSpace from) {
    std::vector<float> table(65536);
    for (size_t i = 0; i < table.size(); ++i) {
        float const v = float(i) / 65535;
        table[i] = from == scene::ColorSpace::srgb_texture ? srgb_to_linear(v) : std::pow(v, 2.2f);
    }
    int const colors = image.channels >= 3 ? 3 : 1;
    for (size_t i = 0; i < image.pixels.size(); i += size_t(image.channels))
        for (int c = 0; c < colors; ++c) {
            float& v = image.pixels[i + size_t(c)];
            v = table[size_t(std::clamp(v, 0.f, 1.f) * 65535 + 0.5f)];
        }
    image.is_srgb_encoded = false;
}

/// The one type that a category with a single type may name.
void expect_type(XmlElement const& e, std::string const& type) {
    XmlAttribute const* a = e.find("type");
    if (!a) throw InputError(e.where, "<" + e.tag + "> expects type=\"" + type + "\"");
    if (a->value != type)
        throw InputError(a->where, "unknown type '" + a->value + "' of <" + e.tag + ">" + suggestion(a->value, std::vector{type}));
}

} // namespace

int32_t SceneBuilder::add(schema::TextureKind, XmlElement const& e) { return push(scene_.textures, read_variant<scene::Texture>(e)); }
int32_t SceneBuilder::add(scene::CameraKind, XmlElement const& e) { return push(scene_.cameras, read_variant<scene::Camera>(e)); }
int32_t SceneBuilder::add(scene::MaterialKind, XmlElement const& e) { return push(scene_.materials, read_variant<scene::Material>(e)); }
int32_t SceneBuilder::add(scene::ShapeKind, XmlElement const& e) { return push(scene_.shapes, read_variant<scene::Shape>(e)); }

int32_t SceneBuilder::add(scene::EmissionKind, XmlElement const& e) {
    expect_type(e, "lambertian");
    return push(scene_.emissions, read_struct<scene::LambertianEmission>(e));
}

int32_t SceneBuilder::add(scene::VolumeKind, XmlElement const& e) {
    if (e.get("type") == "grid")
        throw InputError(e.where, "<volume type=\"grid\"> is not supported yet; expected type=\"constant\"");
    expect_type(e, "constant");
    return push(scene_.volumes, read_struct<scene::ConstantVolume>(e));
}

int32_t SceneBuilder::add(scene::MediumKind, XmlElement const& e) {
    expect_type(e, "homogeneous");
    return push(scene_.media, read_struct<scene::HomogeneousMedium>(e));
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
    read_struct<scene::ImageOutput>(e);
    image_element = &e;
    return 0;
}

int32_t SceneBuilder::add(scene::InstanceKind, XmlElement const& e) {
    scene::Instance instance;
    if (e.tag == "shape") instance.shape = object<scene::ShapeKind>(e);
    else instance = read_struct<scene::Instance>(e);
    scene_.instance_locations.push_back(e.where);
    scene_.instance_names.emplace_back(e.get("id"));
    return push(scene_.instances, std::move(instance));
}

int32_t SceneBuilder::add(scene::LightKind, XmlElement const& e) {
    scene::Light light = read_variant<scene::Light>(e);
    scene_.light_locations.push_back(e.where);
    return push(scene_.lights, std::move(light));
}

std::string SceneBuilder::find_file(scene::FileName const& file, XmlElement const& element) const {
    fs::path const path = (fs::path(element.folder) / file.path).lexically_normal();
    std::error_code error;
    if (fs::is_regular_file(path, error)) return path.string();
    SourceLocation where = element.where;
    for (XmlAttribute const& a : element.attributes)
        if (a.value == file.path) where = a.where;
    for (auto const& child : element.children)
        if (child->get("value") == file.path) where = child->where;
    throw InputError(where, "expected a file at '" + path.string() + "', found " + (fs::is_directory(path, error) ? "a folder" : "none"));
}

int32_t SceneBuilder::load_image(scene::FileName const& file, scene::ColorSpace encoding, XmlElement const& element) {
    std::string const path = find_file(file, element);
    auto& image = document_.images[path + " " + schema::TextForm<scene::ColorSpace>::write(encoding)];
    if (!image) {
        image::Image loaded = image::read_image(path);
        if (loaded.is_srgb_encoded && encoding != scene::ColorSpace::lin_rec709) decode(loaded, encoding);
        image = std::make_shared<image::Image const>(std::move(loaded));
    }
    for (size_t i = 0; i < scene_.images.size(); ++i)
        if (scene_.images[i] == image) return int32_t(i);
    return push(scene_.images, image);
}

void SceneBuilder::complete(scene::ImageTexture& texture, XmlElement const& element) {
    texture.filename.resource = load_image(texture.filename, texture.linear ? scene::ColorSpace::lin_rec709 : texture.color_space, element);
}

void SceneBuilder::complete(scene::ThinLens& camera, XmlElement const& element) {
    if (!camera.bokeh.path.empty()) camera.bokeh.resource = load_image(camera.bokeh, scene::ColorSpace::srgb_texture, element);
}

void SceneBuilder::complete(scene::MeshShape& shape, XmlElement const& element) {
    std::string const path = find_file(shape.filename, element);
    auto& mesh = document_.meshes[path];
    if (!mesh) {
        std::string const ending = fs::path(path).extension().string();
        bool const obj = ending == ".obj" || ending == ".OBJ";
        mesh = std::make_shared<scene::Mesh const>(obj ? read_obj(path) : read_ply(path));
    }
    for (size_t i = 0; i < scene_.meshes.size(); ++i)
        if (scene_.meshes[i] == mesh) shape.filename.resource = int32_t(i);
    if (shape.filename.resource < 0) shape.filename.resource = push(scene_.meshes, mesh);
}

void SceneBuilder::complete(scene::DirectionalLight& light, XmlElement const& element) {
    if (length_squared(light.direction) == 0)
        throw InputError(element.where, "'direction' expects a direction, found 0,0,0");
}

void SceneBuilder::complete(scene::SpotLight& light, XmlElement const& element) {
    if (length_squared(light.direction) == 0)
        throw InputError(element.where, "'direction' expects a direction, found 0,0,0");
}

void SceneBuilder::complete(scene::AreaLight& light, XmlElement const& element) {
    if (!scene_.instances[size_t(light.instance.index)].emission)
        throw InputError(element.where, "<light type=\"area\"> expects an instance with an <emission>, found one without");
}

} // namespace weft::io
