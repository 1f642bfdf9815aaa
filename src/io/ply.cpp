#include "io/ply.h"

#include "base/file_bytes.h"
#include "io/mesh_text.h"
#include "io/ply_body.h"

namespace weft::io {

namespace ply {

std::vector<Column> make_columns(Header const& header, scene::Mesh& mesh) {
    Element const& e = header.elements[header.vertex];
    std::vector<Column> columns;
    auto scale_of = [&](size_t property) { // of integers that stand for 0 to 1
        size_t const size = size_of(e.properties[property].type);
        if (!is_integer(e.properties[property].type)) return 1.f;
        return size == 1 ? 1 / 255.f : size == 2 ? 1 / 65535.f : 0x1p-32f;
    };
    auto add = [&](int first, size_t n, float* data) {
        for (size_t k = 0; k < n; ++k) {
            auto const property = size_t(header.column[size_t(first) + k]);
            columns.push_back({property, data + k, n, first == kColor ? scale_of(property) : 1});
        }
    };
    if (e.count == 0) return columns;
    mesh.positions.resize(e.count);
    add(kPosition, 3, &mesh.positions[0].x);
    if (header.column[kNormal] >= 0) {
        mesh.normals.resize(e.count);
        add(kNormal, 3, &mesh.normals[0].x);
    }
    if (header.column[kUv] >= 0) {
        mesh.uvs.resize(e.count);
        add(kUv, 2, &mesh.uvs[0].x);
    }
    if (header.column[kColor] >= 0) {
        mesh.colors.resize(e.count);
        add(kColor, 3, &mesh.colors[0].r);
    }
    for (size_t property : header.extra) {
        mesh.attributes.push_back({e.properties[property].name, 1, std::vector<float>(e.count)});
        columns.push_back({property, mesh.attributes.back().values.data(), 1, scale_of(property)});
    }
    return columns;
}

std::string describe_value(Element const& element, Property const& property, uint64_t record) {
    return "property " + quoted(property.name) + " of " + element.name + " " +
           std::to_string(record);
}

std::string describe_bad_index(uint64_t face, int64_t index, size_t vertices) {
    std::string const range =
        vertices == 0 ? "no vertex" : "a vertex from 0 to " + std::to_string(vertices - 1);
    return "face " + std::to_string(face) + ": expected " + range + ", found " +
           std::to_string(index) + "; the file has " + std::to_string(vertices) + " vertices";
}

std::string describe_bad_length(uint64_t face, int64_t length) {
    return "face " + std::to_string(face) + ": expected at least 3 vertices, found " +
           std::to_string(length);
}

std::string describe_bad_polygon(uint64_t face, size_t corners) {
    return "face " + std::to_string(face) + ": expected at most " +
           std::to_string(scene::kMaxConcaveCorners) + " corners in a concave polygon, found " +
           std::to_string(corners);
}

} // namespace ply

scene::Mesh read_ply(std::string_view bytes, std::string const& name) {
    ply::Header const header = ply::parse_header(bytes, name);
    ply::Source const source{bytes, name, header};
    bool const ascii = header.format == ply::Format::ascii;
    scene::Mesh mesh;
    size_t at = header.body, faces_at = 0;
    for (size_t i = 0; i <= std::max(header.vertex, header.face); ++i) {
        if (i == header.vertex) {
            at = ascii ? ply::read_ascii_vertices(source, at, mesh)
                       : ply::read_binary_vertices(source, at, mesh);
        } else {
            // Faces wait until the vertices they name are known.
            if (i == header.face) faces_at = at;
            if (i == header.face && header.vertex < i) break;
            ply::Element const& e = header.elements[i];
            at = ascii ? ply::skip_ascii(source, e, at) : ply::skip_binary(source, e, at);
        }
    }
    if (ascii)
        ply::read_ascii_faces(source, faces_at, mesh);
    else
        ply::read_binary_faces(source, faces_at, mesh);
    scene::unify_normals(mesh);
    return mesh;
}

scene::Mesh read_ply(std::string const& path) { return read_ply(read_file(path).view(), path); }

} // namespace weft::io
