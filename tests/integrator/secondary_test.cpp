// What stands in for a material where light was scattered before: camera rays and rays that only
// mirrors and clear glass turned see all of it, others the stand-in, and `fullMaterials` turns that
// off. Random numbers depend on the vertex alone, so pictures that should agree agree bit by bit.
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

std::string const kFull =
    R"(<bsdf type="disney" baseColor="0.8,0.2,0.1" roughness="0.4" clearcoat="0.5"/>)";
std::string const kSimple = R"(<bsdf type="diffuse" albedo="0.1,0.3,0.7"/>)";
std::string const kSky =
    R"(<light type="envmap"><texture type="ramptb" valuet="2,1.5,1" valueb="0.3"/></light>)";
/// Fog lets no light through from infinitely far away.
std::string const kLamp = R"(<light type="area"><instance><shape type="rectangle"/>
    <emission type="lambertian" emission="9,8,7"/>
    <transform><rotate axis="1,0,0" angle="90"/><translate y="3" z="-2"/></transform></instance></light>)";

/// What is meant to be seen, and the two materials that it should be like.
struct Standing {
    std::string name, bsdf, full, simple;
};

std::vector<Standing> standings() {
    auto const layered = [](std::string const& attributes) {
        return "<bsdf type=\"layered\"" + attributes + "><layer opacity=\"0.6\">" + kFull +
               "</layer><layer>" + kSimple + "</layer></bsdf>";
    };
    auto const coat = [](std::string const& attributes) {
        return "<bsdf type=\"coat\" tint=\"0.9,0.6,0.3\"" + attributes + ">" + kSimple + "</bsdf>";
    };
    auto const mix = [](std::string const& attributes) {
        return "<bsdf type=\"mix\" amount=\"0.7\"" + attributes + ">" + kSimple + kFull + "</bsdf>";
    };
    std::string const base = " secondary=\"base\"";
    return {
        {"secondary", "<bsdf type=\"secondary\">" + kFull + kSimple + "</bsdf>", kFull, kSimple},
        {"layered", layered(base), layered(""), kSimple},
        {"coat", coat(base), coat(""), kSimple},
        {"mix", mix(base), mix(""), kSimple}};
}

std::string camera(std::string const& origin, std::string const& target, int fov) {
    return "<camera type=\"perspective\" width=\"8\" height=\"8\" fov=\"" + std::to_string(fov) +
           "\"><transform><lookat origin=\"" + origin + "\" target=\"" + target +
           "\" up=\"0,1,0\"/></transform></camera>";
}
std::string ball(std::string const& bsdf) {
    return "<instance><shape type=\"sphere\"/>" + bsdf + "</instance>";
}
std::string square(std::string const& bsdf, std::string const& transform) {
    return "<instance><shape type=\"rectangle\"/>" + bsdf + "<transform>" + transform +
           "</transform></instance>";
}

std::vector<Color> picture(std::string const& contents, std::string const& attributes) {
    TestScene const scene = make_scene(contents, "type=\"path\" " + attributes);
    PixelRenderer const renderer(*scene.stage, scene.job.integrator, scene.job.sampler, 0);
    std::vector<Color> pixels;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (uint32_t s = 0; s < 32; ++s) pixels.push_back(renderer.sample({x, y}, s));
    return pixels;
}

/// Surroundings of a ball at the origin, and what their rays see of it.
struct Surroundings {
    std::string name, contents;
    bool full;
    std::string attributes = "depth=\"6\"";
};

std::vector<Surroundings> surroundings() {
    std::string const mirror = "<bsdf type=\"conductor\"/>", grey = "<bsdf type=\"diffuse\"/>";
    std::string const matte_metal = "<bsdf type=\"roughconductor\" roughness=\"0.5\"/>";
    std::string const fog = R"(<medium type="homogeneous" scatter="0.3"/>)";
    // The camera looks down on a floor beside the ball; it does not see the ball itself.
    std::string const aside = camera("3,3,0", "3,-1,0.01", 30);
    auto const floor = [](std::string const& bsdf) {
        return square(bsdf, "<scale value=\"6\"/><rotate axis=\"1,0,0\" angle=\"-90\"/>"
                            "<translate y=\"-1\"/>");
    };
    std::string const front = camera("0,0,-5", "0,0,0", 40);
    // Beside mirrors light that the ball scattered comes back, and meets it as a secondary ray.
    std::string const once = "depth=\"3\"";
    return {
        // A ball alone: the sky lights it, and its rays do not come back.
        {"camera", kSky + front, true},
        {"mirror", kSky + aside + square(mirror, R"(<scale value="2"/>
            <lookat origin="3,-1,0" target="1.4,1.1,0" up="0,0,1"/>)"),
         true, once},
        {"clear glass",
         kSky + front +
             square("<bsdf type=\"dielectric\" ior=\"1.3\"/>",
                    R"(<scale value="4"/><translate z="-2"/>)"),
         true, once},
        {"matte floor", kSky + aside + floor(grey), false},
        {"rough metal", kSky + aside + floor(matte_metal), false},
        {"fog", kLamp + camera("0,0,-3", "0,0,-9", 40) + fog, false},
    };
}

TEST(Secondary, StandsInWhereLightWasScattered) {
    for (Surroundings const& around : surroundings())
        for (Standing const& m : standings()) {
            auto const of = [&](std::string const& bsdf) {
                return picture(around.contents + ball(bsdf), around.attributes);
            };
            auto const seen = of(m.bsdf), full = of(m.full), simple = of(m.simple);
            EXPECT_TRUE(seen == (around.full ? full : simple)) << m.name << ", " << around.name;
            EXPECT_FALSE(full == simple) << around.name << " does not show the ball";
        }
}

/// Everything at once: a ball on a floor, seen by the camera and in a mirror, in thin fog.
TEST(Secondary, FullMaterialsLeaveNoTrace) {
    std::string const room =
        kLamp + camera("0,2,-6", "0,0,0", 50) + R"(<medium type="homogeneous" scatter="0.03"/>)" +
        square("<bsdf type=\"conductor\"/>", R"(<scale value="2"/><translate x="1" z="3"/>)");
    auto const scene = [&](std::string const& bsdf) {
        return room + ball(bsdf) +
               square(bsdf, "<scale value=\"6\"/><rotate axis=\"1,0,0\" angle=\"-90\"/>"
                            "<translate y=\"-1\"/>");
    };
    for (Standing const& m : standings()) {
        auto const full = picture(scene(m.full), "");
        EXPECT_TRUE(picture(scene(m.bsdf), "fullMaterials=\"true\"") == full) << m.name;
        EXPECT_FALSE(picture(scene(m.bsdf), "") == full) << m.name << " never stood in";
    }
}

} // namespace
} // namespace weft::integrator
