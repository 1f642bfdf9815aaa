// From elements to described structs: the half of the scene reader that knows parameters but no
// particular type. An `ObjectReader` is passed to `describe`; each parameter takes its value from
// the attribute or child tag of its name. What is left over in the end is an error.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/xml_document.h"
#include "scene/check.h"
#include "schema/schema.h"

namespace weft::io {

class SceneBuilder;

using schema::element_title;
using schema::is_property_tag;

/// The tags of objects that may stand beside the parameters of a scene or test, and at the root
/// of a file, for use by reference.
std::span<std::string const> definition_tags();
bool is_definition_tag(std::string_view tag);
/// Where the parameter `name` of an object stands; the object's own place where it is not given.
SourceLocation const& location_of(XmlElement const& element, std::string_view name);
/// Returns whether the element has an attribute of this name, or a child called so.
bool is_given(XmlElement const& element, std::string_view name);

/// Throws unless the element names this type: the only one that its category has.
void expect_type(XmlElement const& element, std::string_view type);

/// An element as the rules of scenes speak of it.
class ElementReport final : public scene::Report {
  public:
    explicit ElementReport(XmlElement const& element) : element_(element) {}
    std::string title() const override { return element_title(element_); }
    SourceLocation where(std::string_view parameter) const override {
        return location_of(element_, parameter);
    }

  private:
    XmlElement const& element_;
};

class ObjectReader {
  public:
    ObjectReader(SceneBuilder& builder, XmlElement const& element)
        : builder_(builder), element_(element), child_used_(element.children.size()) {}

    template <class T>
    void operator()(std::string_view name, T& value, schema::Attr const& attr);
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }

    /// Children with an id are definitions for use by reference, not parameters.
    void allow_definitions() { definitions_ = true; }
    /// Throws at the first attribute or child that no parameter took. `type` is the only one that
    /// the object may name; "" where there is none (lightwave calls that "default").
    void finish(std::string_view type) const;

  private:
    template <class T>
    void read_text(std::string_view name, XmlAttribute const& from, T& value,
                   schema::Attr const& attr);
    template <class T>
    void read_child(std::string_view name, XmlElement const& child, T& value,
                    schema::Attr const& attr);
    template <class T>
    void read_texture(std::string_view name, XmlElement const& child, T& value,
                      schema::Attr const& attr);
    bool matches(XmlElement const& child, std::string_view name, std::string_view category) const;
    bool is_definition(XmlElement const& child) const;
    /// The attribute that holds a property tag's value. Throws where the tag is malformed.
    XmlAttribute const& property_value(XmlElement const& child) const;
    std::string title_of(std::string_view name) const;
    [[noreturn]] void unknown_child(XmlElement const& child) const;
    [[noreturn]] void missing(std::string_view name, schema::Attr const& attr,
                              std::string_view kind, std::string_view category) const;

    SceneBuilder& builder_;
    XmlElement const& element_;
    std::vector<bool> child_used_;
    std::vector<std::string> known_; ///< the names of the parameters so far
    bool definitions_ = false;
};

} // namespace weft::io
