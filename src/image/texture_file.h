// From an image file to one that the texture cache reads well: tiles of 64 x 64 texels with all mip
// levels, first three channels (or the first of fewer), in the type and the encoding of the source
// where that holds the picture as it is, else linear Rec. 709 floats (shown_picture.h).
//
// Not OpenImageIO's make_texture: that makes levels of encoded numbers or of decoded floats. Ours
// are means of linear values, encoded again, and the same bits as the levels of a texture in memory
// (mip_levels.h); and the image passes through in strips, so that it need not fit into memory: a
// conversion holds a quarter of it.
#pragma once

#include <functional>
#include <string>

#include "image/texture.h"

namespace weft::image {

/// Called now and then with what is done, in [0, 1]. What it throws ends the conversion.
using ConversionProgress = std::function<void(double fraction)>;

/// Writes `to` (TIFF for integers, EXR for floats, whatever its extension) in one step. `encoding`:
/// how colours in `from` are read. Throws InputError for `from` like
/// `read_image`, IoError for `to`.
void make_texture_file(std::string const& from, std::string const& to, Encoding encoding,
                       ConversionProgress const& progress = {});

} // namespace weft::image
