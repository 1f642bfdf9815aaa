// The materials of scenes/materials, as the program carries them: a scene file includes
// materials/NAME.xml wherever it lies, and `weft help materials` and the page docs/materials.md are
// made of what these files say, so that neither can say something else.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace weft::io {

struct LibraryFile {
    std::string_view name; ///< of the file without .xml, and of the bsdf
    std::string_view text;
};

/// Returns all files in the order of their names. cmake/material_library.cmake writes the function.
std::span<LibraryFile const> material_library();

/// Returns the text that "materials/NAME.xml" stands for; none for any other file name.
std::optional<std::string_view> library_text(std::string_view filename);

} // namespace weft::io
