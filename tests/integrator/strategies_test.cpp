// Light sampling = BSDF sampling = both combined. The three strategies of `path` share almost
// nothing in how they find light, so what they agree on is likely to be right; for lights that no
// ray can meet they differ in their seeds alone.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

constexpr double kAlpha = 0.01; // for all tests of this file together

std::string const kCamera = R"(<camera type="perspective" width="8" height="8" fov="45">
    <transform><lookat origin="0,1.5,-5" target="0,0,0" up="0,1,0"/></transform></camera>)";
std::string const kFloor =
    R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.7,0.5,0.3"/>
    <transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>)";
std::string const kBall =
    R"(<instance><shape type="sphere"/><bsdf type="principled" baseColor="0.2,0.5,0.8" roughness="0.5" metallic="0.3"/></instance>)";
std::string const kRectangleLight = R"(<light type="area"><instance><shape type="rectangle"/>
    <emission type="lambertian" emission="3,4,5"/>
    <transform><scale value="1.5"/><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>)";

std::string const kEven = R"(<emission type="lambertian" emission="6,5,3"/>)";
std::string const kBrightSpot = R"(<emission type="lambertian"><texture name="emission" type="image"
    filename="spot.exr"/></emission>)";
/// With an emission where `more` has none.
std::string emitting(std::string const& more) {
    return (more.find("<emission") == std::string::npos ? kEven : "") + more;
}

struct Case {
    std::string name, contents;
    int samples = 4000;
    std::string attributes = "depth=\"6\"";
};

/// Names of a map with a dark sky, a bright spot and one black half, made in `folder`.
void write_sky(std::string const& path) {
    image::Image sky = image::make_image(16, 8, 3);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 3; ++c) sky.at(x, y, c) = 0.2f + 0.1f * float(c);
    for (int c = 0; c < 3; ++c) sky.at(5, 6, c) = 40;
    for (int c = 0; c < 3; ++c) sky.at(11, 5, c) = 20 - 5 * float(c);
    image::write_exr(path, sky);
}

/// Mostly dark, and black at one end.
void write_spot(std::string const& path) {
    image::Image spot = image::make_image(16, 16, 3);
    for (int y = 3; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < 3; ++c)
                spot.at(x, y, c) = x > 8 && x < 12 && y > 6 && y < 10 ? 20 - 5 * float(c) : 0.4f;
    image::write_exr(path, spot);
}

/// Small lights of all kinds, in all directions, from the floor up; `ball.ply` is in the folder.
std::string many_lights(int count) {
    Rng rng(77);
    auto number = [&](float low, float high) {
        return std::to_string(lerp(low, high, rng.next()));
    };
    auto vector = [&](float low, float high) {
        std::string const x = number(low, high), y = number(low, high);
        return x + "," + y + "," + number(low, high);
    };
    char const* const shapes[]{R"(type="rectangle")", R"(type="sphere")",
                               R"(type="mesh" filename="ball.ply")"};
    std::string text;
    for (int i = 0; i < count; ++i) {
        std::string const x = number(-3, 3), y = number(-0.8f, 3);
        std::string const at = x + "," + y + "," + number(-3, 3);
        if (i % 5 == 3) {
            text += "<light type=\"point\" position=\"" + at + "\" power=\"2,3,4\"/>";
        } else if (i % 5 == 4) {
            text += "<light type=\"spot\" position=\"" + at + "\" direction=\"" + vector(-1, 1) +
                    "\" angle=\"" + number(10, 200) + "\" falloff=\"40\" intensity=\"0.5\"/>";
        } else {
            text += "<light type=\"area\"><instance><shape " + std::string(shapes[i % 5]) +
                    "/><emission type=\"lambertian\" emission=\"" + vector(1, 20) +
                    "\"/><transform><scale value=\"" + number(0.03f, 0.2f) + "\"/><rotate axis=\"" +
                    vector(-1, 1) + "\" angle=\"" + number(0, 360) + "\"/><translate value=\"" +
                    at + "\"/></transform></instance></light>";
        }
    }
    return text;
}

