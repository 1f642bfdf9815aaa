// An EXR file with some of its channels changed and all else as it was.
#pragma once

#include <string>

#include "image/image.h"

namespace weft::image {

/// Writes `image` to `path`, with the header of the file `original`: its attributes, compression,
/// windows, and the names and types of its channels. `image` has the size and the channels of
/// read_image(original). Strings in `more` are added or replace others of their name. Written in
/// one step as by write_exr. Throws InputError where the extension is not .exr or `original` cannot
/// be read, and IoError.
void rewrite_exr(std::string const& path, std::string const& original, Image const& image,
                 Metadata const& more = {});

} // namespace weft::image
