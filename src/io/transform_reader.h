// `<transform>`: translate, scale, rotate, matrix and lookat, applied in the order in which they
// stand.
#pragma once

#include "base/affine.h"
#include "io/xml_document.h"

namespace weft::io {

/// The product of the element's children. Throws InputError where one is unknown or malformed,
/// or where the result cannot be inverted (a scale of 0, `up` along the view direction, ...).
Affined read_transform(XmlElement const& element);

/// Throws InputError at `where` unless `m` and its inverse are made of numbers that fit floats.
void check_invertible(Affined const& m, SourceLocation const& where);

} // namespace weft::io
