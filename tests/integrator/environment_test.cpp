// Environments: that no light of a map is missed or counted twice, however it is filtered and
// turned, and how little noise sampling it leaves.
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

constexpr double kAlpha = 0.01; // for each test

std::string const kCamera = R"(<camera type="perspective" width="8" height="8" fov="45">
    <transform><lookat origin="0,1.5,-5" target="0,0,0" up="0,1,0"/></transform></camera>)";
std::string const kFloor =
    R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.7,0.5,0.3"/>
    <transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>)";
std::string const kBall =
    R"(<instance><shape type="sphere"/><bsdf type="principled" baseColor="0.2,0.5,0.8" roughness="0.5" metallic="0.3"/></instance>)";

/// A black map with one bright texel.
void write_pixel(std::string const& path, int width, int height, int x, int y, float value) {
    image::Image map = image::make_image(width, height, 3);
    for (int c = 0; c < 3; ++c) map.at(x, y, c) = value;
    image::write_exr(path, map);
}

std::string envmap(std::string const& texture, std::string const& transform = "") {
    return "<light type=\"envmap\">" + texture + "<transform>" + transform + "</transform></light>";
}
std::string file(std::string const& name, std::string const& attributes = "") {
    return "<texture name=\"texture\" type=\"image\" filename=\"" + name + "\" " + attributes +
           "/>";
}

struct Case {
    std::string name, light;
};

std::vector<Case> cases(TemporaryFolder const& folder) {
    write_pixel(folder / "high.exr", 16, 8, 3, 6, 40); // texture rows run downwards, v upwards
    write_pixel(folder / "seam.exr", 16, 8, 0, 5, 30);
    write_pixel(folder / "pole.exr", 8, 4, 2, 3, 40);
    write_pixel(folder / "other_pole.exr", 8, 4, 2, 0, 40);
    std::string const turn =
        R"(<rotate axis="0,1,0" angle="70"/><rotate axis="1,0,0" angle="20"/>)";
    std::string const place =
        R"(<texture name="texcoord" type="place2d" rotate="25" scale="0.6,0.9" offset="0.1,0.2"/>)";
    return {
        {"bilinear", envmap(file("high.exr"))},
        {"nearest", envmap(file("high.exr", "filter=\"nearest\""))},
        {"mipmap", envmap(file("high.exr", "filter=\"mipmap\""))},
        {"at the seam", envmap(file("seam.exr"), turn)},
        {"at the seam, clamped", envmap(file("seam.exr", "border=\"clamp\""), turn)},
        {"at the seam, nearest", envmap(file("seam.exr", "filter=\"nearest\""), turn)},
        {"at the pole", envmap(file("pole.exr"), turn)},
        {"at the pole, clamped", envmap(file("pole.exr", "border=\"clamp\""))},
        {"at the pole that repeats at the other", envmap(file("other_pole.exr"))},
        {"scaled by a node",
         envmap("<texture name=\"texture\" type=\"multiply\" in2=\"0.5,1,2\">" +
                std::string("<texture name=\"in1\" type=\"image\" filename=\"high.exr\"/>") +
                "</texture>")},
        {"moved by a node",
         envmap("<texture name=\"texture\" type=\"image\" filename=\"high.exr\">" + place +
                "</texture>")},
        {"moved by a node, nearest",
         envmap(
             "<texture name=\"texture\" type=\"image\" filename=\"high.exr\" filter=\"nearest\">" +
             place + "</texture>")},
        {"cut by a node",
         envmap("<texture name=\"texture\" type=\"smoothstep\" low=\"10\" high=\"12\">" +
                std::string("<texture name=\"in\" type=\"image\" filename=\"high.exr\"/>") +
                "</texture>")},
        {"mirrored", envmap(file("high.exr"), "<scale x=\"-1\" y=\"1\" z=\"1\"/>" + turn)},
        {"stretched and sheared",
         envmap(file("high.exr"),
                "<matrix value=\"2,0.5,0,0, 0,0.7,0.3,0, 0.2,0,-0.9,0, 0,0,0,1\"/>")},
    };
}

TEST(Environments, strategies_agree) {
    TemporaryFolder const folder;
    auto const all = cases(folder);
    double const level = sidak(kAlpha, int(all.size()) * 2 * 3 * 4);
    for (Case const& c : all) {
        std::vector<Estimate> of[3];
        char const* const names[]{"bsdf", "nee", "mis"};
        int const samples[]{12000, 3000, 3000};
        for (int s = 0; s < 3; ++s)
            of[s] = block_estimates(
                make_scene(kCamera + kFloor + kBall + c.light,
                           "type=\"path\" depth=\"3\" strategy=\"" + std::string(names[s]) + "\"",
                           folder.path()),
                samples[s], 4, uint32_t(s));
        for (size_t i = 0; i < of[0].size(); ++i)
            for (int s = 1; s < 3; ++s)
                EXPECT_GT(difference_p_value(of[0][i], of[s][i]), level)
                    << c.name << ", block " << i / 3 << ", channel " << i % 3 << ": bsdf "
                    << of[0][i].mean << " +- " << std::sqrt(of[0][i].variance) << ", " << names[s]
                    << ' ' << of[s][i].mean << " +- " << std::sqrt(of[s][i].variance);
    }
}

