// A fibre's lobe lies around the fibre wherever it is in a list of lobes.
#include <gtest/gtest.h>

#include "tests/shading/material_bench.h"

namespace weft::shading {
namespace {

using testing::MaterialBench;
using testing::towards;

scene::Layer layer_of(scene::MaterialId bsdf, float opacity) {
    scene::Layer layer;
    layer.bsdf = bsdf;
    layer.opacity = {opacity};
    return layer;
}

struct HairInLayers : ::testing::Test {
    MaterialBench bench;
    scene::MaterialId hair = bench.add(scene::Hair{.roughness = {0.4f}});
    scene::MaterialId clay = bench.add(scene::Diffuse{.albedo = {Color(0.6f, 0.5f, 0.4f)}});

    /// Directions all around, to where light goes and from where it comes.
    template <class F>
    void for_each_pair(F&& f) const {
        Rng rng(4);
        for (int i = 0; i < 2000; ++i)
            f(square_to_sphere(rng.next2()), square_to_sphere(rng.next2()));
    }
};

TEST_F(HairInLayers, IsTheSameAlone) {
    auto const whole = bench.add(scene::Mix{.bsdfs = {hair, hair}, .amount = {0.3f}});
    scene::Layered layered;
    layered.layers = {bench.add(layer_of(hair, 1)), bench.add(layer_of(clay, 1))};
    auto const top = bench.add(layered);
    bench.compile();
    for_each_pair([&](Vec3 const& wo, Vec3 const& wi) {
        auto const alone = bench.shade(hair, wo).bsdf.eval(wo, wi);
        for (scene::MaterialId const other : {whole, top}) {
            auto const inside = bench.shade(other, wo).bsdf.eval(wo, wi);
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(inside.f[k], alone.f[k], 1e-6f + 1e-4f * alone.f[k]);
            EXPECT_NEAR(inside.pdf, alone.pdf, 1e-6f + 1e-4f * alone.pdf);
        }
    });
}

TEST_F(HairInLayers, MixesAsValuesDo) {
    auto const mixed = bench.add(scene::Mix{.bsdfs = {hair, clay}, .amount = {0.25f}});
    bench.compile();
    for_each_pair([&](Vec3 const& wo, Vec3 const& wi) {
        Color const expected = 0.75f * bench.shade(hair, wo).bsdf.eval(wo, wi).f +
                               0.25f * bench.shade(clay, wo).bsdf.eval(wo, wi).f;
        Color const found = bench.shade(mixed, wo).bsdf.eval(wo, wi).f;
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 1e-6f + 1e-4f * expected[k]);
    });
}

TEST_F(HairInLayers, SamplesFollowTheDensity) {
    auto const mixed = bench.add(scene::Mix{.bsdfs = {hair, clay}, .amount = {0.5f}});
    bench.compile();
    Vec3 const wo = towards(0.7f);
    auto const shading = bench.shade(mixed, wo);
    // The power by samples and that by even directions are one.
    auto const sampled = testing::sampled_power(shading.bsdf, wo, 40'000, 5);
    auto const even = testing::evaluated_power(shading.bsdf, wo, 400'000, 6);
    EXPECT_NEAR(sampled.mean, even.mean, 3.3 * std::sqrt(sampled.variance + even.variance));
}

} // namespace
} // namespace weft::shading
