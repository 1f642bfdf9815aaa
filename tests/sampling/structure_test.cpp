// What the point sets are: nets, scrambles, permutations.
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <vector>

#include "sampling/stream.h"
#include "tests/support/statistics.h"

namespace weft::sampling {
namespace {

constexpr double kSignificance = 0.01;

/// Digit k (most significant first) of Sobol' dimension `d` by the textbook: Joe and Kuo's
/// recurrence for m_k, one bit of the index at a time.
uint32_t textbook_sobol(uint32_t d, uint32_t index) {
    std::vector<uint64_t> m(33);
    for (size_t k = 1; k <= 32; ++k) {
        if (d == 0) m[k] = 1;
        if (d == 1) m[k] = k == 1 ? 1 : 2 * m[k - 1] ^ m[k - 1]; // x + 1
        if (d == 2) m[k] = k == 1 ? 1 : k == 2 ? 3 : 2 * m[k - 1] ^ 4 * m[k - 2] ^ m[k - 2];
    }
    uint32_t x = 0;
    for (size_t k = 1; k <= 32; ++k)
        if (index >> (k - 1) & 1) x ^= uint32_t(m[k] << (32 - k));
    return x;
}

TEST(Sobol, AgreesWithTheTextbookRecurrence) {
    Rng rng(1);
    for (int i = 0; i < 2000; ++i) {
        uint32_t const index = i < 1000 ? uint32_t(i) : rng.next_uint();
        ASSERT_EQ(reverse_bits(index), textbook_sobol(0, index));
        ASSERT_EQ(reverse_bits(sobol_reversed_1(index)), textbook_sobol(1, index)) << index;
        ASSERT_EQ(reverse_bits(sobol_reversed_2(index)), textbook_sobol(2, index)) << index;
    }
}

TEST(Owen, FourWordsAreAsEach) {
    Rng rng(2);
    for (int i = 0; i < 1000; ++i) {
        Words4 const words{rng.next_uint(), rng.next_uint(), rng.next_uint(), rng.next_uint()};
        Words4 const seeds{rng.next_uint(), rng.next_uint(), rng.next_uint(), rng.next_uint()};
        Words4 const reversed = reverse_bits(words),
                     scrambled = owen_scramble_reversed(words, seeds);
        for (int k = 0; k < 4; ++k) {
            uint32_t const word = words[k], seed = seeds[k];
            ASSERT_EQ(reversed[k], reverse_bits(word));
            ASSERT_EQ(scrambled[k], owen_scramble_reversed(word, seed));
            ASSERT_EQ(reverse_bits(reverse_bits(word)), word);
            ASSERT_EQ(reverse_bits(word) & 1, word >> 31);
        }
    }
}

TEST(Owen, ADigitDependsOnItselfAndThoseBeforeItAlone) {
    Rng rng(3);
    for (int i = 0; i < 10000; ++i) {
        uint32_t const seed = rng.next_uint(), x = rng.next_uint();
        uint32_t const bit = rng.next_uint() % 32, later = rng.next_uint() << bit << 1;
        uint32_t const mask = bit == 31 ? ~0u : (2u << bit) - 1;
        uint32_t const a = owen_scramble_reversed(x, seed);
        ASSERT_EQ(a & mask, owen_scramble_reversed(x ^ (bit == 31 ? 0 : later), seed) & mask);
        ASSERT_EQ((a ^ owen_scramble_reversed(x ^ 1u << bit, seed)) & mask, 1u << bit);
    }
}

/// Each node of the digit tree flips its digit for half of the seeds. Two-sided z-tests of all
/// nodes down to depth 6.
TEST(Owen, EveryNodeFlipsForHalfOfTheSeeds) {
    constexpr int kSeeds = 20000, kDepth = 6, kNodes = (1 << (kDepth + 1)) - 1;
    std::vector<int> flips(kNodes);
    for (int s = 0; s < kSeeds; ++s) {
        uint32_t const seed = hash32(uint32_t(s) + 17);
        for (uint32_t depth = 0; depth <= kDepth; ++depth)
            for (uint32_t node = 0; node < 1u << depth; ++node)
                flips[(1u << depth) - 1 + node] +=
                    int(owen_scramble_reversed(node, seed) >> depth & 1);
    }
    double const level = testing::sidak(kSignificance, kNodes);
    for (size_t i = 0; i < flips.size(); ++i) {
        double const z = (flips[i] - kSeeds / 2.0) / std::sqrt(kSeeds / 4.0);
        EXPECT_GT(testing::normal_tail(z), level) << "node " << i << " z " << z;
    }
}

struct Place {
    Vec2i pixel;
    uint32_t seed;
    Dimension dimension;
    uint32_t vertex;
};

constexpr Dimension kAll[] = {Dimension::Film,     Dimension::Lens,     Dimension::Time,
                              Dimension::Emission, Dimension::Bsdf,     Dimension::Light,
                              Dimension::Roulette, Dimension::Distance, Dimension::Phase,
                              Dimension::Alpha};

/// Streams here and there, negative pixels included.
std::vector<Place> places(uint32_t least_components) {
    std::vector<Place> list;
    Rng rng(4);
    for (Dimension d : kAll) {
        if (components(d) < least_components) continue;
        for (int i = 0; i < 6; ++i) {
            Vec2i const pixel(int(rng.next_uint() % 8000) - 100, int(rng.next_uint() % 8000) - 100);
            list.push_back({pixel, rng.next_uint(), d, rng.next_uint() % 20});
        }
    }
    return list;
}

/// How many points fall into each elementary interval whose sides are base^-k[i].
template <class P>
std::vector<int> counts(std::vector<P> const& points, std::vector<uint32_t> const& cells) {
    size_t total = 1;
    for (uint32_t c : cells) total *= c;
    std::vector<int> count(total);
    for (P const& p : points) {
        size_t cell = 0;
        for (size_t i = 0; i < cells.size(); ++i)
            cell = cell * cells[i] + size_t(p[int(i)] * float(cells[i]));
        ++count[cell];
    }
    return count;
}

template <class P>
void expect_in_each(int n, std::vector<P> const& points, std::vector<uint32_t> const& cells) {
    for (int c : counts(points, cells)) ASSERT_EQ(c, n) << points.size() << " points";
}

std::vector<Vec3> samples(SamplerKind kind, Place const& p, uint32_t first, uint32_t n) {
    std::vector<Vec3> points;
    for (uint32_t i = first; i < first + n; ++i) {
        SampleStream const s(kind, p.pixel, i, p.seed);
        switch (components(p.dimension)) {
        case 1:
            points.emplace_back(s.get1(p.dimension, p.vertex), 0.f, 0.f);
            break;
        case 2: {
            Vec2 const v = s.get2(p.dimension, p.vertex);
            points.emplace_back(v.x, v.y, 0.f);
            break;
        }
        default:
            points.push_back(s.get3(p.dimension, p.vertex));
        }
    }
    return points;
}

/// The first block of samples and one further on: nets in sequence.
constexpr uint32_t kBlocks[] = {0, 5};

TEST(SobolStream, OneComponentIsStratified) {
    for (Place const& p : places(1))
        for (uint32_t m = 0; m <= 10; ++m)
            for (uint32_t block : kBlocks)
                expect_in_each(1, samples(SamplerKind::Sobol, p, block << m, 1u << m), {1u << m});
}

TEST(SobolStream, TwoComponentsAreNets) {
    for (Place const& p : places(2))
        for (uint32_t m = 0; m <= 10; ++m)
            for (uint32_t block : kBlocks) {
                auto const points = samples(SamplerKind::Sobol, p, block << m, 1u << m);
                for (uint32_t a = 0; a <= m; ++a)
                    expect_in_each(1, points, {1u << a, 1u << (m - a)});
            }
}

/// Dimensions 0, 1, 2 are a (1, 3)-sequence: 2^m points put 2 into every interval of volume
/// 2^(1 - m); pairs with the third component are no worse; each component alone is stratified.
TEST(SobolStream, ThreeComponentsAreNets) {
    for (Place const& p : places(3))
        for (uint32_t m = 1; m <= 10; ++m)
            for (uint32_t block : kBlocks) {
                auto const points = samples(SamplerKind::Sobol, p, block << m, 1u << m);
                for (uint32_t a = 0; a < m; ++a)
                    for (uint32_t b = 0; a + b < m; ++b)
                        expect_in_each(2, points, {1u << a, 1u << b, 1u << (m - 1 - a - b)});
                expect_in_each(1, points, {1, 1, 1u << m});
                expect_in_each(1, points, {1, 1u << m, 1});
            }
}

/// One component, and cells of b1^i x b2^j for b1^i b2^j samples, in bases 2, 3 and 5, 7.
TEST(HaltonStream, ComponentsAreStratifiedInTheirBases) {
    for (int i = 0; i < 6; ++i) {
        Place p{{3 * i, 7}, uint32_t(i), Dimension::Film, 0};
        expect_in_each(1, samples(SamplerKind::Halton, p, 0, 256), {256});
        expect_in_each(1, samples(SamplerKind::Halton, p, 0, 8 * 27), {8, 27});
        expect_in_each(1, samples(SamplerKind::Halton, p, 4 * 81, 4 * 81), {4, 81});
        p.dimension = Dimension::Lens;
        expect_in_each(1, samples(SamplerKind::Halton, p, 0, 25 * 7), {25, 7});
        expect_in_each(1, samples(SamplerKind::Halton, p, 0, 343), {1, 343});
        p.dimension = Dimension::Time;
        expect_in_each(1, samples(SamplerKind::Halton, p, 0, 121), {121});
    }
}

TEST(HaltonStream, BasesOfOnePathAreDistinct) {
    std::set<uint32_t> used;
    for (Dimension d : kAll) {
        if (d == Dimension::Emission) continue; // stands in for Film on paths from lights
        bool const per_path = uint32_t(d) < uint32_t(Dimension::Emission);
        for (uint32_t vertex = 0; vertex < (per_path ? 1u : 8u); ++vertex)
            for (uint32_t i = 0; i < components(d); ++i)
                EXPECT_TRUE(used.insert(halton_base(d, vertex) + i).second);
    }
    EXPECT_EQ(kPrimes.back(), 311u);
}

/// The scramble of a radical inverse is uniform over seeds for one index, and pairs of different
/// digits are as likely one as another (which is all that Owen's variance needs).
TEST(HaltonStream, DigitPairsAreUniform) {
    constexpr int kSeeds = 40000;
    constexpr uint32_t kBases[] = {2, 3, 5, 11};
    double const level = testing::sidak(kSignificance, std::size(kBases));
    for (uint32_t base : kBases) {
        std::vector<double> observed(base * base), expected(base * base);
        for (size_t i = 0; i < expected.size(); ++i)
            expected[i] = i / base == i % base ? 0 : double(kSeeds) / (base * (base - 1));
        for (int s = 0; s < kSeeds; ++s) {
            auto digit = [&](uint32_t index) {
                return size_t(scrambled_radical_inverse(base, index, hash64(uint64_t(s))) *
                              float(base));
            };
            observed[digit(base - 1) * base + digit(base)] += 1;
        }
        testing::ChiSquare const test = testing::chi_square(observed, expected);
        EXPECT_GT(test.p_value, level) << base << " " << test.problem;
    }
}

/// Nested scrambling: below two different first digits, the second ones are permuted
/// independently, so that any pair of them is equally likely.
TEST(HaltonStream, DigitsBelowDifferentDigitsAreIndependent) {
    constexpr int kSeeds = 40000;
    constexpr uint32_t kBases[] = {2, 3, 5, 11};
    double const level = testing::sidak(kSignificance, std::size(kBases));
    for (uint32_t base : kBases) {
        std::vector<double> observed(base * base), expected(base * base);
        for (double& e : expected) e = double(kSeeds) / (base * base);
        for (int s = 0; s < kSeeds; ++s) {
            auto second = [&](uint32_t index) {
                float const x = scrambled_radical_inverse(base, index, hash64(uint64_t(s)));
                return size_t(x * float(base * base)) % base;
            };
            observed[second(0) * base + second(1)] += 1;
        }
        EXPECT_GT(testing::chi_square(observed, expected).p_value, level) << base;
    }
}

} // namespace
} // namespace weft::sampling
