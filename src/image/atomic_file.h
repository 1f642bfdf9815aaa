// A file that replaces another in one step (see image/write.h).
#pragma once

#include <functional>
#include <string>

namespace weft::image {

/// Calls fill(descriptor, temporary) with a new empty file, open for reading and writing, and its
/// path, which has the folder and the extension of `path`; then flushes it to the disk and renames
/// it to `path`. Throws IoError on failure; what `fill` throws passes through; the temporary file
/// is gone either way.
void replace_file(std::string const& path,
                  std::function<void(int descriptor, std::string const& temporary)> const& fill);

/// Makes and removes a temporary file as `replace_file` would. Throws IoError with the reason
/// where it cannot.
void probe_folder(std::string const& path);

} // namespace weft::image
