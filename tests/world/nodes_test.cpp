// Nodes that need the surface, in all the places that ask: materials, opacity, emission, lights.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "tests/support/scenes.h"

namespace weft::world {
namespace {

using namespace weft::testing;

std::string const kCamera = R"(<camera type="perspective" width="4" height="4"/>)";

std::string error_of(std::string const& contents, std::string const& folder = "") {
    try {
        make_scene(contents, "type=\"path\"", folder);
        return "no error";
    } catch (InputError const& e) {
        return e.what();
    }
}

/// A square of two triangles in z = 0 with colours and a property.
void write_square(std::string const& path) {
    std::ofstream(path) << R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
property uchar alpha
property double heat
element face 2
property list uchar int vertex_indices
end_header
-1 -1 0 255 0 0 255 0
1 -1 0 0 255 0 51 1
1 1 0 0 0 255 255 2
-1 1 0 51 51 51 255 7
3 0 1 2
3 0 2 3
)";
}

std::string emitter(std::string const& node) {
    return kCamera +
           "<instance><shape type=\"mesh\" filename=\"square.ply\"/>"
           "<emission type=\"lambertian\">" +
           node + "</emission></instance>";
}

/// Emission of the square at (x, y).
Color emission_at(World const& world, float x, float y) {
    Ray ray;
    ray.origin = {x, y, 5}, ray.direction = {0, 0, -1};
    Hit const hit = world.intersect(ray);
    EXPECT_TRUE(hit);
    return world.emission(world.surface(ray, hit), {0, 0, 1});
}

TEST(Nodes, VertexPropertiesAreInterpolated) {
    TemporaryFolder const folder;
    write_square(folder / "square.ply");
    auto scene = [&](std::string const& attributes) {
        return make_scene(
            emitter("<texture name=\"emission\" type=\"geompropvalue\" " + attributes + "/>"),
            "type=\"path\"", folder.path());
    };
    // (0.5, -0.5) is a half of vertex 1, a quarter of 0 and of 2.
    Color const c = emission_at(*scene("geomprop=\"color\"").world, 0.5f, -0.5f);
    EXPECT_NEAR(c.r, 0.25, 1e-5);
    EXPECT_NEAR(c.g, 0.5, 1e-5);
    EXPECT_NEAR(c.b, 0.25, 1e-5);
    Color const s =
        emission_at(*scene("geomprop=\"color\" colorSpace=\"srgb_texture\"").world, 0.5f, -0.5f);
    EXPECT_NEAR(s.g, srgb_to_linear(0.5f), 1e-5);
    EXPECT_NEAR(emission_at(*scene("geomprop=\"heat\" output=\"float\"").world, 0.5f, -0.5f).g, 1,
                1e-5);
    EXPECT_NEAR(emission_at(*scene("geomprop=\"alpha\" output=\"float\"").world, 0.5f, -0.5f).g,
                0.6, 1e-5);
}

TEST(Nodes, AnUnknownVertexPropertyIsAnError) {
    TemporaryFolder const folder;
    write_square(folder / "square.ply");
    std::string const message =
        error_of(emitter("<texture name=\"emission\" type=\"geompropvalue\" geomprop=\"heta\"/>"),
                 folder.path());
    EXPECT_NE(message.find("found 'heta' (did you mean 'heat'?)"), std::string::npos) << message;
    EXPECT_EQ(message.find("test:1:"), 0u) << message;
}

TEST(Nodes, EnvironmentsHaveNoSurface) {
    std::string const message = error_of(
        kCamera +
        "<light type=\"envmap\"><texture type=\"noise3d\"/></light><shape type=\"sphere\"/>");
    EXPECT_NE(message.find("depend on uv alone"), std::string::npos) << message;
    EXPECT_EQ(error_of(kCamera + "<light type=\"envmap\"><texture type=\"noise2d\"/></light>"
                                 "<shape type=\"sphere\"/>"),
              "no error");
}

/// Opaque where world x > 0, by a chain of nodes.
std::string const kHalf = R"(<texture name="alpha" type="smoothstep" low="0" high="0">
    <texture name="in" type="extract"><texture name="in" type="position" space="world"/></texture>
</texture>)";

