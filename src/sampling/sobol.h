// The first three dimensions of the Sobol' sequence, with the direction numbers of Joe and Kuo
// 2008, "Constructing Sobol' sequences with better two-dimensional projections".
//
// Dimensions 0 and 1 form a (0, 2)-sequence: any 2^m aligned samples put exactly one into every
// elementary interval of area 2^-m. All three form a (1, 3)-sequence. More dimensions are left
// out on purpose: paths pad with independently shuffled copies of these (see stream.h), which
// keeps low sample counts free of the patterns of high Sobol' dimensions.
//
// Digits come reversed (most significant in bit 0), as owen.h wants them: digit k is then the
// parity of some of the bits of the index, and dimension 0 is the index itself.
#pragma once

#include <array>
#include <cstdint>

#include "sampling/owen.h"

namespace weft::sampling {

/// Dimension 1. Its matrix is Pascal's triangle mod 2, in which C(j, k) is odd where the bits of
/// k are among those of j (Lucas): a sum over supersets, which five butterfly steps compute.
constexpr uint32_t sobol_reversed_1(uint32_t index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= index >> 16;
    return index;
}

/// The contribution of each byte of the index to dimension 2.
using SobolTable = std::array<std::array<uint32_t, 256>, 4>;

/// Dimension 2: primitive polynomial x^2 + x + 1, m = 1, 3, hence
/// v_k = v_{k-1} ^ v_{k-2} ^ (v_{k-2} >> 2) for the direction numbers v_k = m_k 2^(32-k).
constexpr SobolTable make_sobol_table_2() {
    std::array<uint32_t, 32> v{0x80000000u, 0xc0000000u};
    for (size_t k = 2; k < 32; ++k) v[k] = v[k - 1] ^ v[k - 2] ^ (v[k - 2] >> 2);
    SobolTable table{};
    for (size_t byte = 0; byte < 4; ++byte) {
        for (uint32_t value = 1; value < 256; ++value) {
            uint32_t low = 0; // the lowest set bit of `value`
            while ((value >> low & 1) == 0) ++low;
            table[byte][value] = table[byte][value & (value - 1)] ^ reverse_bits(v[8 * byte + low]);
        }
    }
    return table;
}

inline constexpr SobolTable kSobolTable2 = make_sobol_table_2();

constexpr uint32_t sobol_reversed_2(uint32_t index) {
    return kSobolTable2[0][index & 255] ^ kSobolTable2[1][index >> 8 & 255] ^
           kSobolTable2[2][index >> 16 & 255] ^ kSobolTable2[3][index >> 24];
}

} // namespace weft::sampling
