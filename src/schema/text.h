// The text form of every parameter type: how it is written in a scene file and read back.
//
// Numbers are separated by commas, spaces or both; one number stands for all components of a
// colour or vector. Whether a text is understood is all that `read` tells: messages and locations
// are the reader's business.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/shared_text.h"
#include "schema/describe.h"

namespace weft::schema {

/// Shortest decimal that reads back as the same float ("0.1", "1e-06", "inf").
std::string number_text(float value);
std::string number_text(double value);

/// `text` with the characters escaped that an XML attribute cannot hold.
std::string xml_text(std::string_view text);

std::string numbers_text(std::span<float const> values);

/// The numbers in `text`, or nothing where something else stands there (NaN and infinity are
/// "something else": no parameter may have them).
std::optional<std::vector<double>> read_numbers(std::string_view text);

/// The words of a list, separated by commas, spaces or both; "" stands for what is missing between
/// two commas.
std::vector<std::string_view> split_words(std::string_view text);

/// Does what read_numbers does, for one number or, if `count` > 1, `count` of them.
std::optional<std::vector<double>> read_components(std::string_view text, int count);

/// kind: the type's name in documentation; expected: the phrase for error messages; write; and
/// read(text, value) -> whether the text was understood.
template <class T>
struct TextForm;

template <>
struct TextForm<bool> {
    static constexpr std::string_view kind = "boolean", expected = "true or false";
    static std::string write(bool v) { return v ? "true" : "false"; }
    static bool read(std::string_view text, bool& v) {
        bool const yes = text == "true" || text == "1" || text == "yes";
        if (!yes && text != "false" && text != "0" && text != "no") return false;
        v = yes;
        return true;
    }
};

template <>
struct TextForm<int> {
    static constexpr std::string_view kind = "integer", expected = "an integer";
    static std::string write(int v) { return std::to_string(v); }
    static bool read(std::string_view text, int& v);
};

template <>
struct TextForm<float> {
    static constexpr std::string_view kind = "float", expected = "a number";
    static std::string write(float v) { return number_text(v); }
    static bool read(std::string_view text, float& v);
};

template <>
struct TextForm<std::string> {
    static constexpr std::string_view kind = "string", expected = "a text";
    static std::string write(std::string const& v) { return v; }
    static bool read(std::string_view text, std::string& v) {
        v = text;
        return true;
    }
};

template <>
struct TextForm<SharedText> : TextForm<std::string> {
    static std::string write(SharedText const& v) { return v.str(); }
    static bool read(std::string_view text, SharedText& v) {
        v = SharedText(text);
        return true;
    }
};

template <>
struct TextForm<FileName> {
    static constexpr std::string_view kind = "file", expected = "a file name";
    static std::string write(FileName const& v) { return v.path; }
    static bool read(std::string_view text, FileName& v) {
        v.path = text;
        return !text.empty();
    }
};

template <>
struct TextForm<Color> {
    static constexpr std::string_view kind = "color",
                                      expected = "1 or 3 numbers (red, green, blue)";
    static std::string write(Color const& v);
    static bool read(std::string_view text, Color& v);
};

template <>
struct TextForm<Vec3> {
    static constexpr std::string_view kind = "vector", expected = "1 or 3 numbers (x, y, z)";
    static std::string write(Vec3 const& v);
    static bool read(std::string_view text, Vec3& v);
};

template <>
struct TextForm<Vec2> {
    static constexpr std::string_view kind = "vector2", expected = "1 or 2 numbers";
    static std::string write(Vec2 const& v);
    static bool read(std::string_view text, Vec2& v);
};

/// Transforms are written as their matrix; their other spellings are child tags.
template <>
struct TextForm<Affined> {
    static constexpr std::string_view kind = "transform";
    static constexpr std::string_view expected = "16 numbers, row by row, the last row 0,0,0,1";
    static std::string write(Affined const& v);
    static bool read(std::string_view text, Affined& v);
};

template <>
struct TextForm<AnyValue> {
    static constexpr std::string_view kind = "any", expected = "1, 2 or 3 numbers";
    static std::string write(AnyValue const& v);
    static bool read(std::string_view text, AnyValue& v);
};

template <>
struct TextForm<ColorStops> {
    static constexpr std::string_view kind = "color stops";
    static constexpr std::string_view expected =
        "'position: color; position: color; ...' with ascending positions";
    static std::string write(ColorStops const& v);
    static bool read(std::string_view text, ColorStops& v);
};

template <Choice E>
struct TextForm<E> {
    static constexpr std::string_view kind = "choice", expected = "one of the choices";
    static std::string write(E v) { return std::string(choices(v)[size_t(v)]); }
    static bool read(std::string_view text, E& v) {
        auto const names = choices(v);
        for (size_t i = 0; i < names.size(); ++i) {
            if (names[i] != text) continue;
            v = E(i);
            return true;
        }
        return false;
    }
};

/// Several of an enumeration's choices, separated by commas or spaces.
template <Choice E>
struct TextForm<std::vector<E>> {
    static constexpr std::string_view kind = "choices", expected = "any of the choices";
    static std::string write(std::vector<E> const& v) {
        std::string text;
        for (E e : v) text += (text.empty() ? "" : ",") + TextForm<E>::write(e);
        return text;
    }
    static bool read(std::string_view text, std::vector<E>& v) {
        std::vector<E> values;
        for (std::string_view const word : split_words(text))
            if (!TextForm<E>::read(word, values.emplace_back())) return false;
        v = std::move(values);
        return true;
    }
};

template <SurfaceDefault T>
struct TextForm<Input<T>> {
    static constexpr std::string_view kind = std::is_same_v<T, SurfaceUv> ? "vector2 texture"
                                                                          : "vector3 texture",
                                      expected = "a texture";
    static std::string category() { return "texture"; }
    static std::string write(Input<T> const&) { return ""; }
};

template <class T>
struct TextForm<Input<T>> {
    static constexpr std::string_view kind = std::is_same_v<T, float>   ? "float or texture"
                                             : std::is_same_v<T, Color> ? "color or texture"
                                             : std::is_same_v<T, Vec2>  ? "vector2 or texture"
                                             : std::is_same_v<T, Vec3>  ? "vector or texture"
                                                                        : "any value or texture";
    static constexpr std::string_view expected = TextForm<T>::expected;
    static std::string category() { return "texture"; }
    static std::string write(Input<T> const& v) { return TextForm<T>::write(v.value); }
    static bool read(std::string_view text, Input<T>& v) {
        return TextForm<T>::read(text, v.value);
    }
};

template <class Kind>
struct TextForm<Id<Kind>> {
    static constexpr std::string_view kind = "object", expected = "an object";
    static std::string category() { return Kind::category; }
    static std::string write(Id<Kind> const&) { return ""; }
};

template <class Kind>
struct TextForm<std::vector<Id<Kind>>> {
    static constexpr std::string_view kind = "list", expected = "objects";
    static std::string category() { return Kind::category; }
    static std::string write(std::vector<Id<Kind>> const&) { return ""; }
};

namespace detail {

struct TextCollector {
    std::vector<std::pair<std::string, std::string>>& texts; ///< name, value

    template <class T>
    void operator()(std::string_view name, T& value, Attr const&) {
        texts.emplace_back(name, TextForm<T>::write(value));
    }
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }
};

} // namespace detail

/// The parameters of an object that differ from their defaults, as ` name="value"` attributes
/// (objects and lists are left out: they are child tags).
template <class T>
std::string write_attributes(T object) {
    std::vector<std::pair<std::string, std::string>> defaults, values;
    T fresh{};
    fresh.describe(detail::TextCollector{defaults});
    object.describe(detail::TextCollector{values});
    std::string text;
    for (size_t i = 0; i < values.size(); ++i)
        if (values[i] != defaults[i])
            text += " " + values[i].first + "=\"" + xml_text(values[i].second) + "\"";
    return text;
}

} // namespace weft::schema
