// Surfaces of partial opacity: what is met twice counts once, and what lies close together each for
// itself.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "tests/support/scenes.h"

namespace weft::world {
namespace {

using namespace weft::testing;

std::string const kCamera = R"(<camera type="perspective" width="4" height="4"/>)";

TEST(Opacity, CountsASharedEdgeOnce) {
    // Rays along the diagonal of a square and through the vertices of a ball, where the kernel may
    // find two triangles or more.
    TemporaryFolder const folder;
    scene::Mesh const ball = icosphere(2, false);
    write_ply(folder / "ball.ply", ball);
    auto const scene =
        make_scene(kCamera + R"(<instance alpha="0.5"><shape type="rectangle"/></instance>
        <instance alpha="0.5"><shape type="mesh" filename="ball.ply"/><transform><translate x="10"/></transform></instance>)",
                   "type=\"path\"", folder.path());
    int twice = 0, rays = 0;
    for (int i = -50; i <= 50; ++i) {
        float const s = float(i) / 51;
        for (Vec3 const& from : {Vec3(s, s, -3), Vec3(0, 0, -3)}) {
            Ray const ray{from, normalize(Vec3(s, s, 0) - from)};
            twice += scene.world->visibility(ray).g < 0.5f;
            ++rays;
        }
    }
    for (Vec3 const& p : ball.positions) {
        Ray const ray{Vec3(10, 0, 0), p};
        twice += scene.world->visibility(ray).g < 0.5f;
        ++rays;
    }
    EXPECT_EQ(twice, 0) << "of " << rays;
}

TEST(Opacity, CountsEveryCardOfAStackOnce) {
    // Near the diagonals, whose width grows with the cards: the kernel asks about all the cards
    // before it comes back to the first, at distances that rounding tells apart.
    for (char const* scale : {"1", "100000"})
        for (char const* gap : {"0.1", "0.00001"}) {
            std::string cards;
            for (int i = 0; i < 10; ++i)
                cards += "<instance alpha=\"0.5\"><shape type=\"rectangle\"/><transform><scale "
                         "value=\"" +
                         std::string(scale) + "\"/><translate z=\"" +
                         std::to_string(i * std::stod(gap)) + "\"/></transform></instance>";
            auto const scene = make_scene(kCamera + cards);
            Rng rng(3);
            int wrong = 0;
            int const rays = 20000;
            double met = 0;
            for (int i = 0; i < rays; ++i) {
                float const s = rng.next() - 0.5f;
                Vec3 const to = Vec3(s, s, 0) + (rng.next3() - Vec3(0.5f)) * 1e-3f;
                Vec3 const from = Vec3(rng.next() - 0.5f, rng.next() - 0.5f, -3);
                Ray const ray{from, normalize(to - from)};
                wrong += scene.world->visibility(ray).g != 0x1p-10f;
                met += bool(scene.world->intersect(ray, rng.next_uint()));
            }
            EXPECT_EQ(wrong, 0) << "of " << rays << " at scale " << scale << ", gap " << gap;
            double const expected = 1 - 0x1p-10,
                         sigma = std::sqrt(expected * (1 - expected) / rays);
            EXPECT_GE(normal_tail((met / rays - expected) / sigma), sidak(0.01, 4)) << met;
        }
}

TEST(Visibility, IsTheProductOfWhatGelsLetThrough) {
    auto const card = [](std::string const& bsdf, float z, std::string const& attributes = "") {
        return "<instance" + attributes + "><shape type=\"rectangle\"/>" + bsdf +
               "<transform><translate z=\"" + std::to_string(z) + "\"/></transform></instance>";
    };
    auto const gel = [](std::string const& color) {
        return "<bsdf type=\"transparent\" transmittance=\"" + color + "\"/>";
    };
    Ray const ray{{0.3f, 0.2f, -5}, {0, 0, 1}};
    auto const through = [&](std::string const& contents) {
        return make_scene(kCamera + contents).world->visibility(ray);
    };
    auto const expect = [](Color const& found, Color const& expected, char const* what) {
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 1e-6) << what;
    };
    std::string const warm = gel("0.8,0.4,0.2"), cold = gel("0.5,0.5,1");
    expect(through(card(warm, 0)), {0.8f, 0.4f, 0.2f}, "one");
    expect(through(card(warm, 0) + card(cold, 1)), {0.4f, 0.2f, 0.2f}, "two");
    expect(through(card(warm, 0, " alpha=\"0.5\"")), {0.9f, 0.7f, 0.6f}, "with opacity");
    expect(through("<instance><shape type=\"sphere\"/>" + warm + "</instance>"),
           {0.64f, 0.16f, 0.04f}, "both sides of a ball");
    expect(through(card(warm, 0) + card("<bsdf type=\"diffuse\"/>", 1)), Color(0), "opaque");
    expect(through(card(gel("0"), 0)), Color(0), "black");
    expect(
        through(card(
            "<bsdf type=\"mix\" amount=\"0.25\">" + warm + "<bsdf type=\"diffuse\"/></bsdf>", 0)),
        {0.6f, 0.3f, 0.15f}, "mixed");
    expect(through(card("<bsdf type=\"layered\"><layer opacity=\"0.5\"><bsdf type=\"disney\" "
                        "opacity=\"0.6\"/></layer><layer>" +
                            warm + "</layer></bsdf>",
                        0)),
           {0.6f, 0.4f, 0.3f}, "layered");
    expect(
        through(card(R"(<bsdf type="transparent"><texture name="transmittance" type="checkerboard"
               color0="0.2" color1="0.2" scale="4,3"/></bsdf>)",
                     0)),
        Color(0.2f), "patterned");
}

TEST(Visibility, AsksWhatSecondaryRaysSee) {
    auto const scene =
        make_scene(kCamera + R"(<instance><shape type="rectangle"/><bsdf type="secondary">
            <bsdf type="transparent" transmittance="0.5"/><bsdf type="diffuse"/></bsdf></instance>)");
    Ray const ray{{0.3f, 0.2f, -5}, {0, 0, 1}};
    EXPECT_EQ(scene.world->visibility(ray), Color(0.5f));
    EXPECT_EQ(scene.world->visibility(ray, {.secondary = true}), Color(0));
}

} // namespace
} // namespace weft::world
