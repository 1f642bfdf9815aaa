// An object as a file spells it: a tag with attributes and child tags, every name and value with
// its place in the file. Readers make described structs of elements; the dialects of the format
// (schema/alias.h) are rules that rewrite elements before that.
//
// A parameter may be spelled in four ways: as an attribute, as a property tag (`<float name="fov"
// value="40"/>`), as a child object called by `name` or by its tag, and as a reference.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/color.h"
#include "base/error.h"
#include "base/shared_text.h"

namespace weft::schema {

struct Attribute {
    std::string name, value;
    SourceLocation where; ///< of the name
};

/// Where an element stands in its file, in bytes. Elements that no file holds have end == 0.
struct TextRange {
    size_t begin = 0;   ///< of the '<'
    size_t inside = 0;  ///< behind the '>' of the opening tag
    size_t closing = 0; ///< of the closing tag; equal to `end` where there is none ("<a/>")
    size_t end = 0;     ///< behind the last '>'
};

struct Element {
    std::string tag;
    std::vector<Attribute> attributes;
    std::vector<std::unique_ptr<Element>> children;
    SourceLocation where; ///< of the '<'
    SharedText folder;    ///< of the file: what its relative paths start from
    TextRange text;
    bool edited = false; ///< whether its tag or attributes differ from the file's

    Attribute const* find(std::string_view name) const;
    /// The attribute's value, or "" where there is none.
    std::string_view get(std::string_view name) const;

    // Edits, which keep `edited` true to its word.
    void set(std::string_view name, std::string value);
    void erase(std::string_view name);
    void set_tag(std::string tag);
    /// Appends a child that no file holds; it stands where this element does.
    Element& add(std::string tag);
    /// Takes a child out; null where `child` is none of its own.
    std::unique_ptr<Element> take(Element const& child);
};

/// Whether the tag is one of integer, float, string, boolean, color, vector.
bool is_property_tag(std::string_view tag);
/// "<camera type="thinlens">", for messages.
std::string element_title(Element const& element);

// Parameters, however they are spelled.

/// Whether the element has an attribute of this name, or a child that is called so.
bool has_parameter(Element const& element, std::string_view name);
/// The child that is called so; null where there is none.
Element* parameter_child(Element& element, std::string_view name);
/// What holds the parameter's text: its attribute, that of its property tag, or that of a constant
/// texture. Null where there is none of these.
Attribute* parameter_value(Element& element, std::string_view name);
/// The parameter's text; "" where there is none.
std::string parameter_text(Element& element, std::string_view name);
/// One number or three; nothing where something else is said, or nothing.
std::optional<Color> parameter_color(Element& element, std::string_view name);
std::optional<double> parameter_number(Element& element, std::string_view name);
/// The place of the parameter; that of the element where it has none.
SourceLocation const& parameter_place(Element& element, std::string_view name);

void erase_parameter(Element& element, std::string_view name);
/// Calls a parameter by another name.
void rename_parameter(Element& element, std::string_view name, std::string_view other);
/// Gives a parameter as an attribute, instead of whatever was said of it.
void set_parameter(Element& element, std::string_view name, std::string value);

} // namespace weft::schema
