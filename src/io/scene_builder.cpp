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

/// The one type that a category with a single type may name.
void expect_type(XmlElement const& e, std::string const& type) {
    XmlAttribute const* a = e.find("type");
    if (!a) throw InputError(e.where, "<" + e.tag + "> expects type=\"" + type + "\"");
    if (a->value != type)
        throw InputError(a->where, "unknown type " + in_quotes(a->value) + " of <" + e.tag + ">" +
                                       suggestion(a->value, std::vector{type}));
}

/// Calls `read`; what is wrong with the file is told with the place that names it.
template <class Read>
auto read_at(SourceLocation const& where, Read const& read) {
    try {
        return read();
    } catch (InputError const& e) {
        throw InputError(std::string(e.what()) + " (file named at " + to_string(where) + ")");
    }
}

/// The name of a light group or a layer, which becomes a part of channels' names.
void check_name(std::string const& attribute, std::string const& name, XmlElement const& element) {
    auto const fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    };
    if (!std::all_of(name.begin(), name.end(), fits))
        throw InputError(location_of(element, attribute),
                         in_quotes(attribute) + " of " + element_title(element) +
                             " expects letters, digits, _ and -, found " + in_quotes(name));
}

void check_direction(Vec3 const& direction, XmlElement const& element,
                     std::string const& name = "direction") {
    if (!(length_squared(Vec3d(direction)) > 0))
        throw InputError(location_of(element, name),
                         "'" + name + "' of " + element_title(element) +
                             " expects a direction, found a vector of length 0");
}

/// Of two ways to say how bright a light is, `usual` has a default that the other, where it is
/// given, takes the place of.
void choose_brightness(scene::Input<Color>& usual, std::string const& usual_name,
                       scene::Input<Color> const& other, std::string const& other_name,
                       XmlElement const& element) {
    scene::Input<Color> const none{Color(0)};
    auto is_given = [&](std::string const& name) {
        return &location_of(element, name) != &element.where;
    };
    if (!is_given(other_name)) return;
    if (!is_given(usual_name)) usual = none;
    if (usual != none && other != none)
        throw InputError(location_of(element, other_name), element_title(element) + " expects '" +
                                                               usual_name + "' or '" + other_name +
                                                               "', found both");
}

} // namespace

int32_t SceneBuilder::add(schema::TextureKind, XmlElement const& e) {
    scene::Texture texture = read_variant<scene::Texture>(e);
    auto type_of = [&](scene::TextureId id) { return texture_type(id); };
    texture_types_.push_back(
        match(texture, [&](auto const& node) { return scene::output_type(node, type_of); }));
    scene_.texture_locations.push_back(e.where);
    return append(scene_.textures, std::move(texture));
}
int32_t SceneBuilder::add(scene::CameraKind, XmlElement const& e) {
    return append(scene_.cameras, read_variant<scene::Camera>(e));
}
int32_t SceneBuilder::add(scene::MaterialKind, XmlElement const& e) {
    scene::Material material = read_variant<scene::Material>(e);
    scene_.material_locations.push_back(e.where);
    scene_.material_names.emplace_back(e.get("id"));
    return append(scene_.materials, std::move(material));
}
int32_t SceneBuilder::add(scene::LayerKind, XmlElement const& e) {
    return append(scene_.layers, read_struct<scene::Layer>(e));
}
int32_t SceneBuilder::add(scene::ShapeKind, XmlElement const& e) {
    return append(scene_.shapes, read_variant<scene::Shape>(e));
}

int32_t SceneBuilder::add(scene::EmissionKind, XmlElement const& e) {
    expect_type(e, "lambertian");
    return append(scene_.emissions, read_struct<scene::LambertianEmission>(e));
}

int32_t SceneBuilder::add(scene::VolumeKind, XmlElement const& e) {
    if (e.get("type") == "grid")
        throw InputError(e.where,
                         "<volume type=\"grid\"> is not supported yet; expected type=\"constant\"");
    expect_type(e, "constant");
    return append(scene_.volumes, read_struct<scene::ConstantVolume>(e));
}

int32_t SceneBuilder::add(scene::MediumKind, XmlElement const& e) {
    expect_type(e, "homogeneous");
    return append(scene_.media, read_struct<scene::HomogeneousMedium>(e));
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
    return index;
}

int32_t SceneBuilder::add(scene::DisplayKind, XmlElement const& e) {
    return append(displays_, PlacedDisplay{read_struct<scene::Display>(e), e.where});
}

int32_t SceneBuilder::add(scene::InstanceKind, XmlElement const& e) {
    scene::Instance instance;
    if (e.tag == "shape")
        instance.shape = object<scene::ShapeKind>(e);
    else
        instance = read_struct<scene::Instance>(e);
    summaries_.push_back(summary(instance));
    scene_.instance_locations.push_back(e.where);
    scene_.instance_names.emplace_back(e.get("id"));
    return append(scene_.instances, std::move(instance));
}