/// Of one sample per pixel, summed over the picture.
double variance_of(TestScene const& scene, int samples, uint32_t seed = 9) {
    double sum = 0;
    for (Estimate const& e : block_estimates(scene, samples, 4, seed)) sum += e.variance * samples;
    return sum;
}

double mean_of(TestScene const& scene, int samples, uint32_t seed = 9) {
    double sum = 0;
    auto const all = block_estimates(scene, samples, 4, seed);
    for (Estimate const& e : all) sum += e.mean;
    return sum / double(all.size());
}

std::string ball(std::string const& bsdf) {
    return "<instance><shape type=\"sphere\"/>" + bsdf + "</instance>";
}

std::string const kDiffuse = R"(<bsdf type="diffuse" albedo="0.6"/>)";
std::string const kGlossy = R"(<bsdf type="principled" baseColor="0.5" roughness="0.35"/>)";

// The sun of a map, four texels of it, against a directional light of its irradiance.
TEST(Environments, a_small_sun_is_as_quiet_as_a_directional_light) {
    TemporaryFolder const folder;
    int const w = 512, h = 256;
    image::Image map = image::make_image(w, h, 3);
    for (float& v : map.pixels) v = 1e-4f;
    double const pi = 3.14159265358979, texel = pi / h, theta = pi * (h - 190.0) / h;
    for (int y : {189, 190})
        for (int x : {100, 101})
            for (int c = 0; c < 3; ++c)
                map.at(x, y, c) = float(2 / (4 * texel * texel * std::sin(theta)));
    image::write_exr(folder / "sun.exr", map);
    double const phi = (0.5 - 101.0 / w) * 2 * pi;
    std::string const direction = std::to_string(std::sin(theta) * std::cos(phi)) + "," +
                                  std::to_string(std::cos(theta)) + "," +
                                  std::to_string(std::sin(theta) * std::sin(phi));
    std::string const parallel =
        "<light type=\"directional\" intensity=\"2\" direction=\"" + direction + "\"/>";
    for (std::string const& bsdf : {kDiffuse, kGlossy}) {
        std::string const things = kCamera + kFloor + ball(bsdf);
        std::string const path = "type=\"path\" depth=\"2\"";
        auto const disk = make_scene(things + parallel, path, folder.path());
        auto const sun = make_scene(things + envmap(file("sun.exr")), path, folder.path());
        int const samples = 2000;
        EXPECT_NEAR(mean_of(sun, samples) / mean_of(disk, samples), 1, 0.02);
        EXPECT_LT(variance_of(sun, samples), 1.05 * variance_of(disk, samples));
    }
}

// A sky that is bright at one side: what compensation is for.
TEST(Environments, compensation_lowers_the_noise) {
    TemporaryFolder const folder;
    image::Image sky = image::make_image(64, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                sky.at(x, y, c) =
                    1 + 30 * std::exp(-0.02f * float(square(x - 20) + square(y - 20)));
    image::write_exr(folder / "sky.exr", sky);
    for (std::string const& bsdf : {kDiffuse, kGlossy}) {
        TestScene scene = make_scene(kCamera + kFloor + ball(bsdf) + envmap(file("sky.exr")),
                                     "type=\"path\" depth=\"2\"", folder.path());
        double const compensated = variance_of(scene, 1000);
        scene.commit();
        double const full = variance_of(scene, 1000);
        EXPECT_LT(compensated, 0.9 * full);
    }
}

/// A closed room of half a unit of wall around [-2, 2] x [-1, 2] x [-2, 2], open where windows are:
/// one in the wall at x = -2, and a smaller one at z = 2 where asked for.
std::string room(bool second) {
    auto wall = [](std::string const& scale, std::string const& turn, std::string const& move) {
        return "<instance><shape type=\"rectangle\"/><bsdf type=\"diffuse\" "
               "albedo=\"0.7,0.6,0.5\"/><transform><scale " +
               scale + "/>" + turn + "<translate value=\"" + move + "\"/></transform></instance>";
    };
    std::string const to_x = R"(<rotate axis="0,1,0" angle="90"/>)",
                      to_y = R"(<rotate axis="1,0,0" angle="90"/>)";
    std::string walls =
        wall("x=\"2\" y=\"2\"", to_y, "0,-1,0") + wall("x=\"2\" y=\"2\"", to_y, "0,2,0") +
        wall("x=\"2\" y=\"1.5\"", "", "0,0.5,-2") + wall("x=\"2\" y=\"1.5\"", to_x, "2,0.5,0");
    // Around the window at x = -2: y in [0.2, 1.4], z in [-0.8, 0.8].
    walls += wall("x=\"2\" y=\"0.6\"", to_x, "-2,-0.4,0") +
             wall("x=\"2\" y=\"0.3\"", to_x, "-2,1.7,0") +
             wall("x=\"0.6\" y=\"0.6\"", to_x, "-2,0.8,1.4") +
             wall("x=\"0.6\" y=\"0.6\"", to_x, "-2,0.8,-1.4");
    if (!second) return walls + wall("x=\"2\" y=\"1.5\"", "", "0,0.5,2");
    // x in [0.5, 1.5], all of the height.
    return walls + wall("x=\"1.25\" y=\"1.5\"", "", "-0.75,0.5,2") +
           wall("x=\"0.25\" y=\"1.5\"", "", "1.75,0.5,2");
}

/// The local z axis points into the room.
std::string const kPortal = R"(<portal><transform><scale x="0.8" y="0.6"/>
    <rotate axis="0,1,0" angle="90"/><translate value="-2,0.8,0"/></transform></portal>)";
