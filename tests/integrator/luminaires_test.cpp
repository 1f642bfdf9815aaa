// Lamps of some size, disks at infinity and measured lamps in whole pictures: light sampling = BSDF
// sampling = both combined; and irradiance, penumbra and units against closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "base/blackbody.h"
#include "io/ies.h"
#include "lights/photometric_light.h"
#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

constexpr double kAlpha = 0.01; // for each test of this file

std::string const kCamera = R"(<camera type="perspective" width="8" height="8" fov="45">
    <transform><lookat origin="0,1.5,-5" target="0,0,0" up="0,1,0"/></transform></camera>)";
std::string const kFloor =
    R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.7,0.5,0.3"/>
    <transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>)";
std::string const kBall =
    R"(<instance><shape type="sphere"/><bsdf type="principled" baseColor="0.2,0.5,0.8" roughness="0.4" metallic="0.3"/></instance>)";
std::string const kIes = std::string(WEFT_SOURCE_DIR) + "/tests/io/ies/lm63_2002.ies";

struct Case {
    std::string name, contents;
    int samples = 3000;
};

std::vector<Case> cases() {
    std::string const lamp =
        R"(<light type="point" position="1,1.6,-1" radius="0.5" power="30,20,10"/>)";
    std::string const gobo =
        R"(<texture name="gobo" type="checkerboard" color0="0.1" color1="1,0.5,0.2" scale="5,3"/>)";
    return {
        {"ball", kFloor + kBall + lamp},
        {"ball in the floor",
         kFloor + kBall +
             R"(<light type="point" position="1.5,-0.9,-1" radius="0.6" power="20"/>)"},
        {"spot ball", kFloor + kBall +
                          R"(<light type="spot" position="1,3,-1" direction="-0.3,-1,0.2" angle="30"
            falloff="60" falloffShape="smooth" radius="0.4" power="40,30,30"/>)"},
        {"linear spot ball", kFloor + kBall +
                                 R"(<light type="spot" position="1,3,-1" direction="-0.3,-1,0.2"
            angle="20" falloff="40" radius="0.7" intensity="20"/>)"},
        {"gobo ball", kFloor + kBall +
                          R"(<light type="spot" position="0,3,-1" direction="0,-1,0.2" angle="40"
            falloff="40" radius="0.3" power="40,30,30">)" +
                          gobo + "</light>"},
        {"ies ball", kFloor + kBall + R"(<light type="ies" filename=")" + kIes +
                         R"(" position="1,3,-1" radius="0.4" exposure="5" temperature="3000"/>)"},
        {"several balls, and one twice",
         kFloor + kBall + lamp + lamp +
             R"(<light type="point" position="-1.5,0.5,-1" radius="0.2" power="5,9,5"/>
            <light type="point" position="-1.3,0.5,-1.2" radius="0.3" power="5"/>
            <light type="point" position="0,4,0" power="9"/>)"},
        {"ball in fog",
         R"(<medium type="homogeneous" absorption="0.02,0.05,0.1" scatter="0.15,0.1,0.05" phase="0.4"/>)" +
             kFloor + kBall + lamp,
         6000},
        {"ball behind a veil",
         kFloor + kBall + lamp +
             R"(<instance alpha="0.5"><shape type="sphere"/><bsdf type="diffuse"/>
            <transform><scale value="0.9"/><translate x="1" y="1.6" z="-1"/></transform></instance>)"},
        {"sun",
         kFloor + kBall +
             R"(<light type="directional" direction="0.4,1,-0.5" angle="12" intensity="3,2.5,2"/>)"},
        {"wide sun",
         kFloor + kBall +
             R"(<light type="directional" direction="0.4,1,-0.5" angle="120" intensity="2"/>
            <light type="point" position="-2,1,0" power="10"/>)"},
    };
}