std::vector<Case> cases(TemporaryFolder const& folder) {
    write_sky(folder / "sky.exr");
    write_spot(folder / "spot.exr");
    write_ply(folder / "ball.ply", icosphere(1, true));
    scene::Mesh inverted =
        icosphere(1, true); // wound clockwise; only its normals say where outside is
    for (auto& t : inverted.triangles) std::swap(t.v[1], t.v[2]);
    write_ply(folder / "inverted.ply", inverted);
    inverted.uvs.clear();
    write_ply(folder / "inverted_bare.ply", inverted);

    std::string const dim =
        R"(<light type="envmap"><texture type="constant" value="0.3,0.2,0.1"/></light>)";
    std::string const sky = R"(<light type="envmap"><texture type="image" filename="sky.exr"/>
        <transform><rotate axis="0,1,0" angle="70"/><rotate axis="1,0,0" angle="20"/></transform></light>)";
    auto mesh_light = [](std::string const& file, std::string const& transform,
                         std::string const& more = "", std::string const& attributes = "") {
        return "<light type=\"area\"" + attributes + R"(><instance><shape type="mesh" filename=")" +
               file + "\"/>" + emitting(more) + "<transform>" + transform +
               "</transform></instance></light>";
    };
    auto flat_light = [](std::string const& shape, std::string const& transform,
                         std::string const& attributes = "", std::string const& more = "") {
        return "<light type=\"area\"" + attributes + "><instance><shape type=\"" + shape + "\"/>" +
               emitting(more) + "<transform>" + transform + "</transform></instance></light>";
    };
    auto sphere_light = [](std::string const& transform, std::string const& more = "") {
        return R"(<light type="area"><instance><shape type="sphere"/>)" + emitting(more) +
               "<transform>" + transform + "</transform></instance></light>";
    };
    auto ball = [](std::string const& bsdf, std::string const& more = "") {
        return "<instance><shape type=\"sphere\"/>" + bsdf + more + "</instance>";
    };
    auto gel = [](std::string const& color, float height, float size,
                  std::string const& attributes = "") {
        return "<instance" + attributes +
               R"(><shape type="rectangle"/><bsdf type="transparent" transmittance=")" + color +
               "\"/><transform><scale value=\"" + std::to_string(size) +
               "\"/><rotate axis=\"1,0,0\" angle=\"-80\"/><translate y=\"" +
               std::to_string(height) + "\"/></transform></instance>";
    };
    std::string const up = "<translate x=\"1\" y=\"2.2\" z=\"-1\"/>";
    std::string const shear =
        "<matrix value=\"0.8,0.5,0,0, 0,0.7,0.3,0, 0.2,0,-0.9,0, 0,0,0,1\"/>"; // mirrors, too
    std::string const rough_glass = R"(<bsdf type="roughdielectric" roughness="0.5"/>)";
    std::string const fog =
        R"(<bsdf type="volume" scatter="0.9,0.6,0.3" absorption="0.05,0.1,0.2" phase="0.4"/>)";

    return {
        {"point", kFloor + kBall + R"(<light type="point" position="1,3,-2" power="60,50,40"/>)"},
        {"directional",
         kFloor + kBall + R"(<light type="directional" direction="1,2,-1" intensity="2,3,4"/>)"},
        {"spot",
         kFloor + kBall +
             R"(<light type="spot" position="1,3,-1" direction="-0.3,-1,0.3" angle="40" falloff="30" intensity="9"/>)"},
        {"sphere", kFloor + kBall + sphere_light("<scale value=\"0.8\"/>" + up)},
        {"rectangle", kFloor + kBall + kRectangleLight},
        {"mesh", kFloor + kBall + mesh_light("ball.ply", up)},
        {"two area lights and a dim sky",
         kFloor + kBall + dim + kRectangleLight +
             sphere_light("<scale value=\"0.6\"/><translate x=\"-2\" y=\"0.5\" z=\"-1\"/>")},
        {"many lights", kFloor + kBall + many_lights(60)},
        {"many lights and a sky in fog",
         kFloor + kBall + many_lights(30) + dim +
             R"(<medium type="homogeneous" absorption="0.02" scatter="0.1,0.15,0.2" phase="0.3"/>)"},
        {"many lights, several at once", kFloor + kBall + many_lights(60), 4000,
         "depth=\"6\" lightSamples=\"3\""},
        {"several lights at once and a sky in fog",
         kFloor + ball(rough_glass) + many_lights(30) + dim +
             R"(<light type="point" position="1,2,-1" radius="0.5" power="20"/>
                <medium type="homogeneous" absorption="0.02" scatter="0.1,0.15,0.2" phase="0.3"/>)",
         4000, "depth=\"6\" lightSamples=\"5\""},
        {"constant sky", kFloor + kBall + dim},
        {"sky with bright spots", kFloor + kBall + sky, 8000},
        {"sky over rough metal",
         kFloor +
             ball(R"(<bsdf type="roughconductor" roughness="0.4" reflectance="0.9,0.7,0.4"/>)") +
             sky,
         8000},
        {"rough metal under a rectangle",
         kFloor + ball(R"(<bsdf type="roughconductor" roughness="0.6" distribution="beckmann"/>)") +
             kRectangleLight},
        {"rough glass", kFloor + ball(rough_glass) + kRectangleLight + dim},
        {"sheared and mirrored sphere light", kFloor + kBall + sphere_light(shear + up)},
        {"sheared and mirrored rectangle light",
         kFloor + kBall +
             R"(<light type="area"><instance><shape type="rectangle"/><emission type="lambertian" emission="5"/><transform>
               <matrix value="1.5,0.6,0,0, 0,1.2,0,0, 0,0,-1,0, 0,0,0,1"/><rotate axis="1,0,0" angle="-90"/><translate y="2.5"/></transform></instance></light>)"},
        {"sheared and mirrored disk light",
         kFloor + kBall +
             flat_light("disk", shear + "<rotate axis=\"1,0,0\" angle=\"-90\"/>" + up)},
        {"disk light that touches the floor",
         kFloor + kBall +
             flat_light("disk", "<scale value=\"0.9\"/><translate x=\"1.2\" z=\"0.6\"/>")},
        {"disk light with holes, seen through the alpha filter",
         kFloor + kBall +
             flat_light(
                 "disk",
                 "<scale value=\"1.5\"/><rotate axis=\"1,0,0\" angle=\"90\"/><translate y=\"3\"/>",
                 "",
                 R"(<texture name="alpha" type="checkerboard" color0="0.3" color1="0.8" scale="2,5"/>)")},
        {"sheared disk light with a bright spot",
         kFloor + kBall +
             flat_light("disk", shear + "<rotate axis=\"1,0,0\" angle=\"-90\"/>" + up, "",
                        kBrightSpot)},
        {"rectangle light with a bright spot, near",
         kFloor + kBall +
             flat_light("rectangle",
                        "<rotate axis=\"0,1,0\" angle=\"180\"/><translate x=\"0.4\" z=\"1.2\"/>",
                        "", kBrightSpot)},
        {"sheared sphere light with a bright spot",
         kFloor + kBall + sphere_light(shear + up, kBrightSpot)},
        {"spread of a rectangle light",
         kFloor + kBall +
             flat_light(
                 "rectangle",
                 "<scale value=\"1.5\"/><rotate axis=\"1,0,0\" angle=\"90\"/><translate y=\"2\"/>",
                 " spread=\"50\" power=\"60\"")},
        {"spread of a sheared rectangle light and of a disk",
         kFloor + kBall +
             flat_light("rectangle", shear + "<rotate axis=\"1,0,0\" angle=\"-80\"/>" + up,
                        " spread=\"70\"") +
             flat_light("disk", "<rotate axis=\"0,1,0\" angle=\"60\"/><translate x=\"-2.5\"/>",
                        " spread=\"40\" power=\"30\"")},
        {"spread and power of a mesh light",
         kFloor + kBall + mesh_light("ball.ply", shear + up, "", " spread=\"60\" power=\"40\"")},
        {"mesh light of strongly uneven emission",
         kFloor + kBall + mesh_light("ball.ply", shear + up, kBrightSpot)},
        {"sheared and mirrored mesh light", kFloor + kBall + mesh_light("ball.ply", shear + up)},
        {"mesh light wound inwards", kFloor + kBall + mesh_light("inverted.ply", up)},
        {"textured mesh light wound inwards, without uvs",
         kFloor + kBall +
             mesh_light(
                 "inverted_bare.ply", up,
                 R"(<texture name="alpha" type="checkerboard" color0="0" color1="1" scale="2,1"/>)")},
        {"instanced mesh lights",
         kFloor + kBall + mesh_light("ball.ply", "<scale value=\"0.6\"/>" + up) +
             mesh_light("ball.ply", shear + "<translate x=\"-2\" y=\"1.5\" z=\"-1\"/>")},
        {"light with a texture and holes",
         kFloor + kBall +
             R"(<light type="area"><instance><shape type="rectangle"/>
               <emission type="lambertian"><texture name="emission" type="checkerboard" color0="1,0.2,0.2" color1="8" scale="3,2"/></emission>
               <texture name="alpha" type="checkerboard" color0="0.3" color1="0.8" scale="2,5"/>
               <transform><scale value="1.5"/><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>)"},
        {"half transparent sphere light",
         kFloor + kBall +
             sphere_light("<scale value=\"0.9\"/>" + up, "<float name=\"alpha\" value=\"0.5\"/>")},
        {"half transparent balls",
         kFloor + kRectangleLight +
             ball(R"(<bsdf type="diffuse" albedo="0.8"/>)",
                  "<float name=\"alpha\" value=\"0.5\"/>") +
             R"(<instance alpha="0.3"><shape type="mesh" filename="ball.ply"/><bsdf type="diffuse"/><transform><translate x="-1.5"/></transform></instance>)"},
        {"half transparent glass in fog",
         kFloor + R"(<instance alpha="0.5"><shape type="sphere"/>)" + rough_glass +
             "<transform><scale value=\"1.8\"/><translate y=\"1\"/></transform></instance>" +
             kRectangleLight +
             R"(<medium type="homogeneous" absorption="0.6,0.3,0" scatter="0.1"/>)"},
        {"emission on what is no surface",
         kFloor + kBall + dim + sphere_light("<scale value=\"0.8\"/>" + up, fog)},
        {"emitter filled with a medium",
         kFloor + kBall +
             sphere_light("<scale value=\"0.8\"/>" + up,
                          R"(<medium type="homogeneous" absorption="1"/>)")},
        {"fog in a ball", kFloor + ball(fog) + kRectangleLight + dim},
        {"light inside of a fog ball",
         kFloor + R"(<instance><shape type="sphere"/>)" + fog +
             R"(<transform><scale value="1.4"/></transform></instance>)" +
             sphere_light("<scale value=\"0.5\"/>")},
        {"fog everywhere",
         kFloor + kBall + R"(<light type="point" position="1,3,-2" power="60"/>)" +
             kRectangleLight +
             R"(<medium type="homogeneous" absorption="0.02" scatter="0.1,0.15,0.2" phase="-0.3"/>)"},
        {"light in rough glass that absorbs",
         kFloor + sphere_light("<scale value=\"0.5\"/>") + R"(<instance><shape type="sphere"/>)" +
             rough_glass + R"(<medium type="homogeneous" absorption="0.3,0.8,1.5"/>
               <transform><scale value="1.2"/></transform></instance>)"},
        {"half transparent fog", kFloor + kRectangleLight + dim +
                                     R"(<instance alpha="0.5"><shape type="sphere"/>)" + fog +
                                     "</instance>"},
        {"light in glass that fog of higher priority hides",
         kFloor + sphere_light("<scale value=\"0.5\"/>") + ball(R"(<bsdf type="dielectric"/>)") +
             R"(<instance priority="1"><shape type="sphere"/>)" + fog +
             R"(<transform><scale value="1.4"/></transform></instance>)"},
        {"light in glass within rough glass of higher priority",
         kFloor + sphere_light("<scale value=\"0.5\"/>") + ball(rough_glass) +
             R"(<instance priority="1"><shape type="sphere"/><bsdf type="roughdielectric" roughness="0.6" ior="1.2"/>
               <medium type="homogeneous" scatter="0.6,0.4,0.2"/><transform><scale value="1.3"/></transform></instance>)"},
        {"glowing glass that fog hides in part",
         kFloor + kBall + dim + sphere_light("<scale value=\"0.8\"/>" + up, rough_glass) +
             R"(<instance priority="1"><shape type="sphere"/>)" + fog +
             R"(<transform><translate x="1.5" y="1.8" z="-1.2"/></transform></instance>)"},
        {"gels between a lamp and a floor",
         kFloor + kBall + kRectangleLight + gel("0.9,0.3,0.1", 1.5f, 1)},
        {"stacked gels under a sky",
         kFloor + kBall + kRectangleLight + sky + gel("0.9,0.6,0.5", 1.5f, 2) +
             gel("0.3,0.8,0.9", 2, 2),
         8000},
        {"gel with holes over a delta light",
         kFloor + kBall + R"(<light type="point" position="1,3,-2" power="60,50,40"/>)" +
             gel("0.9,0.3,0.1", 1.5f, 2, " alpha=\"0.6\"")},
        {"few vertices under a lamp behind gels of part opacity",
         kFloor + kBall + kRectangleLight + gel("0.9,0.3,0.1", 1.6f, 2, " alpha=\"0.4\"") +
             gel("0.3,0.8,0.9", 2, 2),
         4000, "depth=\"2\""},
        {"ball of patterned gel in fog",
         kFloor + kRectangleLight +
             ball(R"(<bsdf type="transparent"><texture name="transmittance" type="checkerboard"
                 color0="0.2,0.9,0.4" color1="0.9,0.8,0.1" scale="4,3"/></bsdf>)") +
             R"(<medium type="homogeneous" absorption="0.02" scatter="0.1,0.15,0.2"/>)"},
        {"gel mixed with metal, of layers with holes",
         kFloor + kRectangleLight + dim +
             ball(
                 R"(<bsdf type="mix" amount="0.4"><bsdf type="transparent" transmittance="0.9,0.5,0.2"/>
                 <bsdf type="roughconductor" roughness="0.6"/></bsdf>)") +
             R"(<instance><shape type="rectangle"/><bsdf type="layered"><layer opacity="0.7">
               <bsdf type="disney" opacity="0.5" baseColor="0.8,0.3,0.1"/></layer>
               <layer><bsdf type="coat"><bsdf type="transparent"/></bsdf></layer></bsdf>
               <transform><rotate axis="1,0,0" angle="-70"/><translate y="1.6"/></transform></instance>)"},
        {"nested rough dielectrics",
         kFloor + kRectangleLight + dim +
             R"(<instance priority="2"><shape type="sphere"/><bsdf type="roughdielectric" roughness="0.4" ior="1.5"/></instance>
               <instance priority="1"><shape type="sphere"/><bsdf type="roughdielectric" roughness="0.3" ior="1.33"/>
               <medium type="homogeneous" absorption="0.2,0.5,1"/><transform><translate x="0.7"/></transform></instance>)"},
    };
}

