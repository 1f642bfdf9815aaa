#include "io/gltf_nodes.h"

#include <algorithm>
#include <cmath>

#include "io/gltf_mesh.h"
#include "io/gltf_view.h"
#include "scene/check.h"
#include "scene/scene_vectors.h"

namespace weft::io::gltf {

namespace {

/// Primitives may name the same data again and again: this bounds what they can add up to.
constexpr uint64_t kMostVertices = uint64_t(1) << 30;

/// The rotation of a quaternion x, y, z, w of any length but 0.
Affined rotation(double x, double y, double z, double w) {
    double const s = 2 / (x * x + y * y + z * z + w * w);
    return {{1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
            {s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)},
            {s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)},
            Vec3d(0)};
}

bool is_finite(Affined const& m) {
    double sum = 0;
    for (Vec3d const& v : {m.x, m.y, m.z, m.origin})
        sum += std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    return sum < double(std::numeric_limits<float>::max());
}

Affined scaling(Vec3d const& s) { return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, Vec3d(0)}; }

Affined translation(Vec3d const& t) {
    Affined m;
    m.origin = t;
    return m;
}

} // namespace

GltfContents NodeReader::read() {
    visited_.assign(file_.count("nodes"), false);
    if (auto lights = file_.root().extension("KHR_lights_punctual")) {
        lights_ = lights->objects("lights");
        lights->finish();
    }
    open_ = roots();
    std::reverse(open_.begin(), open_.end());
    while (!open_.empty()) {
        Visit const next = std::move(open_.back());
        open_.pop_back();
        visit(next);
    }
    return std::move(contents_);
}

std::vector<NodeReader::Visit> NodeReader::roots() {
    std::vector<Visit> list;
    size_t const scenes = file_.count("scenes");
    auto const chosen = file_.root().index("scene", scenes, "scenes");
    if (scenes > 0) {
        Object scene = file_.element("scenes", chosen.value_or(0));
        for (size_t node : scene.indices("nodes", file_.count("nodes"), "nodes"))
            list.push_back({node, {}, scene.path_of("nodes")});
        scene.finish();
        if (scenes > 1)
            file_.report().warn("scenes",
                                "only scenes[" + std::to_string(chosen.value_or(0)) + "] is read");
        return list;
    }
    std::vector<bool> is_child(file_.count("nodes"));
    for (size_t i = 0; i < is_child.size(); ++i)
        for (size_t child : file_.element("nodes", i).indices("children", is_child.size(), "nodes"))
            is_child[child] = true;
    for (size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) list.push_back({i, {}, "nodes"});
    return list;
}

Affined NodeReader::local_transform(Object& node) {
    auto const t = node.numbers("translation", 3), r = node.numbers("rotation", 4),
               s = node.numbers("scale", 3), m = node.numbers("matrix", 16);
    if (!m.empty()) {
        if (!t.empty() || !r.empty() || !s.empty())
            file_.report().fail(node.path_of("matrix"), "expected no translation, rotation or "
                                                        "scale beside it, found some");
        if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
            file_.report().fail(node.path_of("matrix"),
                                "expected 0, 0, 0, 1 as the last row, found others");
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    Affined result;
    if (!t.empty()) result = translation({t[0], t[1], t[2]});
    if (!r.empty()) {
        double const l2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3];
        if (!(l2 > 1e-12))
            file_.report().fail(node.path_of("rotation"),
                                "expected a quaternion of length 1, found one of length 0");
        result = result * rotation(r[0], r[1], r[2], r[3]);
    }
    if (!s.empty()) result = result * scaling({s[0], s[1], s[2]});
    return result;
}

void NodeReader::visit(Visit const& v) {
    if (visited_[v.node])
        file_.report().fail(v.from, "expected a tree, found nodes[" + std::to_string(v.node) +
                                        "] a second time");
    visited_[v.node] = true;
    Object node = file_.element("nodes", v.node);
    Affined const to_world = v.parent * local_transform(node);
    if (!is_finite(to_world))
        file_.report().fail(node.path(), "expected a transform that floats can hold, found a "
                                         "larger one, its ancestors' included");
    for (char const* key : {"skin", "weights"})
        if (node.has(key)) {
            node.ignore(key);
            file_.report().warn(node.path_of(key),
                                "skins and morph targets are left out: the mesh stands as it "
                                "was modelled");
        }
    if (auto const index = node.index("mesh", file_.count("meshes"), "meshes"))
        add_instances(node, *index, to_world);
    if (auto const index = node.index("camera", file_.count("cameras"), "cameras")) {
        Object camera = file_.element("cameras", *index);
        add_camera(camera, to_world);
    }
    if (auto lamp = node.extension("KHR_lights_punctual")) {
        if (auto const index = lamp->index("light", lights_.size(), "lights"))
            add_light(lights_[*index], to_world, node);
        lamp->finish();
    }
    auto const children = node.indices("children", visited_.size(), "nodes");
    for (size_t i = children.size(); i-- > 0;)
        open_.push_back(
            {children[i], to_world, node.path_of("children[" + std::to_string(i) + "]")});
    node.finish();
}

