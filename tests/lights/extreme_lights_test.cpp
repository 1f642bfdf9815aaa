// Lights of numbers that nobody means: what is sampled of them, and of the lights beside them, is
// finite all the same.
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace weft::lights {
namespace {

using namespace weft::testing;

TestScene scene_with(std::string const& light) {
    return make_scene(R"(<camera type="perspective" width="8" height="8"/>
        <instance><shape type="sphere"/><bsdf type="diffuse"/></instance>)" +
                      light);
}

/// Samples light at a point, and says how many samples gave any.
int lit_samples(TestScene const& scene, Vec3 const& ref) {
    Rng rng(1);
    int lit = 0;
    for (int i = 0; i < 1000; ++i) {
        float const u = rng.next(), v = rng.next(), w = rng.next();
        scene.stage->lights().sample(*scene.world, {ref}, {u, v, w}, [&](LightSample const& s) {
            EXPECT_TRUE(std::isfinite(s.pdf) && is_finite(s.radiance)) << s.pdf;
            lit += !is_black(s.radiance);
        });
    }
    return lit;
}

TEST(ExtremeLights, ASunWithoutSolidAngleIsADirection) {
    for (char const* angle : {"1e-30", "1e-12", "1e-5", "0.001", "0.5"}) {
        auto const scene = scene_with("<light type=\"directional\" direction=\"0,1,0\" angle=\"" +
                                      std::string(angle) + "\" intensity=\"2\"/>");
        EXPECT_EQ(lit_samples(scene, Vec3(0, 5, 0)), 1000) << angle;
    }
}

TEST(ExtremeLights, APowerBeyondFloatsLeavesTheOthersTheirSamples) {
    auto const scene = scene_with(R"(<light type="point" position="0,4,0" intensity="1e38"/>
        <light type="point" position="0,-4,0" intensity="10"/>)");
    EXPECT_EQ(lit_samples(scene, Vec3(0, 3, 0)), 1000);
    EXPECT_TRUE(std::isfinite(scene.stage->lights().info(0).power));
}

} // namespace
} // namespace weft::lights
