// What the lints say, and that they are silent about what is meant.
#include <gtest/gtest.h>

#include "lights/lints.h"
#include "tests/support/scenes.h"

namespace weft::world {
namespace {

using namespace weft::testing;

std::string const kCamera = R"(<camera type="perspective" width="32" height="32" fov="45">
    <transform><lookat origin="0,1,-6" target="0,0,0" up="0,1,0"/></transform></camera>)";
std::string const kFloor = R"(<instance><shape type="rectangle"/><bsdf type="diffuse"/>
    <transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>)";
std::string const kLamp = R"(<light type="area"><instance><shape type="disk"/>
    <emission type="lambertian" emission="5"/>
    <transform><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>)";

std::vector<std::string> warnings(std::string const& contents, std::string const& folder = "",
                                  std::string const& integrator = "type=\"path\"") {
    auto const scene = make_scene(kCamera + contents, integrator, folder);
    return lint_warnings(*scene.stage, scene.job.integrator, scene.job.where);
}
/// The only thing said holds all of `parts`.
void expect_one(std::string const& contents, std::vector<std::string> const& parts) {
    auto const said = warnings(contents);
    ASSERT_EQ(said.size(), 1u) << contents;
    for (std::string const& part : parts)
        EXPECT_NE(said[0].find(part), std::string::npos) << said[0] << " lacks " << part;
}
void expect_none(std::string const& contents) {
    auto const said = warnings(contents);
    EXPECT_TRUE(said.empty()) << said[0];
}

std::string ball(std::string const& bsdf, std::string const& more = "") {
    return "<instance><shape type=\"sphere\"/>" + bsdf + more + "</instance>";
}
std::string point(std::string const& more) { return "<light type=\"point\" " + more + "/>"; }

TEST(Lints, AreSilentAboutGoodScenes) {
    expect_none(kFloor + ball("<bsdf type=\"conductor\"/>") + kLamp);
    expect_none(kFloor + ball("<bsdf type=\"diffuse\"/>") + point("position=\"1,3,-2\""));
    expect_none(kFloor + R"(<light type="envmap"><texture type="constant" value="0.5"/></light>)");
}

