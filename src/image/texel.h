// Texels as files hold them, and as linear numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <Imath/half.h>

#include "base/color.h"

namespace weft::image {

/// How the integers of a file encode linear numbers.
enum class Transfer : uint8_t { linear, gamma22, srgb };

/// The linear number that `x` encodes; negative ones are 0 under gamma22.
inline float decoded(Transfer transfer, float x) {
    switch (transfer) {
    case Transfer::gamma22:
        return std::pow(std::max(x, 0.f), 2.2f);
    case Transfer::srgb:
        return srgb_to_linear(x);
    case Transfer::linear:
        break;
    }
    return x;
}

/// Which channels of a file a texture holds: the first three (or the first of fewer), or the
/// opacity, which is linear.
enum class Channels : uint8_t { color, alpha };

enum class TexelType : uint8_t { u8, u16, f16, f32 };

constexpr size_t size_of(TexelType type) {
    return type == TexelType::u8 ? 1 : type == TexelType::f32 ? 4 : 2;
}

/// Red, green, blue, and one value without a meaning: what one instruction works on.
using Texel = float __attribute__((vector_size(16)));

struct TexelFormat {
    TexelType type = TexelType::f32;
    int channels = 3; ///< 1 (grey) or 3
    Transfer transfer = Transfer::linear;

    constexpr size_t bytes() const { return size_t(channels) * size_of(type); } ///< of a texel
    friend bool operator==(TexelFormat const&, TexelFormat const&) = default;
};

/// The linear number of each code, as a whole file would be converted; empty for floats.
/// Shared by all textures of the format.
std::span<float const> decode_table(TexelFormat format);

/// The linear numbers of the texel at `p`: a float where there is one channel. `table` as from
/// `decode_table`.
template <TexelType type, int channels>
inline auto load_texel(std::byte const* p, float const* table) {
    auto component = [&](int i) -> float {
        if constexpr (type == TexelType::u8)
            return table[reinterpret_cast<uint8_t const*>(p)[i]];
        else if constexpr (type == TexelType::u16)
            return table[reinterpret_cast<uint16_t const*>(p)[i]];
        else if constexpr (type == TexelType::f16)
            return imath_half_to_float(reinterpret_cast<uint16_t const*>(p)[i]);
        else
            return reinterpret_cast<float const*>(p)[i];
    };
    if constexpr (channels == 1)
        return component(0);
    else
        return Texel{component(0), component(1), component(2), 0};
}

/// Calls f.operator()<type, channels>() for a format.
template <class F>
inline decltype(auto) match_format(TexelFormat const& format, F const& f) {
    bool const grey = format.channels == 1;
    switch (format.type) {
    case TexelType::u8:
        return grey ? f.template operator()<TexelType::u8, 1>()
                    : f.template operator()<TexelType::u8, 3>();
    case TexelType::u16:
        return grey ? f.template operator()<TexelType::u16, 1>()
                    : f.template operator()<TexelType::u16, 3>();
    case TexelType::f16:
        return grey ? f.template operator()<TexelType::f16, 1>()
                    : f.template operator()<TexelType::f16, 3>();
    case TexelType::f32:
        break;
    }
    return grey ? f.template operator()<TexelType::f32, 1>()
                : f.template operator()<TexelType::f32, 3>();
}

} // namespace weft::image
