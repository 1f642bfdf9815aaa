#include "io/material_library.h"

namespace weft::io {

std::optional<std::string_view> library_text(std::string_view filename) {
    constexpr std::string_view folder = "materials/", extension = ".xml";
    if (!filename.starts_with(folder) || !filename.ends_with(extension)) return {};
    filename.remove_prefix(folder.size());
    for (LibraryFile const& file : material_library())
        if (filename.substr(0, file.name.size()) == file.name &&
            filename.size() == file.name.size() + extension.size())
            return file.text;
    return {};
}

} // namespace weft::io