int32_t SceneBuilder::add(scene::LightKind, XmlElement const& e) {
    scene::Light light = read_variant<scene::Light>(e);
    match(light, [&](auto const& l) { check_name("group", l.controls.group, e); });
    scene_.light_locations.push_back(e.where);
    return append(scene_.lights, std::move(light));
}

int32_t SceneBuilder::add(scene::PortalKind, XmlElement const& e) {
    return append(scene_.portals, read_struct<scene::Portal>(e));
}

int32_t SceneBuilder::add(scene::IntegratorKind, XmlElement const& e) {
    integrator_element = &e;
    return 0;
}

int32_t SceneBuilder::load_image(std::string const& path, scene::ColorSpace encoding,
                                 bool mip_levels, SourceLocation const& where) {
    return index_of(scene_.images, read_at(where, [&] {
                        return document_.textures->load(path, scene::transfer_of(encoding),
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

void SceneBuilder::complete(scene::ImageTexture& texture, XmlElement const& element) {
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

void SceneBuilder::check_part(scene::MaterialId part, XmlElement const& element) const {
    auto const& material = scene_.materials[size_t(part.index)];
    if (!std::holds_alternative<scene::Hair>(material) &&
        !std::holds_alternative<scene::VolumeBoundary>(material))
        return;
    throw InputError(
        element.where,
        element_title(element) + " expects a surface to be made of, found <bsdf type=\"" +
            std::string(match(material, [](auto const& m) { return m.info.type; })) + "\">");
}

void SceneBuilder::complete(scene::Layer& layer, XmlElement const& element) {
    check_part(layer.bsdf, element);
    check_name("label", layer.label, element);
}
void SceneBuilder::complete(scene::Coat& material, XmlElement const& element) {
    check_part(material.bsdf, element);
    check_name("label", material.label, element);
}
void SceneBuilder::complete(scene::Layered& material, XmlElement const& element) {
    if (material.layers.empty())
        throw InputError(element.where,
                         element_title(element) + " expects a child tag <layer>, found none");
}
void SceneBuilder::complete(scene::Mix& material, XmlElement const& element) {
    if (material.bsdfs.size() != 2)
        throw InputError(element.where, element_title(element) +
                                            " expects two child tags <bsdf>, found " +
                                            std::to_string(material.bsdfs.size()));
    for (scene::MaterialId part : material.bsdfs) check_part(part, element);
    check_name("label0", material.label0, element);
    check_name("label1", material.label1, element);
}
void SceneBuilder::complete(scene::Secondary& material, XmlElement const& element) {
    if (material.bsdfs.size() != 2)
        throw InputError(element.where, element_title(element) +
                                            " expects two child tags <bsdf>, found " +
                                            std::to_string(material.bsdfs.size()));
    for (scene::MaterialId part : material.bsdfs) check_part(part, element);
}

void SceneBuilder::complete(scene::Instance& instance, XmlElement const& element) {
    check_name("group", instance.group, element);
    if (!instance.normal) return;
    auto const type = texture_type(instance.normal);
    if (type != scene::ValueType::color && type != scene::ValueType::vector3)
        throw InputError(location_of(element, "normal"),
                         "'normal' of <instance> expects a color or a vector3, found a " +
                             std::string(schema::type_name(type)));
}

void SceneBuilder::complete(scene::nodes::Convert& node, XmlElement const& element) {
    if (!node.in.texture || node.output_type() != scene::ValueType::number) return;
    auto const type = texture_type(node.in.texture);
    if (type == scene::ValueType::vector2 || type == scene::ValueType::vector3)
        throw InputError(location_of(element, "in"), "'in' of " + element_title(element) +
                                                         " expects a float or a color, found a " +
                                                         std::string(schema::type_name(type)) +
                                                         "; `extract` makes a float of it");
}

void SceneBuilder::complete(scene::ThinLens& camera, XmlElement const& element) {
    if (camera.bokeh.path.empty()) return;
    SourceLocation const& where = location_of(element, "bokeh");
    std::string const path = existing_file(element.folder, camera.bokeh.path, where);
    if (files_ == Files::read)
        camera.bokeh.resource = load_image(path, scene::ColorSpace::srgb_texture, false, where);
}

void SceneBuilder::complete(scene::MeshShape& shape, XmlElement const& element) {
    SourceLocation const& where = location_of(element, "filename");
    std::string const path = existing_file(element.folder, shape.filename.path, where);
    if (files_ == Files::read) shape.filename.resource = load_mesh(path, where);
}

void SceneBuilder::complete(scene::Group& group, XmlElement const& element) {
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
    for (scene::InstanceId id : contents.instances) {
        summaries_.push_back(summary(scene_.instances[size_t(id.index)]));
        group.instances.push_back(id);
    }
    texture_types_.resize(scene_.textures.size(), scene::ValueType::color);
    for (std::string const& warning : contents.warnings) document_.warnings.push_back(warning);
    if (!contents.lights.empty())
        document_.warnings.push_back(to_string(where) +
                                     ": the file's lamps are left out: a group holds instances");
}

void SceneBuilder::complete(scene::Bloom& bloom, XmlElement const& element) {
    std::string_view const useless = scene::settle_kind(bloom, [&](std::string_view name) {
        return element.find(name) ||
               std::any_of(element.children.begin(), element.children.end(),
                           [&](auto const& c) { return c->get("name") == name; });
    });
    if (useless.empty()) return;
    throw InputError(location_of(element, useless),
                     in_quotes(useless) + " of " + element_title(element) +
                         " is a parameter of another kind than '" +
                         schema::TextForm<scene::BloomKind>::write(bloom.kind) + "'");
}

void SceneBuilder::complete(scene::Display& display, XmlElement const& element) {
    if (display.ocio.path.empty()) return;
    display.ocio.path =
        existing_file(element.folder, display.ocio.path, location_of(element, "ocio"));
}

void SceneBuilder::complete(scene::DirectionalLight& light, XmlElement const& element) {
    check_direction(light.direction, element);
}

void SceneBuilder::complete(scene::PointLight& light, XmlElement const& element) {
    choose_brightness(light.power, "power", light.intensity, "intensity", element);
}

void SceneBuilder::complete(scene::SpotLight& light, XmlElement const& element) {
    check_direction(light.direction, element);
    check_direction(light.up, element, "up");
    choose_brightness(light.intensity, "intensity", light.power, "power", element);
    float const outer = light.angle + light.falloff;
    if (light.gobo.texture && !(outer < 180))
        throw InputError(location_of(element, "gobo"),
                         "'gobo' of " + element_title(element) +
                             " expects an angle and falloff of less than 180 together, found " +
                             schema::number_text(outer));
    if (light.power != scene::Input<Color>{Color(0)} && !(outer > 0))
        throw InputError(location_of(element, "power"),
                         "'power' of " + element_title(element) +
                             " expects an angle and falloff of more than 0 together, found 0");
}

void SceneBuilder::complete(scene::IesLight& light, XmlElement const& element) {
    check_direction(light.direction, element);
    check_direction(light.c0, element, "c0");
    SourceLocation const& where = location_of(element, "filename");
    std::string const path = existing_file(element.folder, light.filename.path, where);
    if (files_ != Files::read) return;
    auto& lamp = document_.photometries[path];
    if (!lamp)
        lamp = std::make_shared<scene::Photometry const>(
            read_at(where, [&] { return read_ies(path); }));
    light.filename.resource = index_of(scene_.photometries, lamp);
}

void SceneBuilder::complete(scene::AreaLight& light, XmlElement const& element) {
    if (!summaries_[size_t(light.instance.index)].emits)
        throw InputError(element.where, element_title(element) +
                                            " expects an instance with an <emission>, found one "
                                            "without");
}

void SceneBuilder::complete(scene::SkyLight& light, XmlElement const& element) {
    if (!light.date.empty() && !scene::parse_date(light.date))
        throw InputError(location_of(element, "date"), "'date' of " + element_title(element) +
                                                           " expects a day, as 2026-06-21, found " +
                                                           in_quotes(light.date));
}

void SceneBuilder::complete(scene::Portal& portal, XmlElement const& element) {
    Affined const& m = portal.transform;
    if (std::abs(dot(m.x, m.y)) > 1e-4 * length(m.x) * length(m.y))
        throw InputError(location_of(element, "transform"),
                         "<portal> expects a transform that leaves it a rectangle, found one that "
                         "shears it");
}

SceneBuilder::Summary SceneBuilder::summary(scene::Instance const& instance) const {
    auto const* disney =
        instance.bsdf ? std::get_if<scene::Disney>(&scene_.materials[size_t(instance.bsdf.index)])
                      : nullptr;
    Summary total{1, instance.emission || (disney && scene::emits(*disney))};
    auto const* group = std::get_if<scene::Group>(&scene_.shapes[size_t(instance.shape.index)]);
    if (!group) return total;
    total.objects = 0;
    for (scene::InstanceId member : group->instances) {
        total.objects += summaries_[size_t(member.index)].objects;
        total.emits |= summaries_[size_t(member.index)].emits;
    }
    return total;
}

/// Groups of groups multiply: a few lines can stand for more objects than any memory holds.
void SceneBuilder::complete(scene::SceneContents& contents, XmlElement const& element) {
    constexpr double most = 1e8;
    double objects = 0;
    auto add = [&](scene::InstanceId id) { objects += summaries_[size_t(id.index)].objects; };
    for (scene::InstanceId id : contents.instances) add(id);
    for (scene::LightId id : contents.lights)
        if (auto const* area = std::get_if<scene::AreaLight>(&scene_.lights[size_t(id.index)]))
            add(area->instance);
    if (objects > most)
        throw InputError(element.where, "<scene> expects at most " + schema::number_text(most) +
                                            " objects, found " + schema::number_text(objects) +
                                            " by its groups");
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
