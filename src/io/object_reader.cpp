#include "io/object_reader.h"

#include <algorithm>
#include <array>

#include "io/scene_builder.h"
#include "schema/messages.h"

namespace weft::io {

namespace {

/// Attributes that every object may have beside its parameters.
std::array<std::string, 3> const kReserved{"type", "id", "name"};

bool contains(std::span<std::string const> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

std::span<std::string const> definition_tags() {
    static std::array<std::string, 13> const tags{
        "bsdf",   "texture", "shape", "instance",  "light", "emission", "volume",
        "medium", "camera",  "image", "transform", "layer", "display"};
    return tags;
}

bool is_definition_tag(std::string_view tag) { return contains(definition_tags(), tag); }

SourceLocation const& location_of(XmlElement const& element, std::string_view name) {
    if (name.empty()) return element.where;
    if (XmlAttribute const* a = element.find(name)) return a->where;
    for (auto const& child : element.children)
        if (child->get("name") == name) return child->where;
    return element.where;
}

void expect_type(XmlElement const& e, std::string_view type) {
    std::string const name(type);
    XmlAttribute const* a = e.find("type");
    if (!a) throw InputError(e.where, "<" + e.tag + "> expects type=\"" + name + "\"");
    if (a->value != type)
        throw InputError(a->where, "unknown type " + in_quotes(a->value) + " of <" + e.tag + ">" +
                                       suggestion(a->value, std::vector{name}));
}

bool is_given(XmlElement const& element, std::string_view name) {
    return &location_of(element, name) != &element.where;
}

std::string ObjectReader::title_of(std::string_view name) const {
    return "'" + std::string(name) + "' of " + element_title(element_);
}

XmlAttribute const& ObjectReader::property_value(XmlElement const& child) const {
    XmlAttribute const* value = child.find("value");
    if (!value || !child.find("name"))
        throw InputError(child.where, "<" + child.tag + "> expects name=\"...\" value=\"...\"");
    for (XmlAttribute const& a : child.attributes)
        if (a.name != "name" && a.name != "value")
            throw InputError(a.where, "unknown parameter " + in_quotes(a.name) + " of <" +
                                          child.tag + ">; known: name, value");
    if (!child.children.empty())
        throw InputError(child.children.front()->where, "<" + child.tag +
                                                            "> has no child tags, found " +
                                                            element_title(*child.children.front()));
    return *value;
}

bool ObjectReader::is_definition(XmlElement const& child) const {
    return definitions_ && !child.get("id").empty() && is_definition_tag(child.tag);
}

bool ObjectReader::matches(XmlElement const& child, std::string_view name,
                           std::string_view category) const {
    std::string_view const given = child.get("name");
    if (!given.empty()) return given == name;
    // A bare shape stands for an instance of it, unless it is there to be referred to.
    if (child.tag == "shape" && category == "instance") return !is_definition(child);
    if (child.tag != "ref") return child.tag == name;
    // What a nameless reference fills is told by what it refers to.
    std::string const& target = builder_.resolve(child).tag;
    return target == name || (target == "shape" && category == "instance");
}

void ObjectReader::missing(std::string_view name, schema::Attr const& attr, std::string_view kind,
                           std::string_view category) const {
    throw InputError(element_.where, element_title(element_) + " expects " +
                                         schema::missing_phrase(name, kind, category) +
                                         ", found none: " + std::string(attr.help));
}

void ObjectReader::finish(std::string_view type) const {
    for (XmlAttribute const& a : element_.attributes) {
        if (a.name == "type" && a.value != (type.empty() ? "default" : type))
            throw InputError(a.where, "unknown type " + in_quotes(a.value) + " of <" +
                                          element_.tag + ">; it has no types");
        if (contains(kReserved, a.name) || contains(known_, a.name)) continue;
        std::vector<std::string> names(known_);
        names.insert(names.end(), kReserved.begin(), kReserved.end());
        throw InputError(a.where, "unknown parameter " + in_quotes(a.name) + " of " +
                                      element_title(element_) + suggestion(a.name, names));
    }
    for (size_t i = 0; i < element_.children.size(); ++i)
        if (!child_used_[i] && !is_definition(*element_.children[i]))
            unknown_child(*element_.children[i]);
}

void ObjectReader::unknown_child(XmlElement const& child) const {
    std::string const title = element_title(element_), name(child.get("name"));
    if (!name.empty()) {
        if (contains(kReserved, name))
            throw InputError(child.where, title_of(name) + " must be an attribute");
        throw InputError(child.where, "unknown parameter " + in_quotes(name) + " of " + title +
                                          suggestion(name, known_));
    }
    if (is_property_tag(child.tag)) property_value(child);
    std::vector<std::string> tags(known_);
    if (definitions_) {
        auto const more = definition_tags();
        if (contains(more, child.tag))
            throw InputError(child.where, element_title(child) + " in " + title +
                                              " expects an id: nothing can refer to it");
        tags.insert(tags.end(), more.begin(), more.end());
    }
    if (child.tag == "ref")
        throw InputError(child.where, title + " has no place for the " +
                                          element_title(builder_.resolve(child)) +
                                          " that <ref> refers to");
    throw InputError(child.where,
                     "unknown tag <" + child.tag + "> in " + title + suggestion(child.tag, tags));
}

} // namespace weft::io
