// Scenes far from their origin look as they do at it.
#include <gtest/gtest.h>

#include "scene/camera_relative.h"
#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

/// A camera, lights with places of their own, shapes, and a ball that stands by itself and in a
/// group. `east` and `north`: of all of it, whole numbers.
std::string contents(int east, int north) {
    auto const at = [&](double x, double y, double z) {
        return std::to_string(double(east) + x) + "," + std::to_string(y) + "," +
               std::to_string(double(north) + z);
    };
    std::string const move = "<translate value=\"" + at(0, 0, 0) + "\"/>";
    return R"(<camera type="perspective" width="16" height="12" fov="50"><transform>
            <lookat origin="2,2,5" target="0,0.5,0" up="0,1,0"/>)" +
           move + R"(</transform></camera>
        <light type="point" position=")" +
           at(1, 3, 2) + R"(" intensity="20"/>
        <light type="spot" position=")" +
           at(-2, 2, 1) + R"(" direction="1,-1,-0.5" intensity="10"/>
        <light type="area"><instance><shape type="disk"/><emission type="lambertian" emission="4"/>
            <transform><rotate axis="1,0,0" angle="90"/><translate y="3"/>)" +
           move + R"(</transform></instance></light>
        <instance><shape type="rectangle"/><bsdf type="diffuse"><texture name="albedo" type="checkerboard" scale="4"/></bsdf>
            <transform><rotate axis="1,0,0" angle="-90"/><scale value="5"/>)" +
           move + R"(</transform></instance>
        <instance id="ball"><shape type="sphere"/><bsdf type="disney" baseColor="0.7,0.2,0.1" roughness="0.3"/>
            <transform><translate y="0.6"/>)" +
           (east ? move : "") + R"(</transform></instance>
        <instance><shape type="group"><ref id="ball"/></shape>
            <transform><scale value="0.4"/>)" +
           // The group takes the ball where the scene has it.
           (east ? "<translate value=\"" + std::to_string(-0.4 * east) + ",0," +
                       std::to_string(-0.4 * north) + "\"/>"
                 : "") +
           "<translate x=\"1.5\" z=\"1\"/>" + move + "</transform></instance>";
}

TEST(FarAway, ThePictureIsThatAtTheOrigin) {
    auto const here = make_scene(contents(0, 0), "type=\"path\" depth=\"4\"");
    EXPECT_EQ(here.stage->world().origin(), Vec3d(0, 0, 0));
    auto const near = block_estimates(here, 200, 4, 1);
    for (auto const& [east, north] : {std::pair(408201, 4080928), std::pair(-9000000, 1)}) {
        auto const there = make_scene(contents(east, north), "type=\"path\" depth=\"4\"");
        EXPECT_LT(length(there.stage->world().origin() - Vec3d(east, 0, north)), 30);
        auto const far = block_estimates(there, 200, 4, 2);
        double const level = sidak(1e-3, int(near.size()));
        for (size_t i = 0; i < near.size(); ++i)
            EXPECT_GT(difference_p_value(near[i], far[i]), level)
                << east << ", block " << i / 3 << ": " << near[i].mean << " and " << far[i].mean;
    }
}

TEST(FarAway, ACameraAloneDoesNotMoveTheScene) {
    auto const scene = make_scene(
        R"(<camera type="perspective" width="4" height="4"><transform><translate z="-5000"/></transform></camera>
           <instance><shape type="sphere"/></instance>)",
        "type=\"path\"");
    EXPECT_EQ(scene.stage->world().origin(), Vec3d(0, 0, 0));
}

TEST(FarAway, PositionsAreThoseOfTheScene) {
    // A wall shines by how far east it is, at a place that floats can tell.
    auto const scene_at = [](int east) {
        std::string const x = std::to_string(east);
        return make_scene(
            R"(<camera type="orthographic" width="4" height="4" scale="4"><transform><translate x=")" +
                x + R"(" z="-4"/></transform></camera><instance><shape type="rectangle"/>
                <emission type="lambertian"><texture name="emission" type="convert"><texture name="in" type="position" space="world"/></texture></emission>
                <transform><rotate axis="0,1,0" angle="180"/><scale value="9"/><translate x=")" +
                x + R"("/></transform></instance>)",
            "type=\"path\"");
    };
    for (int east : {100, 1 << 20})
        EXPECT_NEAR(block_estimates(scene_at(east), 4, 4, 1)[0].mean, east, 4);
}

} // namespace
} // namespace weft::integrator
