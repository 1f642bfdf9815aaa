#include "sampling/halton.h"

#include <algorithm>

#include "base/hash.h"

namespace weft::sampling {

float scrambled_radical_inverse(uint32_t base, uint32_t index, uint64_t seed) {
    uint32_t value = 0, cells = 1;
    uint64_t node = seed; // names the branch of the digit tree: the seed and the digits so far
    while (cells < kHaltonCells) {
        uint32_t const rest = index / base, digit = index - rest * base;
        uint64_t const h = hash64(node);
        uint32_t const scale = 1 + uint32_t((h & 0xffffffffu) * (base - 1) >> 32);
        uint32_t const shift = uint32_t((h >> 32) * base >> 32);
        value = value * base + (digit * scale + shift) % base;
        cells *= base;
        index = rest;
        node = h + digit;
    }
    float const within = to_unit_float(uint32_t(hash64(node ^ (uint64_t(index) << 32)) >> 32));
    double const x = (double(value) + double(within)) / double(cells);
    return std::min(float(x), kOneMinusEpsilon);
}

} // namespace weft::sampling
