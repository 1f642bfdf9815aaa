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
            twice += scene.world->visibility(ray) < 0.5f;
            ++rays;
        }
    }
    for (Vec3 const& p : ball.positions) {
        Ray const ray{Vec3(10, 0, 0), p};
        twice += scene.world->visibility(ray) < 0.5f;
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
                wrong += scene.world->visibility(ray) != 0x1p-10f;
                met += bool(scene.world->intersect(ray, rng.next_uint()));
            }
            EXPECT_EQ(wrong, 0) << "of " << rays << " at scale " << scale << ", gap " << gap;
            double const expected = 1 - 0x1p-10,
                         sigma = std::sqrt(expected * (1 - expected) / rays);
            EXPECT_GE(normal_tail((met / rays - expected) / sigma), sidak(0.01, 4)) << met;
        }
}

} // namespace
} // namespace weft::world