TEST(Luminaires, AllStrategiesAgree) {
    auto const all = cases();
    double const level = sidak(kAlpha, int(all.size()) * 2 * 12);
    for (Case const& c : all) {
        SCOPED_TRACE(c.name);
        auto render = [&](char const* strategy, uint32_t seed) {
            auto const scene =
                make_scene(kCamera + c.contents,
                           std::string("type=\"path\" depth=\"6\" strategy=\"") + strategy + "\"");
            return block_estimates(scene, c.samples, 4, seed);
        };
        auto const mis = render("mis", 1);
        for (char const* strategy : {"nee", "bsdf"}) {
            auto const other = render(strategy, 2);
            for (size_t i = 0; i < mis.size(); ++i)
                EXPECT_GT(difference_p_value(mis[i], other[i]), level)
                    << strategy << " " << i << ": " << other[i].mean << " for " << mis[i].mean;
        }
    }
}

/// A camera that sees little more than the origin, on the plane y = 0 of albedo 1: the mean
/// radiance is the irradiance over pi.
std::string const kOrigin =
    R"(<camera type="perspective" width="2" height="2" fov="0.01"><transform>
    <lookat origin="-6,3,0" target="0,0,0" up="0,1,0"/></transform></camera>
    <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="1"/><transform><scale value="50"/>
    <rotate axis="1,0,0" angle="-90"/></transform></instance>)";

/// Irradiance at the origin by direct light alone.
Estimate irradiance(std::string const& contents, int samples = 4000,
                    std::string const& folder = "") {
    auto const scene = make_scene(kOrigin + contents, "type=\"path\" depth=\"2\"", folder);
    Estimate e = block_estimates(scene, samples, 2, 9).at(0);
    e.mean *= std::numbers::pi;
    e.variance *= std::numbers::pi * std::numbers::pi;
    return e;
}

/// Expected values of means that may have no noise but rounding and the size of the pixels.
void expect_irradiance(Estimate const& e, double expected, double level, char const* what) {
    double const beyond = std::max(0.0, std::abs(e.mean - expected) - 2e-4 * expected);
    EXPECT_GT(e.variance > 0 ? normal_tail(beyond / std::sqrt(e.variance)) : beyond == 0, level)
        << what << ": " << e.mean << " for " << expected;
}

TEST(Luminaires, IrradianceIsThatOfTheirCentres) {
    double const pi = std::numbers::pi, level = sidak(kAlpha, 5);
    double const d2 = 1 + 4 + 0.25, cosine = 2 / std::sqrt(d2);
    expect_irradiance(
        irradiance(R"(<light type="point" position="1,2,0.5" radius="0.8" power="12"/>)"),
        12 / (4 * pi) / d2 * cosine, level, "ball");
    expect_irradiance(
        irradiance(R"(<light type="point" position="1,2,0.5" radius="0.01" intensity="2"/>)"),
        2 / d2 * cosine, level, "small ball");
    expect_irradiance(
        irradiance(R"(<light type="directional" direction="1,2,0.5" angle="20" intensity="3"/>)"),
        3 * cosine, level, "disk");
    expect_irradiance(
        irradiance(R"(<light type="directional" direction="1,2,0.5" angle="0.53" intensity="3"/>)"),
        3 * cosine, level, "sun");
    // Inside of a ball the radiance I / (pi r^2) comes from all around: half of it is above.
    expect_irradiance(
        irradiance(R"(<light type="point" position="0.1,0.2,0" radius="1" intensity="2"/>)"), 2,
        level, "inside");
}

