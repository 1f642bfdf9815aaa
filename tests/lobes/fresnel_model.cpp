// The Fresnel models against closed forms and quadrature, metals, and split boundaries.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "lobes/conductor_presets.h"
#include "lobes/dielectric_boundary.h"
#include "lobes/fresnel_model.h"
#include "tests/lobes/configurations.h"

using namespace weft;
using namespace weft::lobes;

namespace {

TEST(FresnelModel, EdgeTintSetsTheValueAt82Degrees) {
    Color const f0(0.2f, 0.5f, 0.9f), tint(0.1f, 0.6f, 1);
    SchlickFresnel const f = schlick_f82(f0, tint);
    Color const plain = fresnel_schlick(1 / 7.f, f0), tinted = reflectance(f, 1 / 7.f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(tinted[c], plain[c] * tint[c], 1e-5);
        EXPECT_NEAR(reflectance(f, 1)[c], f0[c], 1e-6);
        EXPECT_NEAR(reflectance(f, 0)[c], 1, 1e-6);
    }
}

TEST(FresnelModel, MeansAreHemispherical) {
    for (auto const& [name, fresnel] : lobes::testing::test_fresnels()) {
        if (std::holds_alternative<ThinFilmFresnel>(fresnel)) continue; // counts as its base
        auto const* const wall = std::get_if<ThinWallFresnel>(&fresnel);
        if (wall && wall->film) continue; // likewise
        Vec3d sum(0);
        constexpr int n = 2000;
        for (int i = 0; i < n; ++i) {
            Color const r = reflectance(fresnel, std::sqrt((float(i) + 0.5f) / n)); // c dc
            sum += Vec3d(r.r, r.g, r.b) / n;
        }
        Color const mean = mean_reflectance(fresnel);
        double const error = std::holds_alternative<SchlickFresnel>(fresnel) ? 1e-3 : 0.02;
        EXPECT_NEAR(mean.r, sum.x, error) << name;
        EXPECT_NEAR(mean.g, sum.y, error) << name;
        EXPECT_NEAR(mean.b, sum.z, error) << name;
    }
}

TEST(Conductors, PresetsHaveTheirColours) {
    // Hue by order of the channels; silver is the brightest metal there is.
    auto const at_normal = [](std::string_view name) {
        for (ConductorPreset const& p : conductor_presets)
            if (p.name == name) return fresnel_conductor(1, p.conductor.eta, p.conductor.k);
        return Color();
    };
    Color const gold = at_normal("gold"), silver = at_normal("silver"), iron = at_normal("iron");
    EXPECT_GT(gold.r, gold.g);
    EXPECT_GT(gold.g, gold.b + 0.2f);
    EXPECT_GT(min_component(silver), 0.95f);
    EXPECT_GT(at_normal("copper").r, at_normal("copper").g + 0.2f);
    EXPECT_NEAR(at_normal("aluminium").g, 0.916, 0.003);
    EXPECT_NEAR(at_normal("chrome").g, 0.556, 0.003);
    EXPECT_NEAR(at_normal("brass").g, 0.782, 0.003);
    EXPECT_LT(max_component(iron) - min_component(iron), 0.05f);
}

TEST(Conductors, ArtistMappingGivesItsReflectivity) {
    Rng rng(21);
    for (int i = 0; i < 2000; ++i) {
        Color const r(rng.next() * 0.99f, rng.next() * 0.99f, rng.next() * 0.99f);
        Conductor const c = artist_conductor(r, Color(rng.next(), rng.next(), rng.next()));
        Color const back = fresnel_conductor(1, c.eta, c.k);
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(back[k], r[k], 2e-4);
    }
    EXPECT_TRUE(is_finite(artist_conductor(Color(1), Color(0.5f)).eta));
}

TEST(DielectricBoundary, LintTellsHowMuchWouldBeGained) {
    EXPECT_EQ(energy_gain(1.5f, 1.5f), 0);
    EXPECT_EQ(energy_gain(1.5f, 1.3f), 0);
    EXPECT_LT(energy_gain(2.64f, 1.75f), 0.03f);
    EXPECT_GT(energy_gain(1.01f, 2), 1 / 9.f);       // what they are apart at the normal
    EXPECT_GT(energy_gain(1 / 1.3f, 1 / 2.f), 0.5f); // total reflection sets in earlier
    EXPECT_GT(energy_gain(1.5f, 1 / 1.5f), 0.5f);
    EXPECT_LT(energy_gain(1 / 1.5f, 1 / 1.3f), 0.01f);
}

TEST(DielectricBoundary, NeverGivesMoreThanItReceives) {
    Rng rng(41);
    for (int i = 0; i < 20000; ++i) {
        float const eta = std::exp(2 * rng.next() - 1), c = rng.next();
        BoundaryOptions options{std::exp(2 * rng.next() - 1)};
        if (i % 2 == 0) options.film = {1000 * rng.next(), 1 + rng.next(), 1};
        float cos_t;
        float const fresnel = fresnel_dielectric(c, eta, cos_t);
        auto const [r, t] = split_light(options, eta, fresnel, c, cos_t);
        ASSERT_LE(max_component(r + t), 1.00001f);
        ASSERT_GE(min_component(r), 0);
        ASSERT_GE(min_component(t), 0);
    }
}

} // namespace
