// Scrambled radical inverses in the first 64 prime bases (Halton 1960), scrambled as Owen 1995
// does: each digit is permuted in a way that depends on all digits before it.
//
// The permutation of a digit d in base b is d -> (a d + c) mod b with hashed a != 0 and c. Over
// a prime field these maps send any two different digits to every pair of different digits
// equally often, and the variance of an Owen scrambled point set depends on pairs of points
// alone: full random permutations would cost more and gain nothing.
#pragma once

#include <array>
#include <cstdint>

namespace weft::sampling {

inline constexpr uint32_t kHaltonBases = 64;

/// Digits are permuted until the cells they tell apart number at least this; the rest of the
/// fraction is a plain hash. Stratification thus holds for that many samples.
inline constexpr uint32_t kHaltonCells = 1u << 20;

/// The primes from 2 to 311.
constexpr std::array<uint32_t, kHaltonBases> make_primes() {
    std::array<uint32_t, kHaltonBases> primes{};
    uint32_t count = 0;
    for (uint32_t n = 2; count < kHaltonBases; ++n) {
        bool prime = true;
        for (uint32_t i = 0; i < count; ++i) prime = prime && n % primes[i] != 0;
        if (prime) primes[count++] = n;
    }
    return primes;
}
inline constexpr std::array<uint32_t, kHaltonBases> kPrimes = make_primes();

/// The radical inverse of `index` in prime base `base`, scrambled by `seed`; in [0, 1).
float scrambled_radical_inverse(uint32_t base, uint32_t index, uint64_t seed);

} // namespace weft::sampling