/// (scene, test) pairs: two comparisons, three colours, four blocks.
constexpr int kTestsPerCase = 2 * 3 * 4;

TEST(Strategies, Agree) {
    TemporaryFolder const folder;
    auto const all = cases(folder);
    double const level = sidak(kAlpha, int(all.size()) * kTestsPerCase);
    for (Case const& c : all) {
        std::vector<Estimate> of[3];
        char const* const names[]{"mis", "nee", "bsdf"};
        for (int s = 0; s < 3; ++s) {
            std::string const integrator =
                "type=\"path\" strategy=\"" + std::string(names[s]) + "\" " + c.attributes;
            of[s] = block_estimates(make_scene(kCamera + c.contents, integrator, folder.path()),
                                    c.samples, 4, uint32_t(s));
        }
        for (size_t i = 0; i < of[0].size(); ++i)
            for (int s = 1; s < 3; ++s)
                EXPECT_GT(difference_p_value(of[0][i], of[s][i]), level)
                    << c.name << ", block " << i / 3 << ", channel " << i % 3 << ": mis "
                    << of[0][i].mean << " +- " << std::sqrt(of[0][i].variance) << ", " << names[s]
                    << ' ' << of[s][i].mean << " +- " << std::sqrt(of[s][i].variance);
    }
}

} // namespace
} // namespace weft::integrator
