// Numbers are functions of their names, lie in range, and are independent across names.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sampling/stream.h"
#include "tests/support/statistics.h"

namespace weft::sampling {
namespace {

constexpr double kSignificance = 0.01;
constexpr SamplerKind kKinds[] = {SamplerKind::Sobol, SamplerKind::Halton,
                                  SamplerKind::Independent};

TEST(SampleStream, SameArgumentsSameBitsInAnyOrder) {
    for (SamplerKind kind : kKinds)
        for (uint32_t i = 0; i < 500; ++i) {
            SampleStream const a(kind, {int(i % 17), 4}, i, 9);
            Vec3 const light = a.get3(Dimension::Light, 2);
            Vec2 const lens = a.get2(Dimension::Lens);
            float const roulette = a.get1(Dimension::Roulette, 5);
            SampleStream const b(kind, {int(i % 17), 4}, i, 9), copy = b;
            EXPECT_EQ(b.get1(Dimension::Roulette, 5), roulette);
            EXPECT_EQ(b.get2(Dimension::Lens), lens);
            EXPECT_EQ(copy.get3(Dimension::Light, 2), light);
            EXPECT_EQ(a.walk(Dimension::Distance, 1).next_uint(),
                      b.walk(Dimension::Distance, 1).next_uint());
        }
    static_assert(sizeof(SampleStream) <= 24 && std::is_trivially_copyable_v<SampleStream>);
}

TEST(SampleStream, FewerComponentsAreTheFirstOfMore) {
    for (SamplerKind kind : kKinds)
        for (uint32_t i = 0; i < 500; ++i) {
            SampleStream const s(kind, {1, 2}, i, 3);
            Vec3 const all = s.get3(Dimension::Bsdf, 1);
            EXPECT_EQ(s.get2(Dimension::Bsdf, 1), Vec2(all.x, all.y));
            EXPECT_EQ(s.get1(Dimension::Bsdf, 1), all.x);
        }
}

/// Golden bits: pictures made by one version of Weft are those of the next, on any machine.
TEST(SampleStream, GoldenBits) {
    auto hash = [](SamplerKind kind) {
        uint64_t h = 0;
        for (uint32_t i = 0; i < 1000; ++i) {
            SampleStream const s(kind, {int(i) * 37 - 500, int(i) * 11}, i * i, i / 7);
            Vec3 const v = s.get3(Dimension::Light, i % 9);
            for (int k = 0; k < 3; ++k) h = hash64(h ^ uint64_t(v[k] * 0x1p24f));
        }
        return h;
    };
    EXPECT_EQ(hash(SamplerKind::Sobol), 0xff637a6a2eda2ad8ull);
    EXPECT_EQ(hash(SamplerKind::Halton), 0xd8884727581f043bull);
    EXPECT_EQ(hash(SamplerKind::Independent), 0xc1248a8977f487b4ull);
}

TEST(SampleStream, NumbersLieInTheUnitInterval) {
    EXPECT_EQ(to_unit_float(~0u), kOneMinusEpsilon);
    for (SamplerKind kind : kKinds)
        for (uint32_t i = 0; i < 300000; ++i) {
            SampleStream const s(kind, {int(i & 63), 0}, i < 100000 ? i : hash32(i), i >> 6);
            Vec3 const v = s.get3(Dimension::Bsdf, i % 7);
            ASSERT_TRUE(min_component(v) >= 0 && max_component(v) <= kOneMinusEpsilon);
        }
}

/// Scrambles that put a Halton point next to 1 must not round to it.
TEST(SampleStream, HaltonNeverReachesOne) {
    float largest = 0;
    for (uint32_t seed = 0; seed < 3000; ++seed)
        for (uint32_t i = 0; i < 311; ++i)
            largest = std::max(largest, scrambled_radical_inverse(311, i, hash64(seed)));
    EXPECT_GT(largest, 0.9999f);
    EXPECT_LE(largest, kOneMinusEpsilon);
}

/// Two numbers for each of many draws, on a grid of 8 x 8 cells: all cells equally likely.
/// The draws differ in pixel and seed, so that they are independent of one another.
template <class F>
double joint_p_value(F&& pair) {
    constexpr int kCells = 8, kDraws = 40000;
    std::vector<double> observed(kCells * kCells), expected(kCells * kCells, kDraws / 64.0);
    for (int i = 0; i < kDraws; ++i) {
        Vec2 const p = pair(i);
        observed[size_t(int(p.x * kCells) * kCells + int(p.y * kCells))] += 1;
    }
    return testing::chi_square(observed, expected).p_value;
}

TEST(SampleStream, NumbersOfDifferentNamesAreIndependent) {
    using S = SampleStream;
    auto at = [](SamplerKind kind, int i, uint32_t sample) {
        return S(kind, {i % 200, i / 200}, sample, 5);
    };
    std::map<std::string, std::function<Vec2(SamplerKind, int)>> const pairs{
        {"film and lens",
         [&](SamplerKind k, int i) {
             S const s = at(k, i, 3);
             return Vec2(s.get2(Dimension::Film).x, s.get2(Dimension::Lens).x);
         }},
        {"second components of BSDF and light",
         [&](SamplerKind k, int i) {
             S const s = at(k, i, 2);
             return Vec2(s.get3(Dimension::Bsdf, 1).y, s.get3(Dimension::Light, 1).y);
         }},
        {"components of one dimension",
         [&](SamplerKind k, int i) { return at(k, i, 1).get2(Dimension::Phase, 3); }},
        {"first and third component",
         [&](SamplerKind k, int i) {
             Vec3 const v = at(k, i, 1).get3(Dimension::Light, 0);
             return Vec2(v.x, v.z);
         }},
        {"vertices",
         [&](SamplerKind k, int i) {
             S const s = at(k, i, 0);
             return Vec2(s.get3(Dimension::Bsdf, 1).x, s.get3(Dimension::Bsdf, 2).x);
         }},
        {"distant vertices",
         [&](SamplerKind k, int i) {
             S const s = at(k, i, 0);
             return Vec2(s.get1(Dimension::Roulette, 7), s.get1(Dimension::Roulette, 30));
         }},
        {"neighbouring pixels",
         [&](SamplerKind k, int i) {
             return Vec2(S(k, {2 * i, 9}, 0, 1).get1(Dimension::Film),
                         S(k, {2 * i + 1, 9}, 0, 1).get1(Dimension::Film));
         }},
        {"mirrored pixels",
         [&](SamplerKind k, int i) {
             return Vec2(S(k, {i, -i - 1}, 4, 1).get1(Dimension::Film),
                         S(k, {-i - 1, i}, 4, 1).get1(Dimension::Film));
         }},
        {"consecutive seeds",
         [&](SamplerKind k, int i) {
             return Vec2(S(k, {5, 9}, 0, uint32_t(2 * i)).get1(Dimension::Film),
                         S(k, {5, 9}, 0, uint32_t(2 * i + 1)).get1(Dimension::Film));
         }},
        {"walks of different samples",
         [&](SamplerKind k, int i) {
             return Vec2(at(k, i, 0).walk(Dimension::Distance, 1).next(),
                         at(k, i, 1).walk(Dimension::Distance, 1).next());
         }},
        {"walk and its dimension",
         [&](SamplerKind k, int i) {
             S const s = at(k, i, 0);
             return Vec2(s.walk(Dimension::Distance, 1).next(), s.get1(Dimension::Distance, 1));
         }},
    };
    double const level = testing::sidak(kSignificance, int(pairs.size() * std::size(kKinds)));
    for (auto const& [name, pair] : pairs)
        for (SamplerKind kind : kKinds) {
            auto const& f = pair; // a structured binding cannot be captured
            EXPECT_GT(joint_p_value([&](int i) { return f(kind, i); }), level)
                << name << ", sampler " << int(kind);
        }
}

/// Errors of estimates from 16 samples each, in two streams whose arguments differ by a little:
/// their correlation is 0 by a z-test.
TEST(SampleStream, ErrorsOfNeighboursAreUncorrelated) {
    constexpr int kPairs = 100000;
    auto error = [](SamplerKind kind, Vec2i pixel, uint32_t seed, Dimension d, uint32_t vertex) {
        double sum = 0;
        for (uint32_t i = 0; i < 16; ++i) {
            Vec2 const u = SampleStream(kind, pixel, i, seed).get2(d, vertex);
            sum += u.x * u.x + u.y * u.y < 1;
        }
        return sum / 16 - M_PI / 4;
    };
    struct Neighbour {
        char const* what;
        Vec2i pixel;
        uint32_t seed;
        Dimension dimension;
        uint32_t vertex;
    };
    Neighbour const neighbours[] = {{"pixel to the right", {1, 0}, 0, Dimension::Phase, 1},
                                    {"pixel below", {0, 1}, 0, Dimension::Phase, 1},
                                    {"next seed", {0, 0}, 1, Dimension::Phase, 1},
                                    {"other dimension", {0, 0}, 0, Dimension::Distance, 1},
                                    {"next vertex", {0, 0}, 0, Dimension::Phase, 2}};
    double const level =
        testing::sidak(kSignificance, int(std::size(neighbours) * std::size(kKinds)));
    for (Neighbour const& n : neighbours)
        for (SamplerKind kind : kKinds) {
            std::vector<double> products(kPairs);
            for (int i = 0; i < kPairs; ++i) {
                Vec2i const pixel(2 * (i % 400), 2 * (i / 400));
                products[size_t(i)] =
                    error(kind, pixel, 6, Dimension::Phase, 1) *
                    error(kind, pixel + n.pixel, 6 + n.seed, n.dimension, n.vertex);
            }
            testing::Estimate const e = testing::estimate(products);
            EXPECT_GT(testing::normal_tail(e.mean / std::sqrt(e.variance)), level)
                << n.what << ", sampler " << int(kind);
        }
}

/// Padding: the orders of two dimensions are shuffled independently. Samples 2k and 2k + 1 lie in
/// different halves of either dimension, in an order that is a fair coin for each pair, so the
/// number of pairs whose orders agree is binomial.
TEST(SobolStream, ShufflesOfDifferentDimensionsAreIndependent) {
    constexpr int kPixels = 20000, kCoins = 32;
    std::vector<double> observed(kCoins + 1), expected(kCoins + 1);
    for (int k = 0; k <= kCoins; ++k)
        expected[size_t(k)] =
            kPixels * std::exp(std::lgamma(kCoins + 1.0) - std::lgamma(k + 1.0) -
                               std::lgamma(kCoins - k + 1.0) - kCoins * std::log(2.0));
    for (int p = 0; p < kPixels; ++p) {
        size_t agree = 0;
        for (uint32_t k = 0; k < kCoins; ++k) {
            SampleStream const s(SamplerKind::Sobol, {p % 200, p / 200}, 2 * k, 8);
            bool const a = s.get2(Dimension::Film).x < 0.5f;
            bool const b = s.get3(Dimension::Light, 0).x < 0.5f;
            agree += a == b;
        }
        observed[agree] += 1;
    }
    testing::ChiSquare const test = testing::chi_square(observed, expected);
    EXPECT_GT(test.p_value, kSignificance) << test.statistic << " dof " << test.dof;
}

} // namespace
} // namespace weft::sampling
