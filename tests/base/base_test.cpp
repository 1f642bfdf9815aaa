// Colours, hashes, closed sets, messages.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "base/color.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/match.h"
#include "tests/support/statistics.h"

namespace weft {
namespace {

TEST(Color, TransferFunctionsAreInverse) {
    for (int i = 0; i <= 4096; ++i) {
        float const x = float(i) / 4096;
        EXPECT_NEAR(linear_to_srgb(srgb_to_linear(x)), x, 2e-6) << x;
        EXPECT_NEAR(srgb_to_linear(linear_to_srgb(x)), x, 2e-6) << x;
    }
    for (int i = 0; i < 256; ++i) // every 8 bit code comes back as itself
        EXPECT_EQ(int(linear_to_srgb(srgb_to_linear(float(i) / 255)) * 255 + 0.5f), i);
}

TEST(Color, TransferFunctionsHaveTheStandardsValues) {
    EXPECT_EQ(srgb_to_linear(0), 0);
    EXPECT_NEAR(srgb_to_linear(1), 1, 1e-6);
    EXPECT_NEAR(srgb_to_linear(0.5f), 0.21404114, 1e-6);
    EXPECT_NEAR(linear_to_srgb(0.18f), 0.46135613, 1e-6);
    // The linear and the curved part meet, to the standard's own rounding.
    EXPECT_NEAR(srgb_to_linear(0.04045f), srgb_to_linear(0.0404501f), 1e-6);
    EXPECT_NEAR(linear_to_srgb(0.0031308f), linear_to_srgb(0.00313081f), 1e-6);
    for (int i = 0; i < 4096; ++i)
        EXPECT_LT(srgb_to_linear(float(i) / 4096), srgb_to_linear(float(i + 1) / 4096));
}

TEST(Color, ReductionsAndArithmetic) {
    Color const c(0.5f, 2, 1);
    EXPECT_NEAR(luminance(Color(1)), 1, 1e-6);
    EXPECT_NEAR(luminance(c), 0.2126 * 0.5 + 0.7152 * 2 + 0.0722, 1e-6);
    EXPECT_EQ(max_component(c), 2);
    EXPECT_EQ(min_component(c), 0.5f);
    EXPECT_NEAR(average(c), 3.5 / 3, 1e-6);
    EXPECT_EQ(c + c - c, c);
    EXPECT_EQ(c * Color(2) / 2, c);
    EXPECT_EQ(c / c, Color(1));
    EXPECT_EQ(lerp(Color(0), c, 0.5f), c * 0.5f);
    EXPECT_TRUE(is_black(Color()) && !is_black(Color(0, 0, 1e-30f)));
    EXPECT_FALSE(is_finite(Color(0, kInfinity, 0)));
    EXPECT_FALSE(is_finite(Color(0, 0, std::nanf(""))));
    EXPECT_EQ(Color(c[0], c[1], c[2]), c);
}

/// The inverse of an odd number modulo a power of two, by Newton's iteration.
template <class T>
constexpr T odd_inverse(T a) {
    T x = a;
    for (int i = 0; i < 6; ++i) x *= 2 - a * x;
    return x;
}

template <class T>
constexpr T undo_xor_shift(T y, int shift) {
    T x = y;
    for (int i = shift; i < int(8 * sizeof(T)); i += shift) x = y ^ (x >> shift);
    return x;
}

/// The hashes run backwards: a function with an inverse is a bijection.
TEST(Hash, AreBijections) {
    auto undo32 = [](uint32_t x) {
        x = undo_xor_shift(x, 15) * odd_inverse(0xd35a2d97u);
        x = undo_xor_shift(x, 15) * odd_inverse(0x21f0aaadu);
        return undo_xor_shift(x, 16);
    };
    auto undo64 = [](uint64_t x) {
        x = undo_xor_shift(x, 31) * odd_inverse<uint64_t>(0x94d049bb133111ebull);
        x = undo_xor_shift(x, 27) * odd_inverse<uint64_t>(0xbf58476d1ce4e5b9ull);
        return undo_xor_shift(x, 30) - 0x9e3779b97f4a7c15ull;
    };
    for (uint32_t i = 0; i < 1u << 20; ++i) {
        uint32_t const x = i * 4099u;
        ASSERT_EQ(undo32(hash32(x)), x);
        uint64_t const y = uint64_t(i) << (i % 45);
        ASSERT_EQ(undo64(hash64(y)), y);
    }
}

/// Flipping any one bit of the input flips each bit of the output half of the time. The greatest
/// bias over all pairs of bits is bounded by a Sidak corrected z-test for hash64; hash32, at its
/// size, is known to keep a small one, and is held to 1%.
TEST(Hash, OneBitOfInputMovesHalfOfTheOutput) {
    constexpr int kTrials = 1 << 16;
    Rng rng(1);
    std::vector<int> flips32(32 * 32), flips64(64 * 64);
    for (int t = 0; t < kTrials; ++t) {
        uint64_t const x = uint64_t(rng.next_uint()) << 32 | rng.next_uint();
        if (t % 8 == 0) // an eighth of the trials: 4096 pairs are slow
            for (int i = 0; i < 64; ++i)
                for (uint64_t d = hash64(x) ^ hash64(x ^ 1ull << i), o = 0; o < 64; ++o)
                    flips64[size_t(i) * 64 + o] += int(d >> o & 1);
        for (int i = 0; i < 32; ++i)
            for (uint32_t d = hash32(uint32_t(x)) ^ hash32(uint32_t(x) ^ 1u << i), o = 0; o < 32;
                 ++o)
                flips32[size_t(i) * 32 + o] += int(d >> o & 1);
    }
    double const level = testing::sidak(0.01, 64 * 64), n = kTrials / 8;
    for (int f : flips64) EXPECT_GT(testing::normal_tail((f - n / 2) / std::sqrt(n / 4)), level);
    for (int f : flips32) EXPECT_NEAR(double(f) / kTrials, 0.5, 0.01);
}

TEST(Hash, CombineDependsOnOrderAndBothParts) {
    std::set<uint32_t> seen;
    for (uint32_t a = 0; a < 64; ++a)
        for (uint32_t b = 0; b < 64; ++b) seen.insert(hash_combine(a, b));
    EXPECT_GE(seen.size(), 64u * 64 - 1); // 2e-3 collisions expected among 4096 of 2^32
    EXPECT_NE(hash_combine(1, 2), hash_combine(2, 1));
}

TEST(Hash, BytesAreFnv1a) { // test vectors of the authors of FNV
    EXPECT_EQ(hash_bytes(""), 0xcbf29ce484222325ull);
    EXPECT_EQ(hash_bytes("a"), 0xaf63dc4c8601ec8cull);
    EXPECT_EQ(hash_bytes("foobar"), 0x85944171f73967e8ull);
    EXPECT_EQ(hash_bytes("bar", hash_bytes("foo")), hash_bytes("foobar"));
}

TEST(Rng, IsUniformAndRepeats) {
    constexpr int kSamples = 1 << 20;
    std::vector<double> observed(32 * 32), expected(32 * 32, kSamples / 1024.0);
    Rng a(5), b(5), c(6);
    int equal = 0;
    for (int i = 0; i < kSamples; ++i) {
        Vec2 const p = a.next2();
        ASSERT_EQ(p, b.next2());
        equal += p.x == c.next();
        ASSERT_TRUE(p.x >= 0 && p.x <= kOneMinusEpsilon);
        observed[size_t(p.x * 32) * 32 + size_t(p.y * 32)] += 1;
    }
    EXPECT_LT(equal, 10); // 1 / 16 expected
    EXPECT_GT(testing::chi_square(observed, expected).p_value, 0.01);
}

struct Circle {
    int radius;
};
struct Square {
    int side;
};
struct Point {};
using Shape = std::variant<Circle, Square, Point>;

TEST(Match, VisitsTheHeldAlternative) {
    auto area = [](Shape const& s) {
        return match(s, Overloaded{[](Circle const& c) { return 3 * c.radius * c.radius; },
                                   [](Square const& q) { return q.side * q.side; },
                                   [](auto const&) { return 0; }});
    };
    std::vector<Shape> const shapes = {Circle{2}, Square{3}, Point{}};
    EXPECT_EQ(area(shapes[0]), 12);
    EXPECT_EQ(area(shapes[1]), 9);
    EXPECT_EQ(area(shapes[2]), 0);
}

TEST(Match, GivesReferencesToWhatIsHeld) {
    Shape s = Square{3};
    match(s, Overloaded{[](Square& q) { q.side = 7; }, [](auto&) { FAIL(); }});
    EXPECT_EQ(std::get<Square>(s).side, 7);
    std::variant<int, long> one = 4;
    int& held = std::get<int>(one);
    EXPECT_EQ(match(one, [](auto& v) -> void const* { return &v; }), &held);
}

TEST(Match, ListsAllTypesInOrder) {
    std::string names;
    for_each_type<Shape>([&]<class T>() {
        names += std::is_same_v<T, Circle> ? 'c' : std::is_same_v<T, Square> ? 's' : 'p';
    });
    EXPECT_EQ(names, "csp");
}

TEST(Error, NearestNameForgivesTyposAndCase) {
    std::vector<std::string> const names = {"roughness", "baseColor", "ior", "specular", "mix"};
    EXPECT_EQ(nearest_name("roughnes", names), "roughness");
    EXPECT_EQ(nearest_name("ruoghness", names), "roughness");
    EXPECT_EQ(nearest_name("basecolour", names), "baseColor");
    EXPECT_EQ(nearest_name("IOR", names), "ior");
    EXPECT_EQ(nearest_name("transmission", names), "");
    EXPECT_EQ(nearest_name("x", {}), "");
    EXPECT_EQ(nearest_name("zzz", names), ""); // as many edits as letters is no likeness
}

TEST(Error, SuggestionNamesTheNearestOrAll) {
    std::vector<std::string> const names = {"sphere", "plane"};
    EXPECT_EQ(suggestion("spere", names), " (did you mean 'sphere'?)");
    EXPECT_EQ(suggestion("transmission", names), "; known: sphere, plane");
    EXPECT_EQ(suggestion("anything", {}), "");
}

TEST(Error, MessagesBeginWithTheLocation) {
    EXPECT_EQ(to_string(SourceLocation{"a.xml", 3, 7}), "a.xml:3:7");
    EXPECT_EQ(to_string(SourceLocation{"a.xml", 3, 0}), "a.xml:3");
    EXPECT_EQ(to_string(SourceLocation{"a.ply", 0, 0}), "a.ply");
    EXPECT_STREQ(InputError(SourceLocation{"a.xml", 3, 7}, "no").what(), "a.xml:3:7: no");
}

} // namespace
} // namespace weft
