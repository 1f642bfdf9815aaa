// The templates of ObjectReader and SceneBuilder; included by the two sources that read objects.
#pragma once

#include "base/match.h"
#include "io/scene_builder.h"
#include "io/transform_reader.h"
#include "scene/scene_vectors.h"
#include "schema/messages.h"

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

template <class T>
constexpr std::string_view category_of(T const&) {
    return "";
}
template <class Kind>
constexpr std::string_view category_of(schema::Id<Kind> const&) {
    return Kind::category;
}
template <schema::SurfaceDefault T>
constexpr std::string_view category_of(schema::Input<T> const&) {
    return "texture";
}
template <class Kind>
constexpr std::string_view category_of(std::vector<schema::Id<Kind>> const&) {
    return Kind::category;
}

/// What a parameter expects, and for a choice also which of them may have been meant.
template <class T>
std::pair<std::string, std::string> expectation(T const& value, std::string_view found) {
    if constexpr (schema::ChoiceList<T>) {
        // The first word that is none of them.
        typename T::value_type one{};
        for (std::string_view const word : schema::split_words(found))
            if (!schema::TextForm<typename T::value_type>::read(word, one)) {
                auto const [expected, hint] = expectation(one, word);
                return {"any " + expected.substr(4), hint};
            }
        return {std::string(schema::TextForm<T>::expected), ""};
    } else if constexpr (schema::Choice<T>) {
        auto const names = choices(value);
        std::vector<std::string> const known(names.begin(), names.end());
        std::string expected = "one of";
        for (auto const& c : known) expected += (&c == &known.front() ? " " : ", ") + c;
        if constexpr (requires { why_missing(value, found); })
            if (auto const why = why_missing(value, found); !why.empty())
                return {expected, std::string(why)};
        return {expected, nearest_name(found, known).empty() ? "" : suggestion(found, known)};
    } else {
        return {std::string(schema::TextForm<T>::expected), ""};
    }
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
        if (found && !detail::is_list<T>)
            throw InputError(child.where, title_of(name) + " is given twice");
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
            auto const [expected, hint] = detail::expectation(value, from.value);
            throw InputError(from.where, title_of(name) + " expects " + expected + ", found " +
                                             in_quotes(from.value) + hint);
        }
        if constexpr (std::is_same_v<T, Affined>) check_invertible(value, from.where);
        if constexpr (requires { schema::in_range(value, attr); })
            if (!schema::in_range(value, attr))
                throw InputError(from.where, title_of(name) + " expects a value of " +
                                                 schema::range_phrase(attr) + ", found " +
                                                 in_quotes(from.value));
    } else {
        throw InputError(from.where, title_of(name) + " expects a child tag <" +
                                         std::string(detail::category_of(value)) + ">, found " +
                                         in_quotes(from.value));
    }
}

template <class T>
void ObjectReader::read_child(std::string_view name, XmlElement const& child, T& value,
                              schema::Attr const& attr) {
    if (is_property_tag(child.tag)) {
        read_text(name, property_value(child), value, attr);
    } else if constexpr (detail::is_id<T>) {
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
        read_texture(name, child, value, attr);
    } else {
        throw InputError(child.where, title_of(name) + " expects " +
                                          detail::expectation(value, "").first + ", found " +
                                          element_title(child));
    }
}

