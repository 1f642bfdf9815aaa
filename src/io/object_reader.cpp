#include "io/object_reader.h"

#include <algorithm>
#include <array>

namespace weft::io {

std::string_view child_name(XmlElement const& child) {
    std::string_view const name = child.get("name");
    return name.empty() ? std::string_view(child.tag) : name;
}

bool is_property_tag(std::string_view tag) {
    static constexpr std::array<std::string_view, 6> tags{"integer", "float", "string",
                                                          "boolean", "color", "vector"};
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

std::string element_title(XmlElement const& element) {
    std::string title = "<" + element.tag;
    if (XmlAttribute const* type = element.find("type")) title += " type=\"" + type->value + "\"";
    return title + ">";
}

XmlAttribute const& property_value(XmlElement const& child) {
    XmlAttribute const* value = child.find("value");
    if (!value)
        throw InputError(child.where, "<" + child.tag + "> expects name=\"...\" value=\"...\"");
    for (XmlAttribute const& a : child.attributes)
        if (a.name != "name" && a.name != "value")
            throw InputError(a.where, "unknown parameter '" + a.name + "' of <" + child.tag +
                                          ">; known: name, value");
    if (!child.children.empty())
        throw InputError(child.children.front()->where, "<" + child.tag +
                                                            "> has no child tags, found " +
                                                            element_title(*child.children.front()));
    return *value;
}

void check_range(double value, schema::Attr const& attr, std::string_view name,
                 SourceLocation const& where, std::string const& found) {
    if (value >= attr.min && value <= attr.max) return;
    bool const low = std::isfinite(attr.min), high = std::isfinite(attr.max);
    std::string range = low ? "at least " + schema::number_text(attr.min) : "";
    if (high)
        range += (low ? " and " : "") + std::string("at most ") + schema::number_text(attr.max);
    throw InputError(where, "'" + std::string(name) + "' expects a value of " + range +
                                ", found '" + found + "'");
}

bool ObjectReader::matches(XmlElement const& child, std::string_view name,
                           std::string_view category) const {
    std::string_view const given = child.get("name");
    if (!given.empty()) return given == name;
    // A bare shape stands for an instance of it, unless it is there to be referred to.
    if (child.tag == "shape" && category == "instance") return !(definitions_ && child.find("id"));
    if (child.tag != "ref") return child.tag == name;
    return name == category || name == "texture"; // checked for its category when resolved
}

void ObjectReader::twice(std::string_view name, SourceLocation const& where) const {
    throw InputError(where, "'" + std::string(name) + "' of " + element_title(element_) +
                                " is given twice");
}

void ObjectReader::missing(std::string_view name, schema::Attr const& attr, std::string_view kind,
                           std::string_view category) const {
    std::string const what = category.empty() ? std::string(kind) + " '" + std::string(name) + "'"
                                              : "a <" + std::string(category) + ">";
    throw InputError(element_.where, element_title(element_) + " expects " + what +
                                         ", found none: " + std::string(attr.help));
}

void ObjectReader::finish() const {
    for (XmlAttribute const& a : element_.attributes)
        if (std::find(known_.begin(), known_.end(), a.name) == known_.end())
            throw InputError(a.where, "unknown parameter '" + a.name + "' of " +
                                          element_title(element_) + suggestion(a.name, known_));
    for (size_t i = 0; i < element_.children.size(); ++i) {
        XmlElement const& child = *element_.children[i];
        if (child_used_[i]) continue;
        if (definitions_ && child.find("id") && !is_property_tag(child.tag)) continue;
        std::string const name(child_name(child));
        throw InputError(child.where, "unknown parameter '" + name + "' of " +
                                          element_title(element_) + suggestion(name, known_));
    }
}

} // namespace weft::io
