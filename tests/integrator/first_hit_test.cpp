// The integrators that draw a property of the first hit draw it of the surface that paths of the
// same samples scatter at first: denoisers are told by them which edges are real.
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

std::string const kCamera = R"(<camera type="perspective" width="8" height="8" fov="30">
    <transform><lookat origin="0,0,-4" target="0,0,0" up="0,1,0"/></transform></camera>
    <light type="envmap"><texture type="constant" value="1"/></light>)";
std::string const kWall =
    R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.2,0.5,0.1"/>
    <transform><scale value="20,20,1"/><rotate axis="0,1,0" angle="180"/><translate z="3"/></transform></instance>)";
Color const kWallAlbedo(0.2f, 0.5f, 0.1f);

/// A ball of radius 1 in the middle of the picture.
std::string ball(std::string const& bsdf, std::string const& attributes = "") {
    return "<instance " + attributes + "><shape type=\"sphere\"/>" + bsdf + "</instance>";
}
/// A pane of the same size before it.
std::string pane(std::string const& bsdf, std::string const& attributes = "") {
    return "<instance " + attributes + "><shape type=\"rectangle\"/>" + bsdf +
           "<transform><rotate axis=\"0,1,0\" angle=\"180\"/><translate "
           "z=\"-2\"/></transform></instance>";
}
std::string const kRed = R"(<bsdf type="diffuse" albedo="0.9,0.1,0.1"/>)";
std::string const kFog = R"(<bsdf type="volume" absorption="0.05" scatter="0.05"/>)";
std::string const kGel =
    R"(<bsdf type="mix" amount="0.5"><bsdf type="transparent" transmittance="0.8"/><bsdf type="diffuse" albedo="0.9,0.1,0.1"/></bsdf>)";

struct Case {
    char const* name;
    std::string contents;
};
std::vector<Case> cases() {
    return {
        {"a wall", kWall},
        {"an instance that hides from the camera", kWall + ball(kRed, "visibleToCamera=\"false\"")},
        {"fog", kWall + ball(kFog)},
        {"a ball in fog", kWall + ball(kFog) + R"(<instance><shape type="sphere"/>)" + kRed +
                              R"(<transform><scale value="0.5"/></transform></instance>)"},
        {"partial opacity", kWall + ball(kRed, "alpha=\"0.5\"")},
        {"a mixture of gel and paint", kWall + pane(kGel)},
        {"a holdout", kWall + ball(kRed, "holdout=\"true\"")},
        {"a holdout that lets light through", kWall + pane(kGel, "holdout=\"true\"")},
        {"a shadow catcher", kWall + ball(kRed, "shadowCatcher=\"true\"")},
        {"glass around paint", kWall + ball(R"(<bsdf type="roughdielectric" roughness="0.4"/>)")},
    };
}

/// Calls f(pixel, sample) for all that the tests look at.
template <class F>
void for_each_sample(F const& f) {
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (uint32_t s = 0; s < 16; ++s) f(Vec2i(x, y), s);
}

PixelRenderer renderer_of(TestScene const& scene) {
    return {*scene.stage, scene.job.integrator, scene.job.sampler, 7};
}

/// Three numbers that the path has told of its first surface.
Vec3 told(film::SampleRecord const& record, film::Aov aov) {
    film::Layout const& layout = record.layout();
    float const* const from =
        scene::info_of(aov).how == scene::Accumulation::Nearest
            ? &(*record.nearest())[size_t(film::kNearestOffsets[size_t(aov)])]
            : &record.values()[size_t(layout.offset(aov) - layout.first_recorded())];
    return {from[0], from[1], from[2]};
}

TEST(FirstHit, IsThatOfPaths) {
    film::Layout const layout(
        std::vector{film::Aov::albedo, film::Aov::normal, film::Aov::position}, {});
    film::SceneTags const tags;
    film::SampleRecord record(layout, tags);
    for (Case const& c : cases()) {
        TestScene const path = make_scene(kCamera + c.contents),
                        albedo = make_scene(kCamera + c.contents, "type=\"albedo\""),
                        normal =
                            make_scene(kCamera + c.contents, "type=\"normal\" remap=\"false\""),
                        distance =
                            make_scene(kCamera + c.contents, "type=\"aov\" variable=\"distance\"");
        PixelRenderer const paths = renderer_of(path), albedos = renderer_of(albedo),
                            normals = renderer_of(normal), distances = renderer_of(distance);
        Vec3 const eye(0, 0, -4);
        int surfaces = 0;
        for_each_sample([&](Vec2i p, uint32_t s) {
            paths.sample(p, s, &record);
            bool const met = record.nearest() != nullptr;
            surfaces += met;
            Vec3 const rgb = met ? told(record, film::Aov::albedo) : Vec3(0);
            ASSERT_EQ(albedos.sample(p, s), Color(rgb.x, rgb.y, rgb.z)) << c.name;
            Color const n = normals.sample(p, s);
            float const cosine =
                met ? dot(Vec3(n.r, n.g, n.b), told(record, film::Aov::normal)) : 0;
            ASSERT_NEAR(std::abs(cosine), met ? 1 : 0, 1e-5f) << c.name;
            float const way = met ? length(told(record, film::Aov::position) - eye) : 0;
            ASSERT_NEAR(distances.sample(p, s).g, way, 1e-5f) << c.name;
        });
        EXPECT_GT(surfaces, 100) << c.name;
    }
}

TEST(FirstHit, HidesWhatTheCameraDoesNotSee) {
    TestScene const scene =
        make_scene(kCamera + kWall + ball(kRed, "visibleToCamera=\"false\""), "type=\"albedo\"");
    PixelRenderer const renderer = renderer_of(scene);
    for_each_sample([&](Vec2i p, uint32_t s) { ASSERT_EQ(renderer.sample(p, s), kWallAlbedo); });
}

TEST(FirstHit, IsSeenThroughFog) {
    // The ray in the middle passes 2 units of fog: what does not reach the wall has no surface.
    TestScene const scene = make_scene(kCamera + kWall + ball(kFog), "type=\"albedo\"");
    PixelRenderer const renderer = renderer_of(scene);
    int reached = 0;
    int const count = 4096;
    for (int s = 0; s < count; ++s) {
        Color const c = renderer.sample({s % 2 + 3, s / 2 % 2 + 3}, uint32_t(s));
        ASSERT_TRUE(c == kWallAlbedo || c == Color(0));
        reached += c == kWallAlbedo;
    }
    // Pixels of the middle are up to 0.27 units off it, where the way is shorter by at most 4%.
    double const expected = std::exp(-0.1 * 2);
    EXPECT_NEAR(double(reached) / count, expected, 0.01 + 4 * std::sqrt(expected / 4 / count));
}

} // namespace
} // namespace weft::integrator