TEST(Luminaires, SpotsHaveThePowerThatTheyAreGiven) {
    double const pi = std::numbers::pi, level = sidak(kAlpha, 4);
    auto cap = [&](double degrees) { return 2 * pi * (1 - std::cos(degrees * pi / 180)); };
    auto spot = [](std::string const& more) {
        return R"(<light type="spot" position="0,2,0" direction="0,-1,0" )" + more + "</light>";
    };
    expect_irradiance(irradiance(spot(R"(angle="40" falloff="0" power="5">)")), 5 / cap(20) / 4,
                      level, "hard");
    double const smooth = 0.5 * (cap(20) + cap(35));
    expect_irradiance(
        irradiance(spot(R"(angle="40" falloff="30" falloffShape="smooth" power="5">)")),
        5 / smooth / 4, level, "smooth");
    // An image takes away, it does not make the rest brighter. White in the middle.
    expect_irradiance(irradiance(spot(R"(angle="40" falloff="30" falloffShape="smooth" power="5">
        <texture name="gobo" type="ramplr" valuel="0.2" valuer="0.6"/>)")),
                      0.4 * 5 / smooth / 4, level, "gobo");
    expect_irradiance(
        irradiance(spot(R"(angle="40" falloff="0" power="5" unit="photometric" gobo="0.5">)")),
        0.5 / 683 * 5 / cap(20) / 4, level, "lumens");
}

TEST(Luminaires, MeasuredLampsHaveTheirCandela) {
    double const level = sidak(kAlpha, 3);
    std::string const lamp = R"(<light type="ies" filename=")" + kIes + R"(" )";
    // 400 cd straight down, 300 cd at 30 degrees, 683 lm/W.
    expect_irradiance(irradiance(lamp + R"(position="0,2,0"/>)"), 400. / 683 / 4, level, "down");
    double const cosine = std::cos(std::numbers::pi / 6);
    expect_irradiance(irradiance(lamp + R"(position="1,1.7320508,0" radius="0.001"/>)"),
                      300. / 683 / 4 * cosine, level, "aside");
    expect_irradiance(
        irradiance(lamp + R"(position="0,2,0" direction="0,-0.5,0.8660254" tint="2"/>)"),
        2 * 100. / 683 / 4, level, "turned");
}

TEST(Luminaires, FluxOfAFileIsItsLumens) {
    // The figure's file gives the flux of the formula that it was made by, for one lamp without
    // losses; straight lines between its angles make up for the rest.
    scene::Photometry const lamp =
        io::read_ies(std::string(WEFT_SOURCE_DIR) + "/scenes/figures/wings.ies");
    EXPECT_NEAR(lights::luminous_flux(lamp) / double(lamp.lamp_lumens), 1, 0.01);
}

/// A half plane with its edge over the x axis, at height 1, hides a part of the sun's disk.
TEST(Luminaires, PenumbraOfADiskIsItsVisiblePart) {
    double const pi = std::numbers::pi, radius = 4 * pi / 180;
    double const level = sidak(kAlpha, 7);
    for (double shift : {-0.9, -0.6, -0.25, 0.0, 0.3, 0.7, 1.1}) {
        // The edge is seen at this angle from the zenith, as a share of the sun's radius.
        double const edge = std::tan(shift * radius);
        std::string const blocker =
            R"(<instance><shape type="rectangle"/><transform><translate x="1"/><scale value="20"/>
            <rotate axis="1,0,0" angle="90"/><translate x=")" +
            std::to_string(edge) + R"(" y="1"/></transform></instance>)";
        Estimate const e = irradiance(
            R"(<light type="directional" direction="0,1,0" angle="8" intensity="2"/>)" + blocker,
            20'000);
        // Of a flat disk, cosine-weighted: directions (x, z) on the disk of radius sin(radius).
        double const x = std::clamp(std::sin(shift * radius) / std::sin(radius), -1.0, 1.0);
        double const visible = (pi / 2 + std::asin(x) + x * std::sqrt(1 - x * x)) / pi;
        // The plane's edge is a great circle through the z axis: in the projection a half ellipse
        // that the line stands in for, to 1 - cos of the radius.
        double const beyond = std::max(0.0, std::abs(e.mean - 2 * visible) - 3e-3);
        EXPECT_GT(normal_tail(beyond / std::sqrt(e.variance + 1e-12)), level)
            << shift << ": " << e.mean << " for " << 2 * visible;
    }
}

TEST(Luminaires, TheCameraSeesNoLampsAndMirrorsDo) {
    std::string const view = R"(<camera type="perspective" width="2" height="2" fov="1"><transform>
        <lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform></camera>)";
    std::string const lamps =
        R"(<light type="point" position="0,0,0" radius="0.5" intensity="2"/>
        <light type="directional" direction="0,0,1" angle="20" intensity="3"/>)";
    auto mean = [&](std::string const& contents) {
        return block_estimates(make_scene(view + contents), 20, 2, 3).at(0).mean;
    };
    EXPECT_EQ(mean(lamps), 0);
    // Behind the camera, in a mirror, which also hides the disk at infinity: both lamps at once.
    std::string const mirror =
        R"(<instance><shape type="rectangle"/><bsdf type="conductor"/><transform><rotate axis="0,1,0" angle="180"/>
        <translate z="4"/></transform></instance>)";
    std::string const behind =
        R"(<light type="point" position="0,0,-9" radius="0.5" intensity="2"/>
        <light type="point" position="0,0,2" radius="0.25" intensity="1"/>
        <light type="directional" direction="0,0,-1" angle="20" intensity="3"/>)";
    double const pi = std::numbers::pi, sine = std::sin(pi / 18);
    double const disk = 3 / (pi * sine * sine), balls = 2 / (pi * 0.25) + 1 / (pi * 0.0625);
    EXPECT_NEAR(mean(mirror + behind), disk + balls, 1e-4 * (disk + balls));
}

