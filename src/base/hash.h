// Integer hashes and the numbers made from them. Everything random in Weft is a hash of what it
// is for (pixel, sample, dimension, seed), never of when or by whom it was asked.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

#include "base/vec.h"

namespace weft {

/// A bijection of 32 bits with low bias: C. Wellons' `lowbias32`.
constexpr uint32_t hash32(uint32_t x) {
    x ^= x >> 16;
    x *= 0x21f0aaadu;
    x ^= x >> 15;
    x *= 0xd35a2d97u;
    x ^= x >> 15;
    return x;
}

constexpr uint32_t hash_combine(uint32_t a, uint32_t b) {
    return hash32(a ^ (hash32(b) + 0x9e3779b9u + (a << 6) + (a >> 2)));
}

/// The finaliser of SplitMix64 (Steele et al. 2014): a bijection of 64 bits.
constexpr uint64_t hash64(uint64_t x) {
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// 64-bit FNV-1a, for names and file contents; not for secrets.
constexpr uint64_t hash_bytes(std::string_view bytes, uint64_t h = 0xcbf29ce484222325ull) {
    for (char c : bytes) h = (h ^ uint8_t(c)) * 0x100000001b3ull;
    return h;
}

/// The top 24 bits as a float in [0, 1).
constexpr float to_unit_float(uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }

/// A small sequential generator (SplitMix64 on a counter) for code that is not about
/// pixels: tests, table building. Equal seeds give equal sequences.
class Rng {
  public:
    explicit constexpr Rng(uint64_t seed = 0) : state_(hash64(seed)) {}
    constexpr uint32_t next_uint() { return uint32_t(hash64(state_++) >> 32); }
    constexpr float next() { return to_unit_float(next_uint()); } ///< in [0, 1)
    constexpr Vec2 next2() {
        float const x = next();
        return {x, next()};
    }
    constexpr Vec3 next3() {
        float const x = next(), y = next();
        return {x, y, next()};
    }

  private:
    uint64_t state_;
};

} // namespace weft