TEST(Nodes, OpacityMayDependOnPosition) {
    TemporaryFolder const folder;
    write_ply(folder / "ball.ply", icosphere(3, false));
    std::string const ball = "<shape type=\"mesh\" filename=\"ball.ply\"/>";
    std::string const second = "<instance>" + ball +
                               "<transform><translate y=\"50\"/></transform>"
                               "</instance>";
    std::string const squeeze = "<transform><scale x=\"1\" y=\"0.7\" z=\"0.9\"/></transform>";
    for (std::string const& shape :
         {std::string("<shape type=\"sphere\"/>"), "<shape type=\"sphere\"/>" + squeeze, ball,
          ball + squeeze, std::string("<shape type=\"rectangle\"/>")})
        for (std::string const& more : {std::string(), second}) {
            SCOPED_TRACE(shape + more);
            auto const scene =
                make_scene(kCamera + "<instance>" + shape + kHalf + "</instance>" + more,
                           "type=\"path\"", folder.path());
            Rng rng(1);
            for (int i = 0; i < 500; ++i) {
                Ray ray;
                ray.origin = {rng.next() * 1.2f - 0.6f, rng.next() * 0.6f - 0.3f, 4};
                ray.direction = {0, 0, -1};
                if (std::abs(ray.origin.x) < 1e-3f) continue;
                bool const there = ray.origin.x > 0;
                EXPECT_EQ(bool(scene.world->intersect(ray, rng.next_uint())), there);
                EXPECT_EQ(scene.world->visibility(ray).g, there ? 0.f : 1.f);
            }
        }
}

/// What light sampling finds is what rays find.
TEST(Nodes, SampledLightsEmitWhatRaysSee) {
    TemporaryFolder const folder;
    write_square(folder / "square.ply");
    write_ply(folder / "ball.ply", icosphere(2, true));
    std::string const by_place = "<texture name=\"emission\" type=\"multiply\">"
                                 "<texture name=\"in1\" type=\"worleynoise3d\"/>"
                                 "<texture name=\"in2\" type=\"facingratio\"/></texture>";
    std::string const by_vertex =
        "<texture name=\"emission\" type=\"geompropvalue\" geomprop=\"color\"/>";
    std::string const squeeze =
        "<transform><scale x=\"1\" y=\"-0.7\" z=\"0.9\"/><rotate axis=\"1,2,0\" angle=\"25\"/>"
        "</transform>";
    struct Case {
        std::string shape, emission;
    };
    for (Case const& c : {Case{"type=\"sphere\"", by_place}, Case{"type=\"rectangle\"", by_place},
                          Case{"type=\"mesh\" filename=\"ball.ply\"", by_place},
                          Case{"type=\"mesh\" filename=\"square.ply\"", by_place},
                          Case{"type=\"mesh\" filename=\"square.ply\"", by_vertex}}) {
        SCOPED_TRACE(c.shape + c.emission);
        auto const scene = make_scene(kCamera + "<light type=\"area\"><instance><shape " + c.shape +
                                          "/>" + squeeze + "<emission type=\"lambertian\">" +
                                          c.emission + "</emission></instance></light>",
                                      "type=\"path\"", folder.path());
        World const& world = *scene.world;
        Rng rng(3);
        int compared = 0;
        for (int i = 0; i < 1000; ++i) {
            Vec3 const ref = (rng.next3() - Vec3(0.5f)) * 8.f;
            lights::LightSample s;
            scene.stage->lights().sample(world, {ref}, rng.next3(),
                                         [&](lights::LightSample const& only) { s = only; });
            if (!(s.pdf > 0)) continue;
            Ray ray;
            ray.origin = ref, ray.direction = s.wi;
            Hit const hit = world.intersect(ray);
            if (!hit || std::abs(hit.t - s.distance) > 1e-3f * s.distance) continue;
            auto const point = world.surface(ray, hit);
            Color const seen = world.emission(point, -s.wi);
            if (std::abs(dot(point.ng, s.wi)) < 0.05f) continue; // where rounding is magnified
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], s.radiance[k], 2e-3);
            ++compared;
        }
        EXPECT_GT(compared, 100);
    }
}

TEST(Nodes, InstancesDiffer) {
    auto const scene =
        make_scene(kCamera + "<emission id=\"e\" type=\"lambertian\"><texture name=\"emission\" "
                             "type=\"instancerandom\"/></emission>"
                             "<instance><shape type=\"sphere\"/><ref id=\"e\"/></instance>"
                             "<instance><shape type=\"sphere\"/><ref id=\"e\"/>"
                             "<transform><translate x=\"5\"/></transform></instance>");
    float const a = emission_at(*scene.world, 0, 0).r, b = emission_at(*scene.world, 5, 0).r;
    EXPECT_NE(a, b);
    EXPECT_EQ(a, emission_at(*scene.world, 0.5f, 0).r);
}

TEST(Nodes, NodeIsAnotherWordForTexture) {
    auto const scene = make_scene(
        kCamera +
        "<node id=\"n\" type=\"constant\" value=\"3\"/><instance><shape type=\"rectangle\"/>"
        "<emission type=\"lambertian\"><node name=\"emission\" type=\"add\" in2=\"1\">"
        "<ref name=\"in1\" id=\"n\"/></node></emission></instance>");
    EXPECT_EQ(emission_at(*scene.world, 0, 0), Color(4));
}

} // namespace
} // namespace weft::world
