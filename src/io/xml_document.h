// A scene file as a tree of elements, every name and value with its place in the file, and
// `<include>`s already replaced by what they name. XML itself is pugixml's business.
//
// Columns count bytes. Left out on purpose: encodings other than UTF-8, and document type
// definitions, whose entities are not expanded.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "schema/element.h"

namespace weft::io {

using XmlAttribute = schema::Attribute;
using XmlElement = schema::Element;

/// Tags nested deeper than this are an accident or an attack, and would exhaust the stack.
inline constexpr int kMaxNesting = 200;

/// Reads the file at `path`; the root element has the tag "" and the file's objects as children.
/// Those of a <lightwave> tag stand for themselves, and `${name}` in a value for what <default
/// name="..." value="..."/> says before it, the first that names it.
/// Throws InputError: missing file, malformed XML, text between tags, an attribute given twice,
/// nesting beyond kMaxNesting, an include that is missing or cyclic, an unknown name in `${}`.
std::unique_ptr<XmlElement> read_xml(std::string const& path);

/// Does what read_xml does, for text in memory; includes are looked for in `folder`.
std::unique_ptr<XmlElement> parse_xml(std::string_view text, std::string const& name,
                                      std::string const& folder);

/// As parse_xml, for those who write the text again: elements know where they stand in it (counted
/// without a byte order mark), and <include>, <lightwave>, <default> and `${name}` stay what they
/// are.
std::unique_ptr<XmlElement> parse_xml_as_written(std::string_view text, std::string const& name);

std::string_view without_byte_order_mark(std::string_view text);

/// The path of the regular file `file`, relative to `folder`. Throws InputError at `where` for a
/// file that is missing, a folder, or a device.
std::string existing_file(std::string const& folder, std::string const& file,
                          SourceLocation const& where);

} // namespace weft::io
