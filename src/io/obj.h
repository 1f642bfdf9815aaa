// Triangle meshes from Wavefront OBJ files (Wavefront, "Advanced Visualizer" manual, appendix B1).
//
// The file is one mesh: groups and objects are joined. Read are v (with a colour after the
// position, as most tools write it), vt, vn and f in its four forms, with negative indices and
// polygons, and lines continued by a backslash. A corner without a normal, in a file where others
// have one, is flat: it takes the normal of its face and is shared with no other face. Where only
// some corners have uvs or some positions colours, the rest take (0, 0) and white.
//
// Ignored, since they do not change the shape: o, g, s (smoothing groups), mg, usemtl, mtllib and
// other names of materials and maps, display attributes, and the elements without area, p and l.
// Refused, since ignoring them would lose shape: curves and surfaces, calls of other files, words
// that OBJ does not know, and UTF-16.
#pragma once

#include "scene/mesh.h"

#include <string>
#include <string_view>

namespace weft::io {

/// Throws InputError, with line and column, for a file that is not a well-formed mesh with at
/// least one face.
scene::Mesh read_obj(std::string const& path);

/// The same for a file already in memory; `name` stands in for its path in messages.
scene::Mesh read_obj(std::string_view bytes, std::string const& name);

} // namespace weft::io