std::string const kSecondPortal = R"(<portal><transform><scale x="0.5" y="1.5"/>
    <rotate axis="0,1,0" angle="180"/><translate value="1,0.5,2"/></transform></portal>)";
std::string const kRoomCamera = R"(<camera type="perspective" width="8" height="8" fov="80">
    <transform><lookat origin="1.7,0.8,-1.7" target="-0.3,0.1,0.6" up="0,1,0"/></transform></camera>)";

void write_sky(std::string const& path) {
    image::Image sky = image::make_image(64, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                sky.at(x, y, c) = (y < 16 ? 0.2f : 1 + 0.3f * float(c)) +
                                  20 * std::exp(-0.1f * float(square(x - 2) + square(y - 21)));
    image::write_exr(path, sky);
}

TEST(Portals, strategies_agree) {
    TemporaryFolder const folder;
    write_sky(folder / "sky.exr");
    std::string const turn = R"(<rotate axis="1,1,0" angle="15"/>)";
    auto const light = [&](std::string const& portals, std::string const& attributes = "") {
        return "<light type=\"envmap\" " + attributes + ">" + file("sky.exr") + "<transform>" +
               turn + "</transform>" + portals + "</light>";
    };
    struct RoomCase {
        std::string name, contents, without;
    };
    std::string const ball =
        R"(<instance><shape type="sphere"/><bsdf type="principled" roughness="0.4"/>
        <transform><scale value="0.6"/><translate value="-0.4,-0.4,0.3"/></transform></instance>)";
    std::vector<RoomCase> const all{
        {"a window", room(false) + ball + light(kPortal), room(false) + ball + light("")},
        {"two windows", room(true) + ball + light(kPortal + kSecondPortal),
         room(true) + ball + light("")},
        {"a window that is no portal", room(true) + ball + light(kPortal),
         room(true) + ball + light("")},
        {"without shadows, which light sampling alone finds",
         room(false) + ball + light(kPortal, "castShadows=\"false\""),
         room(false) + ball + light("", "castShadows=\"false\"")},
        {"a sky with its sun",
         room(true) + ball +
             R"(<light type="sky" elevation="35" azimuth="-70" sunSize="8" sunIntensity="0.02"
             skyIntensity="0.05">)" +
             kPortal + kSecondPortal + "</light>",
         room(true) + ball +
             R"(<light type="sky" elevation="35" azimuth="-70" sunSize="8" sunIntensity="0.02"
             skyIntensity="0.05"/>)"},
    };
    double const level = sidak(kAlpha, int(all.size()) * 3 * 3 * 4);
    for (RoomCase const& c : all) {
        std::vector<Estimate> of[4];
        char const* const names[]{"bsdf", "nee", "mis", "mis"};
        int const samples[]{8000, 3000, 3000, 3000};
        for (int s = 0; s < 4; ++s)
            of[s] = block_estimates(
                make_scene(kRoomCamera + (s == 3 ? c.without : c.contents),
                           "type=\"path\" depth=\"3\" strategy=\"" + std::string(names[s]) + "\"",
                           folder.path()),
                samples[s], 4, uint32_t(s));
        for (size_t i = 0; i < of[0].size(); ++i)
            for (int s = 1; s < 4; ++s)
                EXPECT_GT(difference_p_value(of[0][i], of[s][i]), level)
                    << c.name << ", block " << i / 3 << ", channel " << i % 3 << ": bsdf "
                    << of[0][i].mean << " +- " << std::sqrt(of[0][i].variance) << ", " << names[s]
                    << (s == 3 ? " without portals " : " ") << of[s][i].mean << " +- "
                    << std::sqrt(of[s][i].variance);
    }
}

/// From beside the window, which it does not see.
std::string const kWallCamera = R"(<camera type="perspective" width="8" height="8" fov="60">
    <transform><lookat origin="-1.7,0.8,-1.7" target="1.5,-0.2,1" up="0,1,0"/></transform></camera>)";

TEST(Portals, lower_the_noise) {
    TemporaryFolder const folder;
    write_sky(folder / "sky.exr");
    std::string const path = "type=\"path\" depth=\"2\"";
    auto const variance = [&](std::string const& portals) {
        return variance_of(make_scene(kWallCamera + room(false) + "<light type=\"envmap\">" +
                                          file("sky.exr") + portals + "</light>",
                                      path, folder.path()),
                           1000);
    };
    EXPECT_LT(variance(kPortal), 0.5 * variance(""));
}

} // namespace
} // namespace weft::integrator
