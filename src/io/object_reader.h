// From elements to described structs: the half of the scene reader that knows parameters but no
// particular type. An `ObjectReader` is passed to `describe`; each parameter takes its value from
// the attribute or child tag of its name. What is left over in the end is an error.
#pragma once

#include <string>
#include <vector>

#include "io/xml_document.h"
#include "schema/schema.h"

namespace weft::io {

class SceneBuilder;

/// The name under which a child fills a parameter: its `name`, else its tag.
std::string_view child_name(XmlElement const& child);
/// Whether the tag is one of integer, float, string, boolean, color, vector.
bool is_property_tag(std::string_view tag);
/// "<camera type="thinlens">", for messages.
std::string element_title(XmlElement const& element);
/// The value of a property tag; throws where it has none.
XmlAttribute const& property_value(XmlElement const& child);
/// Throws where the number `value` of parameter `name` lies outside of its range.
void check_range(double value, schema::Attr const& attr, std::string_view name,
                 SourceLocation const& where, std::string const& found);

class ObjectReader {
public:
    ObjectReader(SceneBuilder& builder, XmlElement const& element)
        : builder_(builder), element_(element),
          child_used_(element.children.size()), known_{"type", "id", "name"} {}

    template <class T>
    void operator()(std::string_view name, T& value, schema::Attr const& attr);
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }

    /// Children of these tags with an id are definitions for use by reference, not parameters.
    void allow_definitions() { definitions_ = true; }
    /// Throws at the first attribute or child that no parameter took.
    void finish() const;

private:
    template <class T>
    void read_text(std::string_view name, XmlAttribute const& from, T& value,
                   schema::Attr const& attr);
    template <class T>
    void read_child(std::string_view name, XmlElement const& child, T& value,
                    schema::Attr const& attr);
    bool matches(XmlElement const& child, std::string_view name, std::string_view category) const;
    [[noreturn]] void twice(std::string_view name, SourceLocation const& where) const;
    [[noreturn]] void missing(std::string_view name, schema::Attr const& attr,
                              std::string_view kind, std::string_view category) const;

    SceneBuilder& builder_;
    XmlElement const& element_;
    std::vector<bool> child_used_;
    std::vector<std::string> known_;
    bool definitions_ = false;
};

} // namespace weft::io
