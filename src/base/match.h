// Visiting closed sets. `match` is a switch over the index of the alternative, with inlined arms:
// one jump through a table where there are many. std::visit calls through function pointers that
// the optimiser cannot see into, and a chain of ifs asks for one alternative after the other.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace weft {

/// Calls `f` with the alternative that `v` holds; all arms must return one type. `v` must not be
/// valueless. One switch tells 64 alternatives from `First` on; a larger set takes several.
template <class Variant, class F, std::size_t First = 0>
[[gnu::always_inline]] inline decltype(auto) match(Variant&& v, F&& f) {
    constexpr std::size_t n = std::variant_size_v<std::remove_cvref_t<Variant>>;
    constexpr std::size_t arms = 64;
    // A pack cannot be expanded into case labels, so they are written out.
    switch (v.index() - First) {
#define WEFT_ARM(I)                                                                                \
    case I:                                                                                        \
        if constexpr (First + (I) < n)                                                             \
            return f(*std::get_if<First + (I)>(&v));                                               \
        else                                                                                       \
            break;
#define WEFT_4_ARMS(I) WEFT_ARM(I) WEFT_ARM((I) + 1) WEFT_ARM((I) + 2) WEFT_ARM((I) + 3)
#define WEFT_16_ARMS(I)                                                                            \
    WEFT_4_ARMS(I) WEFT_4_ARMS((I) + 4) WEFT_4_ARMS((I) + 8) WEFT_4_ARMS((I) + 12)
        WEFT_16_ARMS(0)
        WEFT_16_ARMS(16)
        WEFT_16_ARMS(32)
        WEFT_16_ARMS(48)
#undef WEFT_16_ARMS
#undef WEFT_4_ARMS
#undef WEFT_ARM
    }
    if constexpr (First + arms < n)
        return match<Variant, F, First + arms>(std::forward<Variant>(v), std::forward<F>(f));
    else
        __builtin_unreachable();
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
