// Bad samples, and the path of one sample told again.
#include <gtest/gtest.h>

#include "session/render.h"
#include "session/replay.h"
#include "tests/support/scenes.h"

namespace weft::session {
namespace {

using namespace weft::testing;

std::string const kContents = R"(
    <camera type="perspective" width="40" height="30" fov="50"><transform><lookat origin="0,1,-4" target="0,0,0" up="0,1,0"/></transform></camera>
    <instance id="floor"><shape type="rectangle"/><bsdf id="tiles" type="diffuse" albedo="0.5"/><transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>
    <instance id="ball"><shape type="sphere"/><bsdf id="clear" type="dielectric"/></instance>
    <light type="area" group="key"><instance id="lamp"><shape type="rectangle"/><emission type="lambertian" emission="5"/><transform><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>
    <light type="envmap"><texture type="constant" value="0.3"/></light>)";

TEST(Replay, GivesTheSampleOfTheRender) {
    TestScene const scene = make_scene(kContents);
    RenderOptions options;
    options.limits.spp = 1;
    options.picture.seed = 3;
    image::Image const image = render(*scene.stage, scene.job, options).image;
    for (Vec2i const& pixel : {Vec2i(20, 15), Vec2i(5, 28), Vec2i(0, 0)}) {
        Replay const r = replay(*scene.stage, scene.job, {pixel, 0, 3, 1});
        for (int c = 0; c < 3; ++c) EXPECT_EQ(r.value[c], image.at(pixel.x, pixel.y, c));
        Color sum;
        for (film::PathEvent const& e : r.events)
            if (e.kind == film::PathEvent::Kind::Light) sum += e.value;
        EXPECT_NEAR(sum.g, r.value.g, 1e-5f);
    }
}

TEST(Replay, TellsWhatThePathMet) {
    TestScene const scene = make_scene(kContents);
    std::string all;
    for (uint32_t sample = 0; sample < 64; ++sample)
        all += replay_text(*scene.stage, replay(*scene.stage, scene.job, {{20, 15}, sample, 0, 0}));
    for (char const* words :
         {"camera at (0, 1, -4)", "1 surface of 'ball', material 'clear'", "mirror reflection",
          "clear transmission", "surface of 'floor', material 'tiles'", "diffuse reflection",
          "on 'lamp' of the group 'key', sampled, over", "background towards", "\n= "})
        EXPECT_NE(all.find(words), std::string::npos) << words;
}

TEST(Replay, OfNoPixelIsAnError) {
    TestScene const scene = make_scene(kContents);
    EXPECT_THROW(replay(*scene.stage, scene.job, {{40, 0}}), InputError);
    EXPECT_THROW(replay(*scene.stage, scene.job, {{0, -1}}), InputError);
    EXPECT_THROW(replay(*make_scene(kContents, "type=\"camera\"").stage,
                        make_scene(kContents, "type=\"camera\"").job, {{0, 0}}),
                 InputError);
}

TEST(BadSamples, OfNegativeLightNeverEnter) {
    TemporaryFolder const folder;
    image::Image paint = image::make_image(2, 1, 3);
    for (int c = 0; c < 3; ++c) {
        paint.at(0, 0, c) = 0.5f;
        paint.at(1, 0, c) = -0.5f;
    }
    image::write_exr(folder / "paint.exr", paint);
    TestScene const scene =
        make_scene(R"(
        <camera type="orthographic" width="16" height="8" scale="1"/>
        <instance><shape type="rectangle"/><bsdf type="diffuse"><texture name="albedo" type="image" filename="paint.exr" filter="nearest"/></bsdf><transform><rotate axis="0,1,0" angle="180"/><translate z="1"/></transform></instance>
        <light type="directional" direction="0,0,-1"/>)",
                   "type=\"path\" depth=\"2\"", folder.path(), "type=\"sobol\" count=\"4\"");
    RenderOptions options;
    options.picture.aovs = {film::Aov::direct_diffuse};
    RenderResult const r = render(*scene.stage, scene.job, options);
    EXPECT_EQ(r.bad_samples, 16u * 8 * 4 / 2);
    ASSERT_EQ(r.first_bad_samples.size(), 4u);
    BadSample const& bad = r.first_bad_samples[0];
    EXPECT_LT(bad.value.r, -0.1f);
    Replay const again = replay(*scene.stage, scene.job, {bad.pixel, bad.sample, 0, 0});
    EXPECT_EQ(again.value, bad.value);
    EXPECT_NE(replay_text(*scene.stage, again).find("(negative)"), std::string::npos);
    for (float v : r.film.image().pixels) ASSERT_GE(v, 0);
    // Integrators that draw directions have negative numbers that are no light.
    TestScene const normals = make_scene(
        R"(<camera type="perspective" width="8" height="8"/><instance><shape type="sphere"/><transform><translate z="3"/></transform></instance>)",
        "type=\"normal\" remap=\"false\"", "", "type=\"sobol\" count=\"1\"");
    EXPECT_EQ(render(*normals.stage, normals.job, {}).bad_samples, 0u);
}

} // namespace
} // namespace weft::session
