#include "schema/element.h"

#include <algorithm>

#include "schema/text.h"

namespace weft::schema {

Attribute const* Element::find(std::string_view name) const {
    for (Attribute const& a : attributes)
        if (a.name == name) return &a;
    return nullptr;
}

std::string_view Element::get(std::string_view name) const {
    Attribute const* a = find(name);
    return a ? std::string_view(a->value) : std::string_view();
}

void Element::set(std::string_view name, std::string value) {
    edited = true;
    for (Attribute& a : attributes) {
        if (a.name != name) continue;
        a.value = std::move(value);
        return;
    }
    attributes.push_back({std::string(name), std::move(value), where});
}

void Element::erase(std::string_view name) {
    edited |= std::erase_if(attributes, [&](Attribute const& a) { return a.name == name; }) > 0;
}

void Element::set_tag(std::string other) {
    tag = std::move(other);
    edited = true;
}

Element& Element::add(std::string child_tag) {
    auto child = std::make_unique<Element>();
    child->tag = std::move(child_tag);
    child->where = where;
    child->folder = folder;
    return *children.emplace_back(std::move(child));
}

std::unique_ptr<Element> Element::take(Element const& child) {
    for (auto it = children.begin(); it != children.end(); ++it) {
        if (it->get() != &child) continue;
        std::unique_ptr<Element> taken = std::move(*it);
        children.erase(it);
        return taken;
    }
    return nullptr;
}

bool is_property_tag(std::string_view tag) {
    static constexpr std::array<std::string_view, 6> tags{"integer", "float", "string",
                                                          "boolean", "color", "vector"};
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

std::string element_title(Element const& element) {
    std::string title = "<" + element.tag;
    if (Attribute const* type = element.find("type")) {
        std::string const text = in_quotes(type->value);
        title += " type=\"" + text.substr(1, text.size() - 2) + "\"";
    }
    return title + ">";
}

namespace {

bool is_called(Element const& child, std::string_view name) {
    std::string_view const given = child.get("name");
    return given.empty() ? child.tag == name && !is_property_tag(child.tag) : given == name;
}

} // namespace

Element* parameter_child(Element& element, std::string_view name) {
    for (auto const& child : element.children)
        if (is_called(*child, name)) return child.get();
    return nullptr;
}

bool has_parameter(Element const& element, std::string_view name) {
    if (element.find(name)) return true;
    return std::any_of(element.children.begin(), element.children.end(),
                       [&](auto const& child) { return is_called(*child, name); });
}

Attribute* parameter_value(Element& element, std::string_view name) {
    auto const attribute_of = [](Element& e, std::string_view wanted) -> Attribute* {
        for (Attribute& a : e.attributes)
            if (a.name == wanted) return &a;
        return nullptr;
    };
    if (Attribute* a = attribute_of(element, name)) return a;
    Element* child = parameter_child(element, name);
    if (!child) return nullptr;
    bool const constant = child->tag == "texture" && child->get("type") == "constant";
    return is_property_tag(child->tag) || constant ? attribute_of(*child, "value") : nullptr;
}

std::string parameter_text(Element& element, std::string_view name) {
    Attribute const* a = parameter_value(element, name);
    return a ? a->value : std::string();
}

std::optional<Color> parameter_color(Element& element, std::string_view name) {
    Color color;
    Attribute const* a = parameter_value(element, name);
    if (!a || !TextForm<Color>::read(a->value, color)) return {};
    return color;
}

std::optional<double> parameter_number(Element& element, std::string_view name) {
    Attribute const* a = parameter_value(element, name);
    auto const numbers = a ? read_components(a->value, 1) : std::nullopt;
    return numbers ? std::optional(numbers->front()) : std::nullopt;
}

SourceLocation const& parameter_place(Element& element, std::string_view name) {
    if (Attribute const* a = element.find(name)) return a->where;
    Element const* child = parameter_child(element, name);
    return child ? child->where : element.where;
}

void erase_parameter(Element& element, std::string_view name) {
    element.erase(name);
    std::erase_if(element.children, [&](auto const& child) { return is_called(*child, name); });
}

void rename_parameter(Element& element, std::string_view name, std::string_view other) {
    for (Attribute& a : element.attributes)
        if (a.name == name) {
            a.name = other;
            element.edited = true;
        }
    for (auto const& child : element.children)
        if (is_called(*child, name)) child->set("name", std::string(other));
}

void set_parameter(Element& element, std::string_view name, std::string value) {
    SourceLocation const where = parameter_place(element, name);
    std::erase_if(element.children, [&](auto const& child) { return is_called(*child, name); });
    element.set(name, std::move(value));
    for (Attribute& a : element.attributes)
        if (a.name == name) a.where = where;
}

} // namespace weft::schema
