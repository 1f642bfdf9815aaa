#include <gtest/gtest.h>

#include "base/hash.h"
#include "base/match.h"
#include "base/warp.h"
#include "lights/light_tree.h"
#include "tests/support/statistics.h"

namespace weft::lights {
namespace {

using weft::testing::chi_square;
using weft::testing::sidak;

constexpr double kAlpha = 0.01; // for each test

/// A mesh is of one triangle: each of them is a light of its own.
using Lamp =
    std::variant<PointLight, SpotLight, RectangleEmitter, SphereEmitter, DiskEmitter, MeshEmitter>;

struct Case {
    std::string name;
    std::vector<Lamp> lamps; ///< of radiance or intensity 1
    std::vector<LightBounds> bounds;
};

void add(Case& c, Lamp const& lamp, float power) {
    c.lamps.push_back(lamp);
    c.bounds.push_back(match(lamp, [](auto const& l) {
        if constexpr (requires { bounds_of(l, 0); })
            return bounds_of(l, 0);
        else
            return bounds_of(l);
    }));
    c.bounds.back().power = power;
}

Lamp random_lamp(Rng& rng, Vec3 const& at, float size) {
    Vec3 const axis = square_to_sphere(rng.next2());
    Vec3 const aside = normalize(cross(axis, square_to_sphere(rng.next2()))) * size;
    Affine const place(aside, cross(axis, aside) * (0.2f + rng.next()), axis * size, at);
    uint32_t const kind = rng.next_uint() % 6;
    if (kind == 0) return PointLight{at};
    if (kind == 1) return SpotLight{at, axis, Color(1), rng.next() * 4, rng.next() * 4};
    if (kind == 2) return RectangleEmitter(place);
    if (kind == 3) return SphereEmitter(place);
    if (kind == 4) return DiskEmitter(place);
    return MeshEmitter({place.point({-1, -1, 0}), place.point({1, -1, 0}), place.point({-1, 1, 0})},
                       {{0, 1, 2}});
}

Case random_case(std::string name, uint32_t count, float size, Vec3 const& extent, uint64_t seed) {
    Case c{std::move(name), {}, {}};
    Rng rng(seed);
    for (uint32_t i = 0; i < count; ++i) {
        Vec3 const at = (rng.next3() * 2 - Vec3(1)) * extent;
        add(c, random_lamp(rng, at, size * (0.1f + rng.next())), std::exp(3 * rng.next()));
    }
    return c;
}

std::vector<Case> cases() {
    std::vector<Case> all{random_case("one", 1, 0.2f, Vec3(1), 1),
                          random_case("two", 2, 0.2f, Vec3(1), 2),
                          random_case("five", 5, 0.5f, Vec3(1), 3),
                          random_case("hundred", 100, 0.1f, Vec3(1), 4),
                          random_case("thousands", 3000, 0.02f, Vec3(1, 1, 0.1f), 5),
                          random_case("in a plane", 200, 0.05f, Vec3(1, 1, 0), 6),
                          random_case("on a line", 200, 0.05f, Vec3(1, 0, 0), 7),
                          random_case("in one place", 200, 0.05f, Vec3(0), 8)};
    Case points{"points in one place", {}, {}};
    for (int i = 0; i < 50; ++i) add(points, PointLight{{0.5f, 0, 0}}, float(1 + i % 3));
    all.push_back(points);
    Case mixed = random_case("some without power, some far away", 60, 0.1f, Vec3(1), 9);
    for (uint32_t i = 0; i < 60; i += 7) mixed.bounds[i].power = 0;
    for (uint32_t i = 3; i < 60; i += 11) mixed.bounds[i].at_infinity = true;
    all.push_back(mixed);
    Case clusters{"clusters of clusters", {}, {}};
    for (uint32_t i = 0; i < 300; ++i) { // ever closer to the origin
        Vec3 const at = Vec3(1, 0.3f, -0.2f) * std::pow(0.9f, float(i));
        add(clusters, PointLight{at}, 1);
    }
    all.push_back(clusters);
    return all;
}

struct Place {
    Vec3 ref, normal;
};

/// Near lights, amid them, outside, far away; with normals and without.
std::vector<Place> places(Case const& c) {
    LightBounds const& first = c.bounds[0];
    Vec3 const up{0, 0, 1}, slant = normalize(Vec3(1, -2, 0.5f));
    return {{first.centre() + Vec3(1e-3f, 0, 0), up},
            {first.centre(), Vec3(0)},
            {{0.1f, 0.2f, 0.3f}, slant},
            {{-0.2f, 0.1f, 0}, Vec3(0)},
            {{0.3f, 2, -1.5f}, up},
            {{-1.2f, 0, 0}, Vec3(1, 0, 0)},
            {{300, -200, 100}, slant}};
}

TEST(LightTree, choices_follow_the_probabilities) {
    auto const all = cases();
    double const level = sidak(kAlpha, int(all.size() * places(all[0]).size()));
    for (Case const& c : all) {
        LightTree const tree(c.bounds);
        size_t const count = c.bounds.size();
        for (Place const& at : places(c)) {
            SCOPED_TRACE(c.name);
            int const samples = 200'000;
            std::vector<double> observed(count + 1), expected(count + 1);
            double sum = 0;
            for (uint32_t i = 0; i < count; ++i) {
                double const p = double(tree.probability(at.ref, at.normal, i));
                EXPECT_GE(p, 0);
                expected[i] = p * samples;
                sum += p;
            }
            expected[count] = std::max(0.0, 1 - sum) * samples; // nothing
            if (expected[count] < 1e-5 * samples) expected[count] = 0;
            EXPECT_LT(sum, 1 + 1e-5);
            Rng rng(41);
            for (int i = 0; i < samples; ++i) {
                auto const choice = tree.choose(at.ref, at.normal, rng.next());
                if (!(choice.probability > 0)) {
                    ++observed[count];
                    continue;
                }
                ASSERT_GE(choice.u_rest, 0);
                ASSERT_LT(choice.u_rest, 1);
                ASSERT_EQ(choice.probability, tree.probability(at.ref, at.normal, choice.index));
                ++observed[choice.index];
            }
            auto const result = chi_square(observed, expected);
            EXPECT_GT(result.p_value, level) << at.ref << ' ' << result.problem;
        }
    }
}

TEST(LightTree, probabilities_of_lights_that_shine_everywhere_sum_to_one) {
    Case c{"", {}, {}};
    Rng rng(5);
    for (int i = 0; i < 500; ++i) add(c, PointLight{rng.next3()}, rng.next());
    LightTree const tree(c.bounds);
    for (Place const& at : places(c)) {
        double sum = 0;
        for (uint32_t i = 0; i < 500; ++i) {
            double const p = double(tree.probability(at.ref, at.normal, i));
            EXPECT_GT(p, 0);
            sum += p;
        }
        EXPECT_NEAR(sum, 1, 1e-5);
    }
}

/// Irradiance of one sample, by the projected solid angle on both sides; all of it in media.
double contribution(Lamp const& lamp, Place const& at, Vec2 u) {
    auto received = [&](Vec3 const& wi) {
        return at.normal == Vec3(0) ? 1.0 : double(std::abs(dot(wi, at.normal)));
    };
    return match(lamp, [&](auto const& l) -> double {
        if constexpr (requires { l.area(); }) {
            EmitterSample const s = l.sample(at.ref, u, 0);
            return s.pdf > 0 && dot(s.n, s.wi) < 0 ? received(s.wi) / double(s.pdf) : 0.0;
        } else {
            LightSample const s = l.sample(at.ref);
            return s.pdf > 0 ? received(s.wi) * double(s.radiance.r) : 0.0;
        }
    });
}

TEST(LightTree, every_light_that_contributes_has_a_chance) {
    for (Case const& c : cases()) {
        LightTree const tree(c.bounds);
        Rng rng(17);
        for (int k = 0; k < 60; ++k) {
            Vec3 const normal = k % 3 ? square_to_sphere(rng.next2()) : Vec3(0);
            Place const at{(rng.next3() * 2 - Vec3(1)) * (k % 2 ? 1.f : 4.f), normal};
            for (uint32_t i = 0; i < c.lamps.size(); ++i) {
                if (!(c.bounds[i].power > 0) || c.bounds[i].at_infinity) continue;
                if (tree.probability(at.ref, at.normal, i) > 0) continue;
                for (int j = 0; j < 8; ++j)
                    ASSERT_EQ(contribution(c.lamps[i], at, rng.next2()), 0)
                        << c.name << ' ' << i << ' ' << at.ref;
            }
        }
    }
}

TEST(LightTree, choosing_gives_the_irradiance_of_all) {
    auto const all = cases();
    double const level = sidak(kAlpha, int(all.size() * places(all[0]).size()));
    for (Case const& c : all) {
        LightTree const tree(c.bounds);
        auto shines = [&](uint32_t i) { return c.bounds[i].power > 0 && !c.bounds[i].at_infinity; };
        for (Place const& at : places(c)) {
            Rng rng(23);
            weft::testing::Estimate sum;
            for (uint32_t i = 0; i < c.lamps.size(); ++i) {
                if (!shines(i)) continue;
                std::vector<double> values(c.lamps.size() > 1000 ? 50 : 1000);
                for (double& v : values) v = contribution(c.lamps[i], at, rng.next2());
                auto const e = weft::testing::estimate(values);
                sum.mean += e.mean;
                sum.variance += e.variance;
            }
            std::vector<double> values(100'000);
            for (double& v : values) {
                auto const choice = tree.choose(at.ref, at.normal, rng.next());
                if (choice.probability > 0 && shines(choice.index))
                    v = contribution(c.lamps[choice.index], at, rng.next2()) /
                        double(choice.probability);
            }
            auto const chosen = weft::testing::estimate(values);
            double const sigma =
                std::sqrt(sum.variance + chosen.variance) + 1e-5 * std::abs(sum.mean);
            if (sigma == 0) continue;
            EXPECT_GT(weft::testing::normal_tail((chosen.mean - sum.mean) / sigma), level)
                << c.name << ' ' << at.ref << ": " << chosen.mean << " for " << sum.mean;
        }
    }
}

TEST(LightTree, several_choices_follow_their_probabilities_and_give_the_sum_of_all) {
    auto const all = cases();
    double const level = sidak(kAlpha, int(2 * all.size() * places(all[0]).size()));
    for (Case const& c : all) {
        LightTree const tree(c.bounds);
        size_t const count = c.bounds.size();
        for (Place const& at : places(c))
            for (uint32_t choices : {2u, 7u}) {
                int const samples = 20'000;
                std::vector<double> values(count), times(count), sums(samples);
                Rng rng(29);
                double total = 0;
                for (uint32_t i = 0; i < count; ++i) {
                    // About as important as it is said to be, so that the sum is nearly normal.
                    values[i] =
                        double(tree.probability(at.ref, at.normal, i) * (0.5f + rng.next()));
                    double const p = double(tree.probability(at.ref, at.normal, i, choices));
                    ASSERT_LE(p, 1);
                    if (p > 0) total += values[i];
                }
                for (double& sum : sums) {
                    uint32_t chosen = 0;
                    tree.choose_each(
                        at.ref, at.normal, double(rng.next()), choices, [&](auto const& choice) {
                            ASSERT_EQ(choice.probability,
                                      tree.probability(at.ref, at.normal, choice.index, choices));
                            sum += values[choice.index] / double(choice.probability);
                            ++times[choice.index];
                            ++chosen;
                        });
                    ASSERT_LE(chosen, choices);
                }
                for (uint32_t i = 0; i < count; ++i) {
                    double const p = double(tree.probability(at.ref, at.normal, i, choices));
                    double const variance = std::max(samples * p * (1 - p), 1e-3);
                    // Five sigma and a little for small counts: far below 0.01 for all together.
                    EXPECT_NEAR(times[i], samples * p, 5 * std::sqrt(variance) + 5)
                        << c.name << ' ' << i << " of " << choices;
                }
                auto const mean = weft::testing::estimate(sums);
                double const sigma = std::sqrt(mean.variance) + 1e-5 * total;
                if (sigma == 0) continue;
                EXPECT_GT(weft::testing::normal_tail((mean.mean - total) / sigma), level)
                    << c.name << ' ' << at.ref << ' ' << choices;
            }
    }
}

TEST(LightTree, as_many_choices_as_lights_of_the_same_importance_take_each_once) {
    Case c{"", {}, {}};
    for (int i = 0; i < 4; ++i) {
        float const angle = float(i) * kPi / 2;
        add(c, PointLight{{std::cos(angle), std::sin(angle), 1}}, 1);
    }
    LightTree const tree(c.bounds);
    for (double u : {0.01, 0.3, 0.77, 0.99}) {
        std::vector<uint32_t> chosen;
        tree.choose_each(Vec3(0), Vec3(0), u, 4, [&](auto const& choice) {
            chosen.push_back(choice.index);
            EXPECT_NEAR(choice.probability, 1, 1e-5);
        });
        std::sort(chosen.begin(), chosen.end());
        EXPECT_EQ(chosen, (std::vector<uint32_t>{0, 1, 2, 3}));
    }
}

TEST(LightTree, the_rest_of_the_number_is_uniform) {
    Case c = random_case("", 12, 0.2f, Vec3(1), 31);
    c.bounds[5].at_infinity = c.bounds[8].at_infinity = true;
    LightTree const tree(c.bounds);
    int const bins = 20, samples = 500'000;
    for (Place const& at : places(c)) {
        std::vector<double> observed(12 * bins), expected(12 * bins);
        for (uint32_t i = 0; i < 12 * bins; ++i)
            expected[i] = double(tree.probability(at.ref, at.normal, i / bins)) / bins * samples;
        Rng rng(42);
        for (int i = 0; i < samples; ++i) {
            auto const choice = tree.choose(at.ref, at.normal, rng.next());
            if (choice.probability > 0)
                ++observed[choice.index * bins + uint32_t(choice.u_rest * bins)];
        }
        double const level = sidak(kAlpha, int(places(c).size()));
        // Where nothing is chosen at times, the totals differ by chance, too.
        double total = 0, expected_total = 0;
        for (uint32_t i = 0; i < 12 * bins; ++i) {
            total += observed[i];
            expected_total += expected[i];
        }
        for (double& e : expected) e *= total / expected_total;
        EXPECT_GT(chi_square(observed, expected).p_value, level) << at.ref;
    }
}

TEST(LightTree, infinite_lights_are_chosen_half_by_power_and_half_evenly) {
    Case c = random_case("", 4, 0.2f, Vec3(1), 7);
    float const powers[]{1, 2, 5, 0};
    for (int i = 0; i < 4; ++i) {
        c.bounds[size_t(i)].power = powers[i];
        c.bounds[size_t(i)].at_infinity = i != 1;
    }
    LightTree const tree(c.bounds);
    for (Place const& at : places(c))
        for (uint32_t i = 0; i < 4; ++i)
            EXPECT_NEAR(tree.probability(at.ref, at.normal, i),
                        powers[i] > 0 ? powers[i] / 16 + 1.f / 6 : 0, 1e-6);
    c.bounds[0].weight = 0.5f;
    EXPECT_NEAR(LightTree(c.bounds).probability(Vec3(0), Vec3(0), 0), 1.f / 16 + 1.f / 10, 1e-6);
}

TEST(LightTree, no_positive_power_is_negligible) {
    std::vector<LightBounds> bounds(4);
    for (LightBounds& b : bounds) b.at_infinity = true;
    bounds[0].power = 1e12f;
    bounds[1].power = 1;
    bounds[3].power = 1e-12f;
    LightTree const tree(bounds);
    Place const at{{1, 2, 3}, {0, 0, 1}};
    for (uint32_t i : {1u, 3u})
        EXPECT_NEAR(tree.probability(at.ref, at.normal, i), 0.5 * 1e-3 / 3 + 0.5 / 3, 1e-6);
    EXPECT_EQ(tree.probability(at.ref, at.normal, 2), 0);
}

TEST(LightTree, prefers_what_is_near_bright_and_faces_the_point) {
    Case c{"", {}, {}};
    Affine const down({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1});
    Affine const up({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 4});
    add(c, RectangleEmitter(down), 1);
    add(c, RectangleEmitter(up), 1);
    add(c, PointLight{{0, 0, 50}}, 1);
    add(c, PointLight{{0, 50, 0}}, 10);
    LightTree const tree(c.bounds);
    Vec3 const ref(0), n(0, 0, 1);
    EXPECT_GT(tree.probability(ref, n, 0), 0.99f);
    EXPECT_EQ(tree.probability(ref, n, 1), 0);
    EXPECT_GT(tree.probability(ref, Vec3(0), 3), tree.probability(ref, Vec3(0), 2));
}

TEST(LightTree, may_be_empty) {
    std::vector<LightBounds> const without_power(3);
    for (LightTree const& tree :
         {LightTree(), LightTree(std::span<LightBounds const>()), LightTree(without_power)}) {
        EXPECT_TRUE(tree.empty());
        EXPECT_EQ(tree.choose(Vec3(0), Vec3(0), 0.5f).probability, 0);
        EXPECT_EQ(tree.probability(Vec3(0), Vec3(0), 0), 0);
    }
}

TEST(LightTree, ends_of_the_unit_interval) {
    for (Case const& c : cases()) {
        LightTree const tree(c.bounds);
        for (Place const& at : places(c))
            for (float u : {0.f, 0x1p-24f, kOneMinusEpsilon}) {
                auto const choice = tree.choose(at.ref, at.normal, u);
                EXPECT_EQ(choice.probability,
                          choice.probability > 0 ? tree.probability(at.ref, at.normal, choice.index)
                                                 : 0);
            }
    }
}

TEST(LightTree, of_a_hundred_thousand_is_the_same_each_time) {
    Case const c = random_case("", 100'000, 1e-3f, Vec3(1), 99);
    LightTree const a(c.bounds), b(c.bounds);
    Rng rng(3);
    for (int i = 0; i < 10'000; ++i) {
        Vec3 const ref = rng.next3();
        float const u = rng.next();
        auto const x = a.choose(ref, {0, 0, 1}, u), y = b.choose(ref, {0, 0, 1}, u);
        ASSERT_EQ(x.index, y.index);
        ASSERT_EQ(x.probability, y.probability);
        ASSERT_EQ(x.u_rest, y.u_rest);
        ASSERT_EQ(x.probability, x.probability > 0 ? a.probability(ref, {0, 0, 1}, x.index) : 0);
    }
}

TEST(LightBounds, united_bounds_hold_their_parts) {
    Rng rng(8);
    for (int k = 0; k < 2000; ++k) {
        std::vector<LightBounds> parts(2 + rng.next_uint() % 5);
        LightBounds pairwise;
        float const spread = rng.next() * 2;
        for (size_t i = 0; i < parts.size(); ++i) {
            Vec3 const at = rng.next3();
            parts[i] = {at,
                        at + rng.next3(),
                        normalize(Vec3(0, 0, 1) + square_to_sphere(rng.next2()) * spread),
                        rng.next() * rng.next() * kPi,
                        rng.next() * kPi / 2,
                        rng.next()};
            pairwise = i ? unite(pairwise, parts[i]) : parts[i];
        }
        for (LightBounds const& all : {pairwise, unite(parts)})
            for (LightBounds const& p : parts) {
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_LE(all.low[axis], p.low[axis]);
                    EXPECT_GE(all.high[axis], p.high[axis]);
                }
                float const apart =
                    std::atan2(length(cross(all.axis, p.axis)), dot(all.axis, p.axis));
                EXPECT_GE(all.theta_o, std::min(kPi, apart + p.theta_o) - 1e-5f);
                EXPECT_GE(all.theta_e, p.theta_e);
            }
    }
}

TEST(LightBounds, orientation_measure_is_power_over_intensity) {
    EXPECT_NEAR(orientation_measure(bounds_of(PointLight{})), 4 * kPi, 1e-5);
    EXPECT_NEAR(orientation_measure(bounds_of(RectangleEmitter(Affine()))), kPi, 1e-6);
    EXPECT_NEAR(orientation_measure(bounds_of(SphereEmitter(Affine()))), 4 * kPi, 1e-5);
    float const half = 0.3f;
    SpotLight const spot{{}, {0, 0, 1}, Color(1), 2 * half, 0};
    EXPECT_NEAR(orientation_measure(bounds_of(spot)), spot.power().r, 1e-5);
}

} // namespace
} // namespace weft::lights
