// Triangle meshes from PLY files (Turk 1994, "The PLY Polygon File Format"), in text and in
// binary of either byte order. io/ply_header.h lists the properties that are read.
//
// Polygons are triangulated, normals scaled to length 1; a normal of length 0 becomes that of a
// face beside it. Integer colours are scaled to [0, 1] and, like real ones, not decoded: whether
// they are sRGB the file does not say (a `geompropvalue` node decodes them). Other real properties
// of vertices, and alpha, are kept by name. Left out on purpose: triangle strips and point clouds,
// which are refused, and uvs per face corner, which are skipped.
#pragma once

#include "scene/mesh.h"

#include <string>
#include <string_view>

namespace weft::io {

/// Throws InputError for a file that is not a well-formed mesh: with line and column in the
/// header and in text, with the byte offset in binary. Memory stays within a small multiple of
/// the file's size, whatever its header claims.
scene::Mesh read_ply(std::string const& path);

/// The same for a file already in memory; `name` stands in for its path in messages.
scene::Mesh read_ply(std::string_view bytes, std::string const& name);

} // namespace weft::io
