// Sample streams: the random numbers of one path, each a pure function of (pixel, sample index,
// named dimension, vertex, seed). Nothing is consumed: asking twice, in any order, or not at all
// gives the same numbers, so adding a feature that asks for one more moves no other.
//
// A named dimension has one to three components that are stratified together over the samples of
// a pixel. Different names, vertices, pixels and seeds are statistically independent.
//
// Sobol: each (dimension, vertex, pixel, seed) has its own Owen-scrambled Sobol' points in its
//   own shuffled order (Burley 2020; see owen.h, sobol.h): padding by shuffled copies of the
//   best dimensions. Any 2^m consecutive samples that begin at a multiple of 2^m are a net.
// Halton: each component has its own prime base while the 64 bases last (camera dimensions and
//   the first four vertices), and a plain hash from there on; see halton.h.
// Independent: a hash of all the arguments.
//
// Left out on purpose: error diffusion over the screen (blue noise), which a denoiser undoes.
#pragma once

#include <cassert>
#include <cstdint>

#include "base/hash.h"
#include "base/vec.h"
#include "sampling/halton.h"
#include "sampling/owen.h"
#include "sampling/sobol.h"

namespace weft::sampling {

enum class SamplerKind : uint32_t { Sobol, Halton, Independent };

/// What a random number is for. The first two components are the best stratified pair: they
/// take the position or direction, and the third takes the discrete choice.
enum class Dimension : uint32_t {
    // Once per path (vertex 0).
    Film,     ///< 2: position under the pixel filter
    Lens,     ///< 2: position on the aperture
    Time,     ///< 1: moment within the shutter interval
    Emission, ///< 2: direction in which a path from a light starts
    // At every vertex.
    Bsdf,     ///< 3: direction (2), choice of lobe
    Light,    ///< 3: point on the light (2), choice of light
    Roulette, ///< 1: survival
    Distance, ///< 2: free flight distance, choice of colour channel
    Phase,    ///< 2: direction of a scattering event in a medium
    Alpha,    ///< 1: stochastic opacity
};

/// How many components `d` has.
constexpr uint32_t components(Dimension d) {
    switch (d) {
    case Dimension::Bsdf:
    case Dimension::Light:
        return 3;
    case Dimension::Film:
    case Dimension::Lens:
    case Dimension::Emission:
    case Dimension::Distance:
    case Dimension::Phase:
        return 2;
    case Dimension::Time:
    case Dimension::Roulette:
    case Dimension::Alpha:
        return 1;
    }
    return 0;
}

/// The index among the Halton bases of the first component of `d` at `vertex`: camera dimensions
/// first (paths from lights have no film position, so Emission shares its bases), then for each
/// vertex BSDF and light before the rest. May exceed `kHaltonBases`.
constexpr uint32_t halton_base(Dimension d, uint32_t vertex) {
    uint32_t const first = 5 + 12 * std::min(vertex, kHaltonBases);
    switch (d) {
    case Dimension::Film:
    case Dimension::Emission:
        return 0;
    case Dimension::Lens:
        return 2;
    case Dimension::Time:
        return 4;
    case Dimension::Bsdf:
        return first;
    case Dimension::Light:
        return first + 3;
    case Dimension::Roulette:
        return first + 6;
    case Dimension::Distance:
        return first + 7;
    case Dimension::Phase:
        return first + 9;
    case Dimension::Alpha:
        return first + 11;
    }
    return kHaltonBases;
}

/// The random numbers of sample number `sample` of `pixel`: 24 bytes to copy at will. `vertex`
/// is the number of the path vertex, 0 for the camera's (or the light's, going forward). All
/// numbers lie in [0, kOneMinusEpsilon]. Asking for more components than `d` has is an error.
class SampleStream {
  public:
    SampleStream(SamplerKind kind, Vec2i pixel, uint32_t sample, uint32_t seed)
        : key_(hash64(hash64(uint64_t(uint32_t(pixel.x)) << 32 | uint32_t(pixel.y)) + seed)),
          sample_(sample), reversed_sample_(reverse_bits(sample)), kind_(kind) {}

    float get1(Dimension d, uint32_t vertex = 0) const {
        uint64_t const h = key(d, vertex);
        if (kind_ != SamplerKind::Sobol) return other(d, vertex, 0, h);
        uint32_t const index = shuffled_index(h);
        return to_unit_float(reverse_bits(owen_scramble_reversed(index, uint32_t(h >> 32))));
    }

    Vec2 get2(Dimension d, uint32_t vertex = 0) const {
        assert(components(d) >= 2);
        uint64_t const h = key(d, vertex);
        if (kind_ != SamplerKind::Sobol) return {other(d, vertex, 0, h), other(d, vertex, 1, h)};
        return sobol2(shuffled_index(h), h);
    }

    Vec3 get3(Dimension d, uint32_t vertex = 0) const {
        assert(components(d) >= 3);
        uint64_t const h = key(d, vertex);
        if (kind_ != SamplerKind::Sobol)
            return {other(d, vertex, 0, h), other(d, vertex, 1, h), other(d, vertex, 2, h)};
        return sobol3(shuffled_index(h), h);
    }

    /// A sequential generator for the loops whose length is not known beforehand (tracking
    /// through a heterogeneous medium, a walk below the surface).
    Rng walk(Dimension d, uint32_t vertex = 0) const {
        return Rng(hash64(key(d, vertex) ^ (uint64_t(sample_) << 32 | 0xffffu)));
    }

  private:
    uint64_t key(Dimension d, uint32_t vertex) const {
        return hash64(key_ ^ (uint64_t(vertex) << 32 | uint32_t(d)));
    }

    uint32_t shuffled_index(uint64_t h) const {
        return reverse_bits(owen_scramble_reversed(reversed_sample_, uint32_t(h)));
    }

    static Vec2 sobol2(uint32_t index, uint64_t h) {
        Vec3 const p = scrambled(Words4{index, sobol_reversed_1(index)}, h);
        return {p.x, p.y};
    }
    static Vec3 sobol3(uint32_t index, uint64_t h) {
        return scrambled(Words4{index, sobol_reversed_1(index), sobol_reversed_2(index)}, h);
    }
    /// Scrambles each of the first three words by its own part of `h` and makes numbers of them.
    static Vec3 scrambled(Words4 digits, uint64_t h) {
        uint64_t const g = hash64(h);
        Words4 const seeds{uint32_t(h >> 32), uint32_t(g), uint32_t(g >> 32)};
        digits = reverse_bits(owen_scramble_reversed(digits, seeds));
        return {to_unit_float(digits[0]), to_unit_float(digits[1]), to_unit_float(digits[2])};
    }

    /// Component number `i` of the Halton and independent streams.
    float other(Dimension d, uint32_t vertex, uint32_t i, uint64_t h) const {
        uint64_t const seed = hash64(h + i);
        uint32_t const base = halton_base(d, vertex) + i;
        if (kind_ == SamplerKind::Halton && base < kHaltonBases)
            return scrambled_radical_inverse(kPrimes[base], sample_, seed);
        return to_unit_float(uint32_t(hash64(seed ^ (uint64_t(sample_) << 32)) >> 32));
    }

    uint64_t key_; ///< pixel and seed
    uint32_t sample_, reversed_sample_;
    SamplerKind kind_;
};

} // namespace weft::sampling