/// A parameter from a node, whose type must fit. A constant one is its value (for a number, the
/// channels' mean); any other is kept as it is, where the parameter may vary.
template <class T>
void ObjectReader::read_texture(std::string_view name, XmlElement const& child, T& value,
                                schema::Attr const& attr) {
    auto const id = builder_.object<schema::TextureKind>(child);
    scene::Texture const& texture = builder_.texture(id);
    XmlElement const& element = builder_.resolve(child);
    if constexpr (detail::is_input<T>) {
        auto const wanted = schema::input_type<decltype(value.value)>;
        auto const given = builder_.type_of(id);
        if (!scene::accepts(wanted, given))
            throw InputError(child.where, title_of(name) + " expects a " +
                                              std::string(schema::type_name(wanted)) +
                                              ", found a " + std::string(schema::type_name(given)) +
                                              " from " + element_title(element) +
                                              "; `convert` and `extract` make one of the other");
    }
    auto check = [&](Color const& c, std::string_view parameter) {
        if (schema::in_range(c, attr)) return;
        throw InputError(location_of(element, parameter),
                         title_of(name) + " expects a value of " + schema::range_phrase(attr) +
                             ", found '" + schema::TextForm<Color>::write(c) + "'");
    };
    if (auto const* checkerboard = std::get_if<scene::Checkerboard>(&texture)) {
        if (!checkerboard->color0.texture) check(checkerboard->color0.value, "color0");
        if (!checkerboard->color1.texture) check(checkerboard->color1.value, "color1");
    }
    auto const* constant = std::get_if<scene::ConstantTexture>(&texture);
    auto assign =
        Overloaded{[](Color const& c, Color& to) { to = c; },
                   [](Color const& c, float& to) { to = c == Color(c.r) ? c.r : average(c); }};
    if constexpr (std::is_same_v<T, Color> || std::is_same_v<T, float> ||
                  std::is_same_v<T, schema::Input<Color>> ||
                  std::is_same_v<T, schema::Input<float>>) {
        if (constant) {
            check(constant->value, "value");
            if constexpr (detail::is_input<T>)
                assign(constant->value, value.value);
            else
                assign(constant->value, value);
            return;
        }
    }
    if constexpr (detail::is_input<T>) {
        value.texture = id;
    } else {
        throw InputError(child.where,
                         title_of(name) +
                             " cannot vary: expected a value or a constant texture, found " +
                             element_title(element));
    }
}

template <class T>
T SceneBuilder::read_struct(XmlElement const& element) {
    static_assert(schema::all_described<T>, "describe() leaves out a member of this type");
    T object{};
    ObjectReader reader(*this, element);
    if constexpr (std::is_same_v<T, scene::SceneContents> || std::is_same_v<T, scene::ImageTest>)
        reader.allow_definitions();
    object.describe(reader);
    reader.finish(T::info.type);
    ElementReport const report(element);
    scene::settle(
        object, [&](std::string_view name) { return is_given(element, name); }, report);
    scene::check_object(object, facts_, report);
    load(object, element);
    return object;
}

template <class Variant>
Variant SceneBuilder::read_variant(XmlElement const& element) {
    std::vector<std::string> known;
    XmlAttribute const* type = element.find("type");
    Variant result;
    bool found = false;
    for_each_type<Variant>([&]<class T>() {
        known.emplace_back(T::info.type);
        if (found || !type || T::info.type != type->value) return;
        result = read_struct<T>(element);
        found = true;
    });
    if (found) return result;
    if (!type)
        throw InputError(element.where,
                         "<" + element.tag + "> expects type=\"...\"" + suggestion("", known));
    throw InputError(type->where, "unknown type " + in_quotes(type->value) + " of <" + element.tag +
                                      ">" + suggestion(type->value, known));
}

template <class Kind>
int32_t SceneBuilder::add(Kind, XmlElement const& e) {
    using Object =
        typename std::remove_reference_t<decltype(scene::objects<Kind>(scene_))>::value_type;
    auto const read = [&] {
        if constexpr (requires { Object::info; }) {
            if (!Object::info.type.empty()) expect_type(e, Object::info.type);
            return read_struct<Object>(e);
        } else {
            return read_variant<Object>(e);
        }
    };
    return scene::add(scene_, Kind{}, read(), e.where, std::string(e.get("id"))).index;
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
    if (depth_ >= kMaxNesting)
        throw InputError(element.where, "expected objects nested at most " +
                                            std::to_string(kMaxNesting) +
                                            " deep, found more by following references");
    document_.used.insert(&target);
    ++depth_;
    int32_t const index = add(Kind{}, target);
    --depth_;
    read_[{&target, Kind::category}] = index;
    return {index};
}

} // namespace weft::io
