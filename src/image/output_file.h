// Image files written in one step (see image/write.h), whatever is in them.
#pragma once

#include <OpenImageIO/imageio.h>

#include <functional>
#include <string>

namespace weft::image {

/// Opens the output as the file `name` and writes it all but for closing it; false where that
/// failed.
using FillOutput = std::function<bool(OIIO::ImageOutput& output, std::string const& name)>;

/// Replaces `path`. `format` is OpenImageIO's name of a file format; "" takes that of the
/// extension. `in_parts`: the file may have several, which OpenImageIO's TIFF writer appends only
/// to a file that it opened by name. Throws IoError; what `fill` throws passes through.
void write_file(std::string const& path, std::string const& format, FillOutput const& fill,
                bool in_parts = false);

} // namespace weft::image
