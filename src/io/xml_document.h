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

#include "base/error.h"

namespace weft::io {

struct XmlAttribute {
    std::string name, value;
    SourceLocation where; ///< of the name
};

struct XmlElement {
    std::string tag;
    std::vector<XmlAttribute> attributes;
    std::vector<std::unique_ptr<XmlElement>> children;
    SourceLocation where; ///< of the '<'
    std::string folder;   ///< of the file: what its relative paths start from

    XmlAttribute const* find(std::string_view name) const;
    /// The attribute's value, or "" where there is none.
    std::string_view get(std::string_view name) const;
};

/// Tags nested deeper than this are an accident or an attack, and would exhaust the stack.
inline constexpr int kMaxNesting = 200;

/// Reads the file at `path`; the root element has the tag "" and the file's objects as children.
/// Throws InputError: missing file, malformed XML, text between tags, an attribute given twice,
/// nesting beyond kMaxNesting, an include that is missing or cyclic.
std::unique_ptr<XmlElement> read_xml(std::string const& path);

/// As read_xml, for text in memory (includes are looked for in `folder`).
std::unique_ptr<XmlElement> parse_xml(std::string_view text, std::string const& name,
                                      std::string const& folder);

/// The path of the regular file `file`, relative to `folder`. Throws InputError at `where` for a
/// file that is missing, a folder, or a device.
std::string existing_file(std::string const& folder, std::string const& file,
                          SourceLocation const& where);

} // namespace weft::io
