// The elements after a PLY header, in text and in binary. Used by io/ply.cpp alone.
//
// Each function reads one element that starts at byte `at` and returns the offset after it.
#pragma once

#include "io/ply_header.h"
#include "scene/mesh.h"

namespace weft::io::ply {

struct Source {
    std::string_view bytes;
    std::string const& name;
    Header const& header;
};

/// Where the values of one vertex property go.
struct Column {
    size_t property = 0;
    float* data = nullptr; ///< of vertex 0
    size_t stride = 0;     ///< floats from one vertex to the next
    float scale = 1;       ///< integer colours to [0, 1]
};

/// Sizes the arrays of `mesh` and points at their components.
std::vector<Column> make_columns(Header const& header, scene::Mesh& mesh);

std::string describe_value(Element const& element, Property const& property, uint64_t record);
std::string describe_bad_index(uint64_t face, int64_t index, size_t vertices);
std::string describe_bad_length(uint64_t face, int64_t length);
std::string describe_bad_polygon(uint64_t face, size_t corners);

size_t read_ascii_vertices(Source const& s, size_t at, scene::Mesh& mesh);
size_t read_ascii_faces(Source const& s, size_t at, scene::Mesh& mesh);
size_t skip_ascii(Source const& s, Element const& element, size_t at);

size_t read_binary_vertices(Source const& s, size_t at, scene::Mesh& mesh);
size_t read_binary_faces(Source const& s, size_t at, scene::Mesh& mesh);
size_t skip_binary(Source const& s, Element const& element, size_t at);

} // namespace weft::io::ply
