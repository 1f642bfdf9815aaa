// How wide lobes say that they are, against where they send light.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/lobes/configurations.h"

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::testing;

namespace {

TEST(Width, IsZeroForDeltaLobesAndOneForDiffuseOnes) {
    auto const check = [](auto const& c) {
        float const width = c.lobe.width();
        ScatteringKind const kind = c.lobe.flags().kind;
        if (is_delta(kind)) {
            EXPECT_EQ(width, 0) << c.name;
        } else if (is_diffuse(kind)) {
            EXPECT_EQ(width, 1) << c.name;
        } else {
            EXPECT_EQ(kind, ScatteringKind::Glossy) << c.name;
            EXPECT_GT(width, 0) << c.name;
            EXPECT_LE(width, 1) << c.name;
        }
        Bsdf bsdf({Frame(Vec3(0, 0, 1)), {0, 0, 1}});
        bsdf.add(Color(1), c.lobe);
        EXPECT_EQ(width_of(bsdf[0]), width) << c.name;
    };
    for_each_configuration<true>(check);
    for_each_configuration<false>(check);
}

TEST(Width, IsTheGreaterOfTwoWidths) {
    EXPECT_EQ((GgxReflection{{0.1f, 0.4f}}).width(), 0.4f);
    EXPECT_EQ((GgxReflection{{0.4f, 0.1f}}).width(), 0.4f);
    EXPECT_EQ(BeckmannDielectric({0.1f, 0.3f}, 1.5f).width(), 0.3f);
    EXPECT_NEAR(Clearcoat(0.02f).width(), 0.02f, 1e-7f);
}

/// The slope of the facet that sends light from the normal to `wi`; of a thin wall, of the one that
/// would reflect it.
float facet_slope(Vec3 wi, float eta) {
    if (eta == 1) wi.z = std::abs(wi.z);
    Vec3 const h = Vec3(0, 0, 1) + wi * (wi.z > 0 ? 1.f : eta);
    return std::sqrt(h.x * h.x + h.y * h.y) / std::abs(h.z);
}

/// Half of the facets of GGX are steeper than alpha, half of those of a clear coat, whose tail is
/// the longest, steeper than alpha's root. A fibre has no normal, so that hair is left out.
TEST(Width, TellsHowFarGlossyLobesSpread) {
    int tested = 0;
    for_each_configuration<true>([&]<class L>(Configuration<L> const& c) {
        if (std::is_same_v<L, Hair> || c.lobe.flags().kind != ScatteringKind::Glossy) return;
        Vec3 const wo(0, 0, 1);
        Rng rng(hash_bytes(c.name));
        std::vector<float> slopes;
        for (int i = 0; i < 20000; ++i) {
            Vec3 const wi = c.lobe.sample(wo, rng.next3());
            if (wi != Vec3(0)) slopes.push_back(facet_slope(wi, std::sqrt(c.lobe.eta_scale())));
        }
        if (slopes.empty()) return; // a black one
        std::sort(slopes.begin(), slopes.end());
        float const width = c.lobe.width();
        EXPECT_LE(slopes[slopes.size() / 2], 1.1f * std::sqrt(width)) << c.name;
        EXPECT_GE(slopes[slopes.size() * 9 / 10], 0.5f * width) << c.name;
        ++tested;
    });
    EXPECT_GT(tested, 50);
}

} // namespace
