// The templates of ObjectReader and SceneBuilder; included by the two sources that read objects.
#pragma once

#include "base/match.h"
#include "io/scene_builder.h"
#include "io/transform_reader.h"

namespace weft::io {

namespace detail {

template <class T>
inline constexpr bool is_id = false;
template <class Kind>
inline constexpr bool is_id<schema::Id<Kind>> = true;
template <class T>
inline constexpr bool is_list = false;
template <class Kind>
inline constexpr bool is_list<std::vector<schema::Id<Kind>>> = true;
template <class T>
inline constexpr bool is_input = false;
template <class T>
inline constexpr bool is_input<schema::Input<T>> = true;

inline void check_value(float v, auto&& check) {
    check(v);
}
inline void check_value(int v, auto&& check) {
    check(v);
}
inline void check_value(Color const& c, auto&& check) {
    for (float v : {c.r, c.g, c.b}) check(v);
}
template <class T>
void check_value(schema::Input<T> const& v, auto&& check) {
    check_value(v.value, check);
}
template <class T>
void check_value(T const&, auto&&) {}

template <class Kind>
constexpr std::string_view category_of(schema::Id<Kind> const&) {
    return Kind::category;
}
template <class Kind>
constexpr std::string_view category_of(std::vector<schema::Id<Kind>> const&) {
    return Kind::category;
}
template <class T>
constexpr std::string_view category_of(T const&) {
    return "";
}

} // namespace detail

template <class T>
void ObjectReader::operator()(std::string_view name, T& value, schema::Attr const& attr) {
    known_.emplace_back(name);
    bool found = false;
    std::string_view const category = detail::category_of(value);
    if (XmlAttribute const* a = element_.find(name)) {
        read_text(name, *a, value, attr);
        found = true;
    }
    for (size_t i = 0; i < element_.children.size(); ++i) {
        XmlElement const& child = *element_.children[i];
        if (child_used_[i] || !matches(child, name, category)) continue;
        if (child.tag == "ref" && child.get("name").empty()) {
            std::string_view const target = builder_.resolve(child).tag;
            bool const bare_shape = category == "instance" && target == "shape";
            if (target != (category.empty() ? name : category) && !bare_shape) continue;
        }
        if (found && !detail::is_list<T>) twice(name, child.where);
        read_child(name, child, value, attr);
        child_used_[i] = found = true;
    }
    if (!found && attr.required) missing(name, attr, schema::TextForm<T>::kind, category);
}

template <class T>
void ObjectReader::read_text(std::string_view name, XmlAttribute const& from, T& value,
                             schema::Attr const& attr) {
    if constexpr (requires { schema::TextForm<T>::read(std::string_view(), value); }) {
        if (!schema::TextForm<T>::read(from.value, value)) {
            std::string expected(schema::TextForm<T>::expected), hint;
            if constexpr (schema::Choice<T>) {
                auto const names = choices(value);
                std::vector<std::string> const known(names.begin(), names.end());
                expected = "one of";
                for (auto const& c : known) expected += (&c == &known.front() ? " " : ", ") + c;
                if (auto const near = nearest_name(from.value, known); !near.empty())
                    hint = suggestion(from.value, known);
            }
            throw InputError(from.where, "'" + std::string(name) + "' of " +
                                             element_title(element_) + " expects " + expected +
                                             ", found '" + from.value + "'" + hint);
        }
        detail::check_value(value,
                            [&](double v) { check_range(v, attr, name, from.where, from.value); });
    } else {
        throw InputError(from.where, "'" + std::string(name) + "' of " + element_title(element_) +
                                         " expects a child tag <" +
                                         std::string(detail::category_of(value)) + ">, found '" +
                                         from.value + "'");
    }
}

template <class T>
void ObjectReader::read_child(std::string_view name, XmlElement const& child, T& value,
                              schema::Attr const& attr) {
    if (is_property_tag(child.tag)) {
        read_text(name, property_value(child), value, attr);
        return;
    }
    if constexpr (detail::is_id<T>) {
        value = [&]<class Kind>(schema::Id<Kind>) { return builder_.object<Kind>(child); }(value);
    } else if constexpr (detail::is_list<T>) {
        [&]<class Kind>(std::vector<schema::Id<Kind>>& list) {
            list.push_back(builder_.object<Kind>(child));
        }(value);
    } else if constexpr (std::is_same_v<T, Affined>) {
        XmlElement const& target = builder_.resolve(child);
        if (target.tag != "transform")
            throw InputError(child.where, "expected a <transform>, found " + element_title(target));
        value = read_transform(target);
    } else if constexpr (detail::is_input<T> || std::is_same_v<T, Color> ||
                         std::is_same_v<T, float>) {
        auto const texture = builder_.object<schema::TextureKind>(child);
        Color const* constant = builder_.constant_texture(texture);
        auto assign = [&](auto& to) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(to)>, float>)
                to = average(*constant);
            else
                to = *constant;
        };
        if constexpr (detail::is_input<T>) {
            if (constant)
                assign(value.value);
            else
                value.texture = texture;
        } else {
            if (!constant)
                throw InputError(
                    child.where,
                    "'" + std::string(name) + "' of " + element_title(element_) +
                        " cannot vary: expected a value or a constant texture, found " +
                        element_title(builder_.resolve(child)));
            assign(value);
        }
    } else {
        throw InputError(child.where, "'" + std::string(name) + "' of " + element_title(element_) +
                                          " expects " + std::string(schema::TextForm<T>::expected) +
                                          ", found " + element_title(child));
    }
}

template <class T>
T SceneBuilder::read_struct(XmlElement const& element) {
    static_assert(schema::all_described<T>, "describe() leaves out a member of this type");
    T object{};
    ObjectReader reader(*this, element);
    if constexpr (std::is_same_v<T, scene::SceneContents>) reader.allow_definitions();
    object.describe(reader);
    reader.finish();
    complete(object, element);
    return object;
}

template <class Variant>
Variant SceneBuilder::read_variant(XmlElement const& element) {
    std::vector<std::string> known;
    std::string_view const type = element.get("type");
    Variant result;
    bool found = false;
    for_each_type<Variant>([&]<class T>() {
        known.emplace_back(T::info.type);
        if (found || T::info.type != type) return;
        result = read_struct<T>(element);
        found = true;
    });
    if (found) return result;
    XmlAttribute const* a = element.find("type");
    if (!a)
        throw InputError(element.where,
                         "<" + element.tag + "> expects type=\"...\"" + suggestion("", known));
    throw InputError(a->where, "unknown type '" + a->value + "' of <" + element.tag + ">" +
                                   suggestion(a->value, known));
}

template <class Kind>
schema::Id<Kind> SceneBuilder::object(XmlElement const& element) {
    XmlElement const& target = resolve(element);
    bool const bare_shape = std::is_same_v<Kind, scene::InstanceKind> && target.tag == "shape";
    if (target.tag != Kind::category && !bare_shape)
        throw InputError(element.where, std::string("expected a <") + Kind::category + ">, found " +
                                            element_title(target));
    auto const [it, fresh] = read_.emplace(std::pair(&target, Kind::category), -1);
    if (!fresh) {
        if (it->second < 0)
            throw InputError(element.where, element_title(target) + " contains itself");
        return {it->second};
    }
    int32_t const index = add(Kind{}, target);
    read_[{&target, Kind::category}] = index;
    return {index};
}

} // namespace weft::io
