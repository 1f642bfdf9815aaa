// What the files of the material library (io/material_library.h) say of themselves, for help and
// docs.
//
// A file opens with a comment: what it is, and sections that begin with "Feel:", "Scale:",
// "Play with:" and "From:". It then defines a bsdf whose id is the file's name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/material_library.h"

namespace weft::apps {

using io::LibraryFile;
using io::material_library;

struct LibraryMaterial {
    std::string_view name;
    std::string what, feel, scale, play; ///< of the comment; `scale` may be empty
    std::string values;                  ///< attributes of its bsdf, as they stand in a file
    std::vector<std::string> patterns;   ///< parameters that are fed by nodes
};

/// Reads a file of the library. Throws InputError where it is not as described above.
LibraryMaterial read_library_material(LibraryFile const& file);

/// Returns a text about how things feel to the touch, with values of `disney` to start from, and
/// about all materials of the library: for a terminal, or as the page docs/materials.md
/// (`markdown`).
std::string materials_text(bool markdown);

} // namespace weft::apps
