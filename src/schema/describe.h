// One declaration per parameter.
//
// A type that users can write in a scene file is a plain aggregate with
//
//     static constexpr schema::TypeInfo info{.category = "camera", .type = "thinlens", ...};
//     template <class F> constexpr void describe(F&& f) {
//         f("fov", fov, {.unit = "deg", .min = 1, .max = 179, .help = "Full opening angle."});
//         f.group(film);  // the parameters of a member aggregate, as if they stood here
//     }
//
// Parsing, validation, defaults, writing, help, reference pages and JSON are all functors passed
// to `describe`. `all_described<T>` compares the number of described members with the number of
// members at compile time, so that none is forgotten.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "schema/alias.h"
#include "schema/values.h"

namespace weft::schema {

/// What a type is called in a file, and what it is for.
struct TypeInfo {
    std::string_view category; ///< the tag, "light"
    std::string_view type; ///< the value of the type attribute, "point"; "" where there is one type
    std::string_view help; ///< one or two sentences
    std::string_view example = {};            ///< a snippet of a scene file
    ValueType output = ValueType::none;       ///< what a node gives
    std::span<Spelling const> spellings = {}; ///< of other dialects, the first that applies first
};

/// What a parameter means beyond its name, type and default.
struct Attr {
    std::string_view unit = {}; ///< "deg", "W", "scene" (scene units), ...; "" = a plain number
    double min = -std::numeric_limits<double>::infinity();     ///< smaller values are errors
    double max = std::numeric_limits<double>::infinity();      ///< larger values are errors
    double soft_max = std::numeric_limits<double>::infinity(); ///< where a slider ends
    bool required = false;
    std::string_view help = {};
    Aliases aliases = {}; ///< what other dialects call it
};

namespace detail {

struct AnyMember {
    template <class T>
    constexpr operator T&() const;
};

template <class T, size_t... I>
constexpr bool initialisable_with(std::index_sequence<I...>) {
    return requires { T{(void(I), AnyMember{})...}; };
}

template <class T, size_t N = 40>
constexpr size_t member_count() {
    if constexpr (N == 0 || initialisable_with<T>(std::make_index_sequence<N>{})) {
        return N;
    } else {
        return member_count<T, N - 1>();
    }
}

struct Counter {
    size_t count = 0;
    template <class T>
    constexpr void operator()(std::string_view, T&, Attr) {
        ++count;
    }
    template <class T>
    constexpr void group(T&) {
        ++count;
    }
};

template <class T>
constexpr size_t described_count() {
    T object{};
    Counter counter;
    object.describe(counter);
    return counter.count;
}

} // namespace detail

/// Whether `describe` names every member of the aggregate T. (Compilers whose std::string is not
/// yet constexpr cannot know, and leave the check to the others.)
#if !defined(__clang__) || __clang_major__ >= 16
template <class T>
inline constexpr bool all_described = detail::member_count<T>() == detail::described_count<T>();
#else
template <class T>
inline constexpr bool all_described = true;
#endif

/// Passes the members of `object` to `f`, which only reads them.
template <class T, class F>
void read_members(T const& object, F&& f) {
    // `describe` is written once, for those that change members; const is theirs to keep.
    const_cast<T&>(object).describe(f);
}

/// An enumeration whose values 0, 1, ... have names: `choices(E)` is found by argument-dependent
/// lookup and returns an array of string views.
template <class E>
concept Choice = std::is_enum_v<E> && requires(E e) {
    choices(e);
};

/// A list of such values.
template <class L>
concept ChoiceList = Choice<typename L::value_type>;

} // namespace weft::schema
