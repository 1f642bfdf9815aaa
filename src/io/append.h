// Filling a scene's vectors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::io {

/// Appends and returns the index.
template <class T>
int32_t append(std::vector<T>& to, std::type_identity_t<T> value) {
    to.push_back(std::move(value));
    return int32_t(to.size()) - 1;
}

/// Where `shared` stands in `list`, appended where it is new.
template <class T>
int32_t index_of(std::vector<T>& list, T const& shared) {
    auto const it = std::find(list.begin(), list.end(), shared);
    return it != list.end() ? int32_t(it - list.begin()) : append(list, shared);
}

} // namespace weft::io