TEST(Lints, SolidsThatAreNot) {
    TemporaryFolder const folder;
    auto const block = [&](char const* name, std::string const& faces) {
        std::ofstream(folder / name) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" << faces;
        return "<instance id=\"thing\"><shape type=\"mesh\" filename=\"" + std::string(name) +
               "\"/>";
    };
    std::string const rest = "</instance>" + point("position=\"1,3,-2\""),
                      glass = R"(<bsdf type="roughdielectric"/>)";
    std::string const closed = block("closed.obj", "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"),
                      open = block("open.obj", "f 1 3 2\nf 1 2 4\nf 2 3 4\n"),
                      inwards = block("in.obj", "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
    auto const said = [&](std::string const& contents) {
        std::string all;
        for (std::string const& w : warnings(kFloor + contents + rest, folder.path()))
            all += w + "\n";
        return all;
    };
    EXPECT_EQ(said(closed + glass), "");
    EXPECT_EQ(said(open + "<bsdf type=\"diffuse\"/>"), "");
    EXPECT_NE(said(open + glass).find("3 of its 6 edges are open"), std::string::npos);
    EXPECT_EQ(said(open + R"(<bsdf type="dielectric" thinWalled="true"/>)"), "");
    EXPECT_NE(said(open + glass).find("'thing'"), std::string::npos) << said(open + glass);
    EXPECT_NE(said(open + R"(<medium type="homogeneous" absorption="1"/>)").find("has a medium"),
              std::string::npos);
    EXPECT_NE(said(inwards + glass).find("normals point inwards"), std::string::npos);
    // Rounding may part what is one vertex, as at the seam of what was turned on a lathe.
    std::ofstream(folder / "seam.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                          "v 1e-9 0 -1e-8\nv 0 1.00000005 0\n"
                                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 6 5 4\n";
    EXPECT_EQ(said("<instance><shape type=\"mesh\" filename=\"seam.obj\"/>" + glass), "");
    std::string holes = closed;
    holes.replace(holes.find(" id="), 0, " alpha=\"0.5\"");
    EXPECT_NE(said(holes + glass).find("partly transparent"), std::string::npos);
}

TEST(Lints, WhatSinglePrecisionHasLost) {
    TemporaryFolder const folder;
    std::ofstream(folder / "far.obj")
        << "v 4080928.25 0 0\nv 4080930.5 0 0\nv 4080929 1 0\nf 1 2 3\n";
    std::string const mesh =
        R"(<instance><shape type="mesh" filename="far.obj"/><bsdf type="diffuse"/></instance>)";
    auto const said = [&](std::string const& contents) {
        auto const all = warnings(contents, folder.path());
        return all.empty() ? "" : all[0];
    };
    EXPECT_NE(said(kFloor + kLamp + mesh).find("have steps of 0.49"), std::string::npos)
        << said(kFloor + kLamp + mesh);
    // A lamp that is as far from the camera as from the origin is where it should be.
    std::string const lamp = point("position=\"408201,3,4080928\"");
    EXPECT_EQ(said(kFloor + kLamp + lamp), "");
    auto const there = make_scene(
        R"(<camera type="perspective"><transform><translate x="408200" z="4080924"/></transform></camera>
           <instance><shape type="sphere"/><transform><translate x="408200" z="4080930"/></transform></instance>)" +
            lamp,
        "type=\"path\"");
    auto const all = lint_warnings(*there.stage, there.job.integrator, there.job.where);
    ASSERT_FALSE(all.empty());
    EXPECT_NE(all.back().find("steps are 0.49"), std::string::npos) << all.back();
}

TEST(Lints, NoLight) {
    expect_one(kFloor, {"test:1:1: ", "no light", "add a <light>"});
    EXPECT_TRUE(warnings(kFloor, "", "type=\"normal\"").empty());
}

TEST(Lints, ScenesWithoutSurfaces) {
    expect_none(R"(<light type="envmap"><texture type="constant" value="1"/></light>)");
}

TEST(Lints, LightsFartherThanRaysCanStart) {
    expect_none(kFloor + kLamp + point("position=\"1e20,0,0\""));
}

TEST(Lints, LightsWithoutPower) {
    expect_one(kFloor + kLamp + point("power=\"0\""),
               {"test:", "<light type=\"point\">", "gives no light", "or remove"});
    expect_one(kFloor + kLamp +
                   R"(<light type="envmap"><texture type="constant" value="0"/></light>)",
               {"<light type=\"envmap\">", "gives no light"});
    // Never to be sampled: that is on purpose.
    expect_none(kFloor + kLamp + point("power=\"0\" weight=\"0\""));
}

TEST(Lints, BeyondReason) {
    expect_one(kFloor + point("position=\"0,3,0\" power=\"1e12\""),
               {"<light type=\"point\">", "as the sun does", "weaker"});
    expect_one(kFloor + R"(<light type="directional" direction="0,1,0" intensity="1e8"/>)",
               {"<light type=\"directional\">", "as the sun does"});
    expect_none(kFloor + R"(<light type="directional" direction="0,1,0" intensity="1000"/>)");
}

TEST(Lints, LightsInsideOfGeometry) {
    std::string const inside = point("position=\"0,0.2,0\"");
    expect_one(
        kFloor + kLamp + ball("<bsdf type=\"diffuse\"/>") + inside,
        {"<light type=\"point\">", "is inside of the instance", "test:", "none of its light"});
    std::string const small = R"(<light type="area"><instance><shape type="sphere"/>
        <emission type="lambertian" emission="5"/><transform><scale value="0.3"/></transform></instance></light>)";
    expect_one(kFloor + kLamp + ball("<bsdf type=\"diffuse\"/>") + small,
               {"<light type=\"area\">", "is inside of"});
    // Glass, thin cloth and what is partly there let it out.
    expect_none(kFloor + kLamp + ball("<bsdf type=\"roughdielectric\"/>") + inside);
    expect_none(kFloor + kLamp +
                ball("<bsdf type=\"diffuse\"/>", "<float name=\"alpha\" value=\"0.5\"/>") + inside);
    // A room that is modelled by its outside, with the camera in it.
    expect_none(kFloor + inside +
                ball("<bsdf type=\"diffuse\"/>", "<transform><scale value=\"20\"/></transform>"));
    // Half in a surface, and beside one.
    expect_none(kFloor + kLamp + ball("<bsdf type=\"diffuse\"/>") + point("position=\"0,1.2,0\""));
}

TEST(Lints, PointsInMirrors) {
    std::string const lamp = point("position=\"1,3,-2\" power=\"60\"");
    expect_one(kFloor + lamp + ball("<bsdf type=\"conductor\"/>"),
               {"<light type=\"point\">", "has no size", "test:", "use an area light"});
    expect_one(kFloor + lamp + ball("<bsdf type=\"dielectric\"/>"), {"clear glass"});
    expect_none(kFloor + lamp + ball("<bsdf type=\"roughconductor\" roughness=\"0.3\"/>"));
    // Behind the camera nobody sees it.
    expect_none(
        kFloor + lamp +
        ball("<bsdf type=\"conductor\"/>", "<transform><translate z=\"-20\"/></transform>"));
}

TEST(Lints, LargeEmissiveMeshes) {
    TemporaryFolder const folder;
    write_ply(folder / "ball.ply", icosphere(7, false));
    auto const said =
        warnings(kFloor + R"(<light type="area"><instance><shape type="mesh" filename="ball.ply"/>
        <emission type="lambertian" emission="5"/></instance></light>)",
                 folder.path());
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("a light of 327680 triangles"), std::string::npos) << said[0];
}

} // namespace
} // namespace weft::world