std::vector<NodeReader::Part> const& NodeReader::mesh(size_t index) {
    if (auto const it = meshes_.find(index); it != meshes_.end()) return it->second;
    std::vector<Part> parts;
    Object o = file_.element("meshes", index);
    for (Object& primitive : o.objects("primitives")) {
        auto const material = primitive.index("material", file_.count("materials"), "materials");
        Surface const& surface = materials_.surface(material, vertex_data(file_, primitive));
        auto made = read_primitive(file_, primitive, surface.uvs);
        if (!made) continue;
        primitive.finish();
        vertices_ += made->positions.size() + made->triangles.size();
        if (vertices_ > kMostVertices)
            file_.report().fail(primitive.path(), "expected at most " +
                                                      std::to_string(kMostVertices) +
                                                      " vertices and triangles in all, found more");
        scene::MeshShape shape;
        shape.filename = {file_.report().at(primitive.path()).file, int32_t(scene_.meshes.size())};
        scene_.meshes.push_back(std::make_shared<scene::Mesh const>(std::move(*made)));
        parts.push_back({scene::add(scene_, scene::ShapeKind{}, std::move(shape)), surface});
    }
    if (o.has("weights")) o.ignore("weights"); // told with the targets that they weigh
    o.finish();
    return meshes_.emplace(index, std::move(parts)).first->second;
}

std::vector<Affined> NodeReader::gpu_instances(Object& node) {
    auto extension = node.extension("EXT_mesh_gpu_instancing");
    if (!extension) return {Affined()};
    auto attributes = extension->object("attributes");
    extension->finish();
    if (!attributes)
        file_.report().fail(extension->path_of("attributes"), "expected an object, found none");
    std::optional<size_t> count;
    auto find = [&](char const* name, char const* type) -> Floats const* {
        auto const index = attributes->index(name, file_.count("accessors"), "accessors");
        if (!index) return nullptr;
        Floats const& f = file_.floats(*index, {type});
        if (count && *count != f.count)
            file_.report().fail(attributes->path_of(name), "expected " + std::to_string(*count) +
                                                               " elements, found " +
                                                               std::to_string(f.count));
        count = f.count;
        return &f;
    };
    Floats const *t = find("TRANSLATION", "VEC3"), *r = find("ROTATION", "VEC4"),
                 *s = find("SCALE", "VEC3");
    attributes->finish();
    std::vector<Affined> transforms(count.value_or(0));
    for (size_t i = 0; i < transforms.size(); ++i) {
        Affined& m = transforms[i];
        auto vec3 = [&](Floats const& f) {
            return Vec3d(double(f.data[i * 3]), double(f.data[i * 3 + 1]),
                         double(f.data[i * 3 + 2]));
        };
        if (t) m = m * translation(vec3(*t));
        if (r) {
            float const* const q = &r->data[i * 4];
            m = m * rotation(double(q[0]), double(q[1]), double(q[2]), double(q[3]));
        }
        if (s) m = m * scaling(vec3(*s));
        if (!is_finite(m))
            file_.report().fail(attributes->path(), "expected finite transforms and rotations of "
                                                    "length 1, found others for instance " +
                                                        std::to_string(i));
    }
    return transforms;
}

void NodeReader::add_instances(Object& node, size_t index, Affined const& to_world) {
    auto const transforms = gpu_instances(node);
    SourceLocation const where = file_.report().at(node.path());
    SharedText const name = Object(node).text("name");
    for (Part const& part : mesh(index))
        for (Affined const& m : transforms)
            if (!add_instance(part, to_world * m, where, name))
                file_.report().warn(node.path(), "has no volume, or more than numbers can hold, "
                                                 "and its mesh is left out");
}

bool NodeReader::add_instance(Part const& part, Affined const& to_world,
                              SourceLocation const& where, SharedText const& name) {
    if (!scene::is_invertible(to_world)) return false;
    scene::Instance instance;
    instance.shape = part.shape;
    instance.transform = to_world;
    instance.traits.bsdf = part.surface.bsdf;
    instance.traits.medium = part.surface.medium;
    contents_.instances.push_back(
        scene::add(scene_, scene::InstanceKind{}, std::move(instance), where, name));
    if (part.surface.radiance > 0) contents_.emissive.push_back(contents_.instances.back());
    if (part.surface.is_unlit) contents_.unlit.push_back(contents_.instances.back());
    contents_.radiance = std::max(contents_.radiance, part.surface.radiance);
    return true;
}

void NodeReader::add_camera(Object& camera, Affined const& to_world) {
    contents_.cameras.push_back(
        scene::add(scene_, scene::CameraKind{}, read_camera(camera, to_world)));
}

void NodeReader::add_light(Object& light, Affined const& to_world, Object const& node) {
    contents_.lights.push_back(scene::add(scene_, scene::LightKind{}, read_light(light, to_world),
                                          file_.report().at(node.path())));
}

} // namespace weft::io::gltf
