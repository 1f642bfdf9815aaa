#include <gtest/gtest.h>

#include "base/hash.h"
#include "lights/light_choice.h"
#include "tests/support/statistics.h"

namespace weft::lights {
namespace {

Vec3 const kRef{1, 2, 3}, kNormal{0, 0, 1};

std::vector<std::vector<float>> weight_sets() {
    std::vector<float> many(3000);
    for (uint32_t i = 0; i < many.size(); ++i)
        many[i] = i % 5 ? std::exp(8 * to_unit_float(hash32(i))) : 0;
    return {{1}, {1, 2, 3, 4}, {0, 0, 5, 0, 1, 0}, {1e9f, 1e-9f, 3, 0}, {0, 1e-30f}, many};
}

TEST(LightChoice, choices_follow_the_probabilities) {
    double const level = testing::sidak(0.01, int(weight_sets().size()));
    for (auto const& weights : weight_sets()) {
        LightChoice const choice(weights);
        ASSERT_FALSE(choice.empty());
        int const samples = 1'000'000;
        std::vector<double> observed(weights.size()), expected(weights.size());
        double sum = 0;
        for (uint32_t i = 0; i < weights.size(); ++i) {
            double const p = double(choice.probability(kRef, kNormal, i));
            EXPECT_EQ(p > 0, weights[i] > 0) << i;
            expected[i] = p * samples;
            sum += p;
        }
        EXPECT_NEAR(sum, 1, 1e-6);
        EXPECT_EQ(choice.probability(kRef, kNormal, uint32_t(weights.size())), 0);
        Rng rng(41);
        for (int i = 0; i < samples; ++i) {
            auto const c = choice.choose(kRef, kNormal, rng.next());
            ASSERT_GT(weights[c.index], 0);
            ASSERT_EQ(c.probability, choice.probability(kRef, kNormal, c.index));
            ++observed[c.index];
        }
        auto const result = testing::chi_square(observed, expected);
        EXPECT_GT(result.p_value, level) << result.problem;
    }
}

TEST(LightChoice, is_by_weight) {
    std::vector<float> const weights{1, 2, 0, 5};
    LightChoice const choice(weights);
    for (uint32_t i = 0; i < 4; ++i)
        EXPECT_NEAR(choice.probability(kRef, kNormal, i), weights[i] / 8, 1e-6);
}

TEST(LightChoice, no_positive_weight_is_negligible) {
    std::vector<float> const weights{1e12f, 1, 0, 1e-12f};
    LightChoice const choice(weights);
    EXPECT_NEAR(choice.probability(kRef, kNormal, 1), 1e-3 / 3, 1e-6);
    EXPECT_NEAR(choice.probability(kRef, kNormal, 3), 1e-3 / 3, 1e-6);
    EXPECT_EQ(choice.probability(kRef, kNormal, 2), 0);
}

TEST(LightChoice, the_rest_of_the_number_is_uniform) {
    std::vector<float> const weights{1, 3, 0, 2};
    LightChoice const choice(weights);
    int const bins = 50, samples = 500'000;
    std::vector<double> observed(4 * bins), expected(4 * bins);
    for (uint32_t i = 0; i < 4 * bins; ++i)
        expected[i] = double(weights[i / bins]) / 6 / bins * samples;
    Rng rng(42);
    for (int i = 0; i < samples; ++i) {
        auto const c = choice.choose(kRef, kNormal, rng.next());
        ASSERT_TRUE(c.u_rest >= 0 && c.u_rest < 1);
        ++observed[c.index * bins + uint32_t(c.u_rest * bins)];
    }
    EXPECT_GT(testing::chi_square(observed, expected).p_value, 0.01);
}

TEST(LightChoice, may_be_empty) {
    std::vector<float> const zeros(3, 0.f);
    for (LightChoice const& choice :
         {LightChoice(), LightChoice(std::span<float const>()), LightChoice(zeros)}) {
        EXPECT_TRUE(choice.empty());
        EXPECT_EQ(choice.choose(kRef, kNormal, 0.5f).probability, 0);
        EXPECT_EQ(choice.probability(kRef, kNormal, 0), 0);
    }
}

TEST(LightChoice, ends_of_the_unit_interval) {
    std::vector<float> const weights{0, 2, 0, 3, 0};
    LightChoice const choice(weights);
    EXPECT_EQ(choice.choose(kRef, kNormal, 0).index, 1u);
    EXPECT_EQ(choice.choose(kRef, kNormal, kOneMinusEpsilon).index, 3u);
}

} // namespace
} // namespace weft::lights
