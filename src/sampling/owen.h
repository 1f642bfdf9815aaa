// Owen's nested uniform scrambling in base 2, by hashing.
//
// Owen 1995 permutes the k-th digit of a coordinate by a coin that depends on the digits before
// it. Laine and Karras 2011, "Stratified sampling for stochastic transparency", noticed that a
// hash which moves information only from low bits to high ones does that to a number whose
// digits are stored lowest bit first. Burley 2020, "Practical hash-based Owen scrambling",
// uses it both for coordinates and to shuffle the order of the samples; the constants are
// N. Vegdahl's ("Building a better LK hash", 2021).
//
// "Reversed" below means: bit 0 holds the most significant digit of the fraction.
#pragma once

#include <cstdint>

namespace weft::sampling {

/// Four words side by side.
using Words4 [[gnu::vector_size(16)]] = uint32_t;

constexpr uint32_t reverse_bits(uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

/// The same for each of four words.
inline Words4 reverse_bits(Words4 x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    using Bytes [[gnu::vector_size(16)]] = uint8_t;
    return Words4(__builtin_shufflevector(Bytes(x), Bytes(x), 3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8,
                                          15, 14, 13, 12));
}

/// Scrambles reversed digits: bit k of the result depends on bits 0 .. k of `x` alone, and for
/// fixed lower bits it is bit k of `x` or its complement. `Word`: uint32_t or Words4.
template <class Word>
constexpr Word owen_scramble_reversed(Word x, Word seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

} // namespace weft::sampling
