// Other dialects of the scene format (schema/alias.h) become today's words before anything is read.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/xml_document.h"

namespace weft::io {

/// Rewrites all elements below `root` by the rules of the types' declarations. Returns a note for
/// each rule that a file needed, with the first place: "FILE:LINE:COLUMN: 'radius' of <camera
/// type="thinlens"> is called `lensRadius` today". Throws InputError where a word of another
/// dialect is used in a way that has no meaning today.
std::vector<std::string> modernise(XmlElement& root);

} // namespace weft::io