TEST(Luminaires, ExposureTemperatureAndUnitsScaleEveryLight) {
    auto light = [&](std::string const& type, std::string const& more) {
        if (type == "emission")
            return R"(<light type="area"><instance><shape type="rectangle"/><emission type="lambertian" )" +
                   more +
                   R"(/><transform><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>)";
        if (type == "envmap") return "<light type=\"envmap\" texture=\"0.3\" " + more + "/>";
        if (type == "ies") return "<light type=\"ies\" filename=\"" + kIes + "\" " + more + "/>";
        return "<light type=\"" + type + "\" " + more + "/>";
    };
    std::string const up = R"(position="0,3,0" direction="0,-1,0" )";
    struct {
        std::string type, attributes;
    } const kinds[] = {{"point", R"(position="0,3,0" )"},
                       {"directional", R"(direction="0,1,0" )"},
                       {"spot", up},
                       {"ies", up},
                       {"emission", ""},
                       {"envmap", ""}};
    for (auto const& kind : kinds) {
        SCOPED_TRACE(kind.type);
        auto means = [&](std::string const& more) {
            auto const scene = make_scene(kOrigin + light(kind.type, kind.attributes + more),
                                          "type=\"path\" depth=\"2\"");
            auto const e = block_estimates(scene, 50, 2, 4);
            return Vec3d(e[0].mean, e[1].mean, e[2].mean);
        };
        Vec3d const plain = means("");
        EXPECT_GT(plain.x, 0);
        EXPECT_NEAR(means("exposure=\"2\"").x / plain.x, 4, 1e-5);
        bool const measured = kind.type == "ies"; // always photometric
        double const lumens = measured ? plain.x : means("unit=\"photometric\"").x * 683;
        EXPECT_NEAR(lumens / plain.x, 1, 1e-5);
        Color const warm = blackbody_color(2700);
        Vec3d const tinted = means("temperature=\"2700\"");
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(tinted[k] / plain[k], double(warm[k]), 1e-5 * double(warm[k]));
    }
}

TEST(Luminaires, ConstantNetworksAreColoursAndOthersAreRefused) {
    auto lamp = [](std::string const& node) {
        return R"(<light type="point" position="0,2,0">)" + node + "</light>";
    };
    Estimate const e =
        irradiance(lamp(R"(<texture name="intensity" type="mix" fg="4" bg="2" mix="0.5"/>)"), 50);
    EXPECT_NEAR(e.mean, 3. / 4, 1e-4);
    for (std::string const node : {"checkerboard", "noise3d"}) {
        try {
            make_scene(kOrigin + lamp("\n<texture name=\"power\" type=\"" + node + "\"/>"));
            ADD_FAILURE() << "no error for " << node;
        } catch (InputError const& error) {
            EXPECT_NE(std::string(error.what())
                          .find(":1: 'power' of <light type=\"point\"> expects one color, found "
                                "nodes that vary from point to point"),
                      std::string::npos)
                << error.what();
        }
    }
    try {
        make_scene(kOrigin +
                   R"(<light type="spot"><texture name="gobo" type="position"/></light>)");
        ADD_FAILURE() << "no error";
    } catch (InputError const& error) {
        EXPECT_NE(std::string(error.what()).find("'gobo' of <light type=\"spot\"> expects"),
                  std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace weft::integrator
