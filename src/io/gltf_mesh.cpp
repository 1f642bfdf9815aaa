#include "io/gltf_mesh.h"

#include <algorithm>
#include <cmath>

namespace weft::io::gltf {

namespace {

enum Mode : uint64_t { points, lines, line_loop, line_strip, triangles, strip, fan };

/// The vertices that each corner of each triangle names.
std::vector<scene::Mesh::Triangle> make_triangles(Mode mode, std::vector<uint32_t> const& v) {
    std::vector<scene::Mesh::Triangle> made;
    if (mode == triangles) {
        made.reserve(v.size() / 3);
        for (size_t i = 0; i + 2 < v.size(); i += 3) made.push_back({{v[i], v[i + 1], v[i + 2]}});
        return made;
    }
    for (size_t i = 0; i + 2 < v.size(); ++i) {
        if (mode == fan)
            made.push_back({{v[0], v[i + 1], v[i + 2]}});
        else if (i % 2 == 0)
            made.push_back({{v[i], v[i + 1], v[i + 2]}});
        else
            made.push_back({{v[i], v[i + 2], v[i + 1]}});
    }
    // Strips repeat vertices to jump from one part to the next.
    std::erase_if(made, [](scene::Mesh::Triangle const& t) {
        return t.v[0] == t.v[1] || t.v[1] == t.v[2] || t.v[2] == t.v[0];
    });
    return made;
}

/// The corners of a primitive, checked against its number of vertices.
std::vector<uint32_t> read_corners(File& file, Object& primitive, size_t vertices) {
    auto const accessor = primitive.index("indices", file.count("accessors"), "accessors");
    std::vector<uint32_t> corners;
    if (!accessor) {
        corners.resize(vertices);
        for (size_t i = 0; i < vertices; ++i) corners[i] = uint32_t(i);
        return corners;
    }
    corners = file.integers(*accessor);
    for (size_t i = 0; i < corners.size(); ++i)
        if (corners[i] >= vertices)
            file.report().fail(primitive.path_of("indices"),
                               "element " + std::to_string(i) + ": expected a vertex from 0 to " +
                                   std::to_string(vertices - 1) + ", found " +
                                   std::to_string(corners[i]));
    return corners;
}

/// Many primitives may share one long list of vertices: each keeps those that it uses. The
/// vertices to keep, in order; `corners` then count among these.
std::vector<uint32_t> compact(std::vector<uint32_t>& corners, size_t vertices) {
    std::vector<uint32_t> kept;
    if (corners.size() >= vertices) {
        kept.resize(vertices);
        for (size_t i = 0; i < vertices; ++i) kept[i] = uint32_t(i);
        return kept;
    }
    kept = corners;
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (uint32_t& c : corners)
        c = uint32_t(std::lower_bound(kept.begin(), kept.end(), c) - kept.begin());
    return kept;
}

class PrimitiveReader {
  public:
    PrimitiveReader(File& file, Object& attributes) : file_(file), attributes_(attributes) {}

    /// The numbers of an attribute; nullptr where the primitive has none.
    Floats const* find(std::string_view name, std::vector<std::string> const& types) {
        auto const index = attributes_.index(name, file_.count("accessors"), "accessors");
        if (!index) return nullptr;
        Floats const& f = file_.floats(*index, types);
        if (vertices_ != 0 && f.count != vertices_)
            file_.report().fail(attributes_.path_of(name), "expected " + std::to_string(vertices_) +
                                                               " elements, one per vertex, found " +
                                                               std::to_string(f.count));
        vertices_ = f.count;
        return &f;
    }

    void read(std::vector<uint32_t> const& kept, MeshUvs const& uvs, scene::Mesh& mesh) {
        Floats const& p = *find("POSITION", {"VEC3"});
        for (uint32_t v : kept) mesh.positions.push_back(vec3(p, v));
        if (Floats const* n = find("NORMAL", {"VEC3"}))
            for (uint32_t v : kept) mesh.normals.push_back(vec3(*n, v));
        if (Floats const* uv = find(uv_property(uvs.own), {"VEC2"}))
            for (uint32_t v : kept) mesh.uvs.push_back(upward(*uv, v));
        for (uint64_t set : uvs.further) {
            scene::VertexAttribute property{uv_property(set), 2, {}};
            Floats const& uv = *find(property.name, {"VEC2"});
            for (uint32_t v : kept) {
                Vec2 const at = upward(uv, v);
                property.values.insert(property.values.end(), {at.x, at.y});
            }
            mesh.attributes.push_back(std::move(property));
        }
        if (Floats const* c = find("COLOR_0", {"VEC3", "VEC4"}))
            for (uint32_t v : kept) {
                Vec3 const rgb = vec3(*c, v);
                mesh.colors.emplace_back(rgb.x, rgb.y, rgb.z);
            }
        if (Floats const* c = find("COLOR_0", {"VEC3", "VEC4"}); c && c->components == 4) {
            scene::VertexAttribute property{kAlphaProperty, 1, {}};
            for (uint32_t v : kept) property.values.push_back(c->data[v * 4 + 3]);
            mesh.attributes.push_back(std::move(property));
        }
    }

