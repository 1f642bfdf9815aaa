// The header of a PLY file (Turk 1994, "The PLY Polygon File Format"): which elements with which
// properties follow, and which of them a mesh is made of. Used by io/ply.cpp alone.
//
//   vertex  x y z | nx ny nz | s t, u v, texture_u texture_v or texture_s texture_t |
//           red green blue or diffuse_red ...; all scalars of any type
//   face    vertex_indices or vertex_index, a list of any integer type
//
// Reals of other names become vertex attributes, and so does alpha. Every other element and
// property is skipped; so are uvs per face corner, and materials.
#pragma once

#include "base/error.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::io::ply {

enum class Scalar : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Format : uint8_t { ascii, little_endian, big_endian };

constexpr size_t size_of(Scalar s) {
    return std::array<size_t, 8>{1, 1, 2, 2, 4, 4, 4, 8}[size_t(s)];
}
constexpr bool is_integer(Scalar s) { return s < Scalar::float32; }

struct Property {
    std::string name;
    Scalar type = Scalar::float32;
    bool is_list = false;
    Scalar length_type = Scalar::uint8; ///< of a list
    SourceLocation where;
};

struct Element {
    std::string name;
    uint64_t count = 0;
    std::vector<Property> properties;
    SourceLocation where;
    bool has_list = false;
    /// Bytes of one record in a binary file; with its lists empty where it has any.
    size_t min_bytes = 0;
};

/// Vertex properties that a mesh uses, as columns: positions, normals, uvs, colours.
inline constexpr int kColumns = 11;
enum : int { kPosition = 0, kNormal = 3, kUv = 6, kColor = 8 };

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;
    size_t body = 0;                    ///< offset of the first byte after the header
    size_t vertex = 0, face = 0;        ///< indices of the elements that matter
    std::array<int, kColumns> column{}; ///< the vertex property that fills it, or -1
    std::vector<size_t> extra;          ///< other vertex properties that a mesh keeps by name
    size_t corners = 0;                 ///< the face property that lists the vertices
};

/// Throws InputError, with line and column, for anything but a header that describes a mesh
/// whose elements can fit in `bytes`.
Header parse_header(std::string_view bytes, std::string const& name);

} // namespace weft::io::ply
