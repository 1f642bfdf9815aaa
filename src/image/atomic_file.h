// A file that replaces another in one step (see image/write.h).
//
// The temporary file beside it is locked (flock) by its writer, and a lock ends with its process:
// so the next writer of the same target knows the file of one that was killed, and removes it,
// and never that of a living one, on whatever machine. Process numbers in names could not tell that
// over a network. Where a file system knows no locks, what a killed process left stays.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace weft::image {

/// Calls fill(descriptor, temporary) with a new empty file, open for reading and writing, and its
/// path, which has the folder and the extension of `path`; then flushes it to the disk and renames
/// it to `path`. Throws IoError on failure; what `fill` throws passes through; the temporary file
/// is gone either way.
void replace_file(std::string const& path,
                  std::function<void(int descriptor, std::string const& temporary)> const& fill);

/// The same with `contents` in the new file.
void replace_file(std::string const& path, std::string_view contents);

/// Makes and removes a temporary file as `replace_file` would. Throws IoError with the reason
/// where it cannot.
void probe_folder(std::string const& path);

} // namespace weft::image