  private:
    static Vec3 vec3(Floats const& f, uint32_t i) {
        float const* const p = &f.data[i * f.components];
        return {p[0], p[1], p[2]};
    }
    /// glTF's v runs downwards.
    static Vec2 upward(Floats const& uv, uint32_t i) {
        return {uv.data[i * 2], 1 - uv.data[i * 2 + 1]};
    }

    File& file_;
    Object& attributes_;
    size_t vertices_ = 0;
};

void report_left_out(Object& primitive, Object& attributes) {
    Report& report = primitive.report();
    attributes.ignore("TANGENT");
    for (std::string const& key : attributes.keys()) {
        bool const skin = key.starts_with("JOINTS_") || key.starts_with("WEIGHTS_");
        if (skin) {
            attributes.ignore(key);
            report.warn(attributes.path_of(key),
                        "skins are left out: the mesh stands as it was modelled");
        } else if (key.starts_with("TEXCOORD_")) {
            attributes.ignore(key); // that of the material's textures is taken
        }
    }
    attributes.finish();
    if (primitive.has("targets")) {
        primitive.ignore("targets");
        report.warn(primitive.path_of("targets"),
                    "morph targets are left out: the mesh stands as it was modelled");
    }
}

void check_normals(scene::Mesh const& mesh, Object const& attributes) {
    for (size_t i = 0; i < mesh.normals.size(); ++i)
        if (!is_finite(mesh.normals[i]))
            attributes.report().fail(attributes.path_of("NORMAL"),
                                     "expected finite numbers, found others as the normal of "
                                     "vertex " +
                                         std::to_string(i));
}

} // namespace

VertexData vertex_data(File& file, Object const& primitive) {
    VertexData data;
    auto attributes = Object(primitive).object("attributes");
    if (!attributes) return data;
    if (auto const colors = attributes->index("COLOR_0", file.count("accessors"), "accessors"))
        data.color_components = file.element("accessors", *colors).text("type") == "VEC4" ? 4 : 3;
    while (attributes->has(uv_property(data.uv_sets))) ++data.uv_sets;
    return data;
}

std::optional<scene::Mesh> read_primitive(File& file, Object& primitive, MeshUvs const& uvs) {
    Report& report = file.report();
    uint64_t const mode = primitive.whole("mode").value_or(triangles);
    if (mode > fan)
        report.fail(primitive.path_of("mode"), "expected 0 to 6, found " + std::to_string(mode));
    auto attributes = primitive.object("attributes");
    if (!attributes) report.fail(primitive.path_of("attributes"), "expected an object, found none");
    if (mode < triangles) {
        for (char const* key : {"indices", "targets", "material"}) primitive.ignore(key);
        report.warn(primitive.path_of("mode"), "points and lines are left out");
        return {};
    }
    PrimitiveReader reader(file, *attributes);
    Floats const* const positions = reader.find("POSITION", {"VEC3"});
    if (!positions || positions->count == 0) {
        primitive.ignore("indices");
        report.warn(primitive.path(), "has no vertices and is left out");
        return {};
    }
    std::vector<uint32_t> corners = read_corners(file, primitive, positions->count);
    if (mode == triangles && corners.size() % 3 != 0)
        report.warn(primitive.path(), "the number of corners is no multiple of 3; the last ones "
                                      "are left out");
    scene::Mesh mesh;
    reader.read(compact(corners, positions->count), uvs, mesh);
    mesh.triangles = make_triangles(Mode(mode), corners);
    report_left_out(primitive, *attributes);
    if (mesh.triangles.empty()) {
        report.warn(primitive.path(), "has no triangles and is left out");
        return {};
    }
    check_normals(mesh, *attributes);
    unify_normals(mesh);
    validate(mesh, report.at(primitive.path()));
    return mesh;
}

} // namespace weft::io::gltf
