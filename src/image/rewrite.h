// An EXR file with some of its channels changed and all else as it was.
#pragma once

#include <string>

#include "image/image.h"

namespace weft::image {

/// Writes `image` to `path`, with the headers and parts of the file `original`: their attributes,
/// compression, windows, and the names and types of their channels. `image` has the size and the
/// channels of read_image(original); parts that are not in it and integers, which it rounds, come
/// from the file. Strings in `more` are added to the first part or replace others of their name.
/// Written in one step as by write_exr. Throws InputError where the extension is not .exr, or
/// `original` cannot be read or has deep parts, and IoError.
void rewrite_exr(std::string const& path, std::string const& original, Image const& image,
                 Metadata const& more = {});

} // namespace weft::image
