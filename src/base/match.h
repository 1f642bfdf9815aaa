// Visiting closed sets. `match` compiles to a switch with inlined arms, where std::visit goes
// through a table of function pointers that the optimiser cannot see into.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace weft {

/// Calls `f` with the alternative that `v` holds; all arms must return one type.
template <class Variant, class F, std::size_t I = 0>
[[gnu::always_inline]] inline decltype(auto) match(Variant&& v, F&& f) {
    constexpr std::size_t n = std::variant_size_v<std::remove_cvref_t<Variant>>;
    if constexpr (I + 1 == n) {
        return f(*std::get_if<I>(&v));
    } else {
        if (v.index() == I) return f(*std::get_if<I>(&v));
        return match<Variant, F, I + 1>(std::forward<Variant>(v), std::forward<F>(f));
    }
}

/// A visitor out of lambdas: match(v, Overloaded{[](A const&) ..., [](auto const&) ...}).
template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

/// A list of types to write templates over: for_each_type<Variant>([]<class T>() {...}).
template <class Variant, class F>
constexpr void for_each_type(F&& f) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        (f.template operator()<std::variant_alternative_t<I, Variant>>(), ...);
    }
    (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

} // namespace weft
