// Lamps as measured: IES files (ANSI/IESNA LM-63, its editions of 1986, 1991, 1995 and 2002).
//
// Read is photometry of type C, nearly all there is, with every symmetry that the standard knows:
// one horizontal angle (the same all around), 0 to 90 (four quarters), 0 to 180 and 90 to 270 (two
// halves), 0 to 360; a file that ends between 180 and 360 is closed by its first plane. Vertical
// angles are 0 to 90, 90 to 180 or 0 to 180, or any part of these. Candela are the file's times its
// candela multiplier, its ballast factor and its ballast-lamp photometric factor. Whatever stands
// before TILT is not looked at, the tilt of TILT=INCLUDE is read and not used: lamps hang as they
// were measured. The size of the opening is left out, as a light has its own radius.
//
// Refused are photometry of type A and B (floodlights and car lamps), and TILT with a file's name.
#pragma once

#include "scene/photometry.h"

#include <string>
#include <string_view>

namespace weft::io {

/// The lamp of the file `path`, planes completed to all around. Throws InputError, with line and
/// column, for a file that is not well-formed.
scene::Photometry read_ies(std::string const& path);

/// The same for a file already in memory; `name` stands in for its path in messages.
scene::Photometry read_ies(std::string_view bytes, std::string const& name);

} // namespace weft::io
