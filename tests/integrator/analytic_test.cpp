// Scenes whose pictures are known on paper.
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

std::string const kWhiteSky =
    R"(<light type="envmap"><texture type="constant" value="1"/></light>)";
/// A camera at `origin` that sees almost nothing but the direction to the origin.
std::string narrow_camera(std::string const& origin, std::string const& up = "0,1,0") {
    return R"(<camera type="perspective" width="4" height="4" fov="0.01"><transform><lookat origin=")" +
           origin + R"(" target="0,0,0" up=")" + up + R"("/></transform></camera>)";
}
std::string const kCamera =
    R"(<camera type="perspective" width="8" height="8" fov="40"><transform><translate z="-4"/></transform></camera>)";

/// z-tests of every block and colour against one value; `alpha` for all of them together.
void expect_mean(TestScene const& scene, Color const& truth, int samples, uint32_t seed,
                 std::string const& what, double alpha = 1e-3) {
    auto const estimates = block_estimates(scene, samples, 4, seed);
    double const level = sidak(alpha, int(estimates.size()));
    for (size_t i = 0; i < estimates.size(); ++i) {
        double const expected = double(truth[int(i % 3)]);
        EXPECT_GT(difference_p_value(estimates[i], {expected, 0}), level)
            << what << ", block " << i / 3 << ", channel " << i % 3 << ": " << estimates[i].mean
            << " +- " << std::sqrt(estimates[i].variance) << " instead of " << expected;
    }
}

TEST(Furnace, WhiteDiffuseDisappears) {
    // Around a convex object every path ends in the sky after one bounce, at any depth from 2 on.
    for (char const* depth : {"2", "3", "16", "-1"})
        for (char const* strategy : {"mis", "nee", "bsdf"}) {
            auto const scene = make_scene(
                kCamera + kWhiteSky +
                    R"(<instance><shape type="sphere"/><bsdf type="diffuse" albedo="1"/></instance>)",
                std::string("type=\"path\" depth=\"") + depth + "\" strategy=\"" + strategy + "\"");
            expect_mean(scene, Color(1), 500, 1, std::string("depth ") + depth + ", " + strategy);
        }
}

TEST(Furnace, SmoothGlassDisappears) {
    for (char const* ior : {"1.5", "1.1", "2.4"}) {
        auto const scene =
            make_scene(kCamera + kWhiteSky +
                           R"(<instance><shape type="sphere"/><bsdf type="dielectric" ior=")" +
                           ior + R"("/></instance>)",
                       "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"");
        expect_mean(scene, Color(1), 500, 2, std::string("ior ") + ior);
    }
}

TEST(Furnace, NestedGlassDisappears) {
    // Overlapping glasses, as liquid in a glass: energy is kept all the same, and of equal
    // priorities as well, since what is there does not depend on the way in.
    for (bool equal : {false, true}) {
        auto const priority = [&](char const* p) { return std::string(equal ? "0" : p); };
        auto const scene = make_scene(
            kCamera + kWhiteSky + "<instance priority=\"" + priority("1") +
                R"("><shape type="sphere"/><bsdf type="dielectric" ior="1.33"/></instance>
                <instance priority=")" +
                priority("2") +
                R"("><shape type="sphere"/><bsdf type="dielectric" ior="1.5"/><transform><translate x="0.4"/></transform></instance>
                <instance priority=")" +
                priority("3") +
                R"("><shape type="sphere"/><bsdf type="dielectric" ior="1.8"/><transform><scale value="0.8"/><translate x="-0.3" y="0.2"/></transform></instance>)",
            "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"");
        expect_mean(scene, Color(1), 500, 3, equal ? "equal priorities" : "nested");
    }
}

TEST(Furnace, FoldedNormalMapsKeepAllLight) {
    // However strong the map and flat the view, a white surface in a white furnace stays white.
    for (char const* bsdf :
         {R"(<bsdf type="diffuse" albedo="1"/>)", R"(<bsdf type="conductor" reflectance="1"/>)"})
        for (char const* shape : {"sphere", "rectangle"})
            for (char const* strategy : {"mis", "nee", "bsdf"}) {
                auto const scene = make_scene(
                    R"(<camera type="perspective" width="8" height="8" fov="40"><transform><lookat origin="0,-3.9,1" target="0,0,0" up="0,0,1"/></transform></camera>)" +
                        kWhiteSky + "<instance><shape type=\"" + shape + "\"/>" + bsdf +
                        R"(<texture name="normal" type="checkerboard" color0="0.95,0.5,0.6" color1="0.2,0.1,0.65" scale="9,7"/></instance>)",
                    std::string("type=\"path\" depth=\"-1\" normals=\"fold\" strategy=\"") +
                        strategy + "\"");
                expect_mean(scene, Color(1), 1000, 7, std::string(bsdf) + shape + strategy);
            }
}

TEST(Overlap, IsTheSameFromBothSides) {
    // Two clouds that absorb, of one priority. The smaller, or of equals the earlier, fills what
    // they share: the length through it is known, and so is what is left of the sky.
    struct Case {
        double first_radius, first_length, second_length;
    };
    // Balls at x = 0 and, of radius 1, at x = 1.2: [-r, r] and [0.2, 2.2].
    for (Case const& c : {Case{1, 2, 1.2}, Case{1.1, 1.3, 2}, Case{0.8, 1.6, 1.4}})
        for (char const* origin : {"-9,0,0", "9,0,0"}) {
            auto const scene = make_scene(
                R"(<camera type="perspective" width="4" height="4" fov="0.01"><transform><lookat origin=")" +
                    std::string(origin) + R"(" target="0,0,0" up="0,1,0"/></transform></camera>)" +
                    kWhiteSky +
                    R"(<instance><shape type="sphere"/><medium type="homogeneous" absorption="1,0,0.5"/><transform><scale value=")" +
                    std::to_string(c.first_radius) +
                    R"("/></transform></instance>
                    <instance><shape type="sphere"/><medium type="homogeneous" absorption="0,1,0.5"/><transform><translate x="1.2"/></transform></instance>)",
                "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"");
            Color const left(float(std::exp(-c.first_length)), float(std::exp(-c.second_length)),
                             float(std::exp(-0.5 * (c.first_length + c.second_length))));
            expect_mean(scene, left, 4000, 6,
                        "radius " + std::to_string(c.first_radius) + " from " + origin);
        }
}

TEST(Furnace, RoughGlassLosesLittleAndGainsNothing) {
    // Single scattering between facets loses what would need two bounces.
    for (char const* roughness : {"0.1", "0.3", "0.6"}) {
        auto const scene = make_scene(
            kCamera + kWhiteSky +
                R"(<instance><shape type="sphere"/><bsdf type="roughdielectric" roughness=")" +
                roughness + R"("/></instance>)",
            "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"");
        for (Estimate const& e : block_estimates(scene, 1000, 4, 4)) {
            EXPECT_LT(e.mean, 1 + 4 * std::sqrt(e.variance) + 1e-5) << roughness;
            EXPECT_GT(e.mean, 0.85) << roughness;
        }
    }
}

TEST(Furnace, ScatteringCubeDisappears) {
    // Without absorption the cloud sends on all light that it gets.
    for (char const* phase : {"0", "0.6", "-0.5"})
        for (char const* strategy : {"mis", "bsdf", "nee"}) {
            auto const scene = make_scene(
                kCamera + kWhiteSky +
                    R"(<instance><shape type="mesh" filename="cube.obj"/><bsdf type="volume" scatter="1,2,4" phase=")" +
                    phase + R"("/>
                <transform><rotate axis="1,1,0" angle="30"/></transform></instance>)",
                std::string("type=\"path\" depth=\"-1\" strategy=\"") + strategy + "\"",
                std::string(WEFT_SOURCE_DIR) + "/tests/integrator");
            expect_mean(scene, Color(1), 400, 5, std::string("g ") + phase + ", " + strategy);
        }
}

TEST(Irradiance, RightUnderASphereLight) {
    // A ball of radius r at distance d above a plane: E = pi L (r / d)^2. Shadow rays stop just
    // before the light, which must not make near ones miss it or lose light.
    for (double gap : {1e-1, 1e-2, 1e-3, 1e-4})
        for (char const* strategy : {"mis", "nee", "bsdf"}) {
            auto const scene = make_scene(
                R"(<camera type="perspective" width="4" height="4" fov="0.01"><transform><lookat origin="0,)" +
                    std::to_string(gap / 2) +
                    R"(,0" target="0,0,0" up="0,0,1"/></transform></camera>
                <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.5"/><transform><scale value="3"/><rotate axis="1,0,0" angle="-90"/></transform></instance>
                <light type="area"><instance><shape type="sphere"/><emission type="lambertian" emission="1"/><transform><translate y=")" +
                    std::to_string(1 + gap) + R"("/></transform></instance></light>)",
                std::string("type=\"path\" depth=\"2\" strategy=\"") + strategy + "\"");
            Color const expected(float(0.5 / ((1 + gap) * (1 + gap))));
            expect_mean(scene, expected, 4000, 8, "gap " + std::to_string(gap) + ", " + strategy);
        }
}

TEST(Opacity, OfTenCardsLetsOneOf1024Through) {
    // Onto white paper under a sky: of its light, and of that back to the camera, the same part
    // gets through ten cards of opacity one half whoever looks for it.
    std::string cards;
    for (int i = 0; i < 10; ++i)
        cards +=
            R"(<instance alpha="0.5"><shape type="rectangle"/><bsdf type="diffuse" albedo="0"/><transform><scale value="1e4"/><translate z=")" +
            std::to_string(1 + i) + R"("/></transform></instance>)";
    for (char const* strategy : {"mis", "nee", "bsdf"}) {
        auto scene = make_scene(
            R"(<camera type="perspective" width="4" height="4" fov="1"><transform><lookat origin="0,0,0.5" target="0,0,0" up="0,1,0"/></transform></camera>)" +
                kWhiteSky + cards +
                R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="1"/></instance>)",
            std::string("type=\"path\" depth=\"2\" strategy=\"") + strategy + "\"");
        expect_mean(scene, Color(1 / 1024.f), 40000, 9, strategy);
        // One shadow ray goes through all of them.
        world::RayRecorder recorder;
        scene.commit({.recorder = &recorder},
                     integrator::combines_strategies(scene.job.integrator));
        EXPECT_FLOAT_EQ(scene.world->visibility({{0.1f, 0.2f, 0.5f}, {0, 0, 1}}).g, 1 / 1024.f);
        integrator::PixelRenderer const renderer(*scene.stage, scene.job.integrator,
                                                 scene.job.sampler, 0);
        renderer.sample({1, 1}, 0);
        size_t shadow_rays = 0;
        for (world::RecordedRay const& r : *recorder.lists().at(0))
            shadow_rays += r.query == world::Query::shadow;
        EXPECT_EQ(shadow_rays, std::string(strategy) == "bsdf" ? 1u : 2u);
    }
}

TEST(Irradiance, OfAPointLight) {
    // E = I cos / r^2, L = E albedo / pi.
    auto const scene =
        make_scene(narrow_camera("0,3,-1") +
                       R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.5"/>
        <transform><scale value="3"/><rotate axis="1,0,0" angle="-90"/></transform></instance><light type="point" position="1,2,0" power="30,60,90"/>)",
                   "type=\"path\" depth=\"-1\"");
    double const r2 = 5, cosine = 2 / std::sqrt(r2);
    float const unit = float(1 / (4 * M_PI) * cosine / r2 * 0.5 / M_PI);
    for (Estimate const& e : block_estimates(scene, 4, 4, 1)) EXPECT_GT(e.mean, 0);
    auto const e = block_estimates(scene, 16, 4, 1);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(e[size_t(c)].mean / (30 * (c + 1) * double(unit)), 1, 1e-3);
}

TEST(Irradiance, OfADirectionalLight) {
    auto const scene =
        make_scene(narrow_camera("0,3,-1") +
                   R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.5"/>
        <transform><scale value="3"/><rotate axis="1,0,0" angle="-90"/></transform></instance><light type="directional" direction="3,4,0" intensity="1,2,3"/>)");
    auto const e = block_estimates(scene, 4, 4, 1);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(e[size_t(c)].mean / ((c + 1) * 0.8 * 0.5 / M_PI), 1, 1e-5);
}

TEST(Irradiance, OfAParallelDisk) {
    // A sphere of radius R at distance d above: E = pi L (R / d)^2. Seen by all strategies.
    for (char const* strategy : {"mis", "nee", "bsdf"}) {
        auto const scene = make_scene(
            narrow_camera("0,0.2,-3") +
                R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.5,0.6,0.7"/>
            <transform><scale value="0.5"/><rotate axis="1,0,0" angle="-90"/></transform></instance>
            <light type="area"><instance><shape type="sphere"/><emission type="lambertian" emission="2"/><transform><scale value="1.5"/><translate y="3"/></transform></instance></light>)",
            std::string("type=\"path\" depth=\"2\" strategy=\"") + strategy + "\"");
        expect_mean(scene, Color(2 * 0.25f) * Color(0.5f, 0.6f, 0.7f), 5000, 6, strategy);
    }
}

TEST(Irradiance, OfASquareAbove) {
    // The form factor of a square of half edge a at height h above its centre, from the closed
    // form of the rectangle with a corner above the point, four times.
    double const a = 1, h = 2, X = a / h, s = std::sqrt(1 + X * X);
    double const form = 4 * (1 / (2 * M_PI)) * 2 * (X / s) * std::atan(X / s);
    for (char const* strategy : {"mis", "nee", "bsdf"}) {
        auto const scene =
            make_scene(narrow_camera("0,0.2,-3") +
                           R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.5"/>
            <transform><scale value="0.5"/><rotate axis="1,0,0" angle="-90"/></transform></instance>
            <light type="area"><instance><shape type="rectangle"/><emission type="lambertian" emission="1,2,3"/><transform><rotate axis="1,0,0" angle="90"/><translate y="2"/></transform></instance></light>)",
                       std::string("type=\"path\" depth=\"2\" strategy=\"") + strategy + "\"");
        expect_mean(scene, Color(1, 2, 3) * float(0.5 * form), 5000, 7, strategy);
    }
}

TEST(Slab, AbsorbsByBeersLaw) {
    // The camera looks through a box of thickness 2, at the centre, towards a white sky.
    Color const truth(std::exp(-2 * 0.5f), std::exp(-2 * 1.f), 1);
    std::string const folder = std::string(WEFT_SOURCE_DIR) + "/tests/integrator";
    std::string const box = "<instance><shape type=\"mesh\" filename=\"cube.obj\"/>";
    auto const bare =
        make_scene(narrow_camera("0,0,-4") + kWhiteSky + box +
                       R"(<bsdf type="volume" absorption="0.5,1,0" scatter="0"/></instance>)",
                   "type=\"path\" depth=\"1\"", folder);
    expect_mean(bare, truth, 200, 8, "null boundary");
    auto const without_bsdf =
        make_scene(narrow_camera("0,0,-4") + kWhiteSky + box +
                       R"(<medium type="homogeneous" absorption="0.5,1,0"/></instance>)",
                   "type=\"path\" depth=\"1\"", folder);
    expect_mean(without_bsdf, truth, 200, 9, "medium alone");
    // Glass of normal reflectance R: (1 - R)^2 t is sent on at once, and R^2 t^2 more each time
    // round; what is reflected sees the sky, too: all that is not absorbed.
    auto const glass = make_scene(
        narrow_camera("0,0,-4") + kWhiteSky + box +
            R"(<bsdf type="dielectric" ior="1.5"/><medium type="homogeneous" absorption="0.5,1,0"/></instance>)",
        "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"", folder);
    auto through = [](double t) {
        double const r = 0.04;
        return r + (1 - r) * (1 - r) * t * (1 + r * t) / (1 - r * r * t * t);
    };
    Color const behind_glass(float(through(double(truth.r))), float(through(double(truth.g))), 1);
    expect_mean(glass, behind_glass, 4000, 10, "glass");
}

TEST(Slab, CameraInsideKnowsIt) {
    // From the centre of the box only half of it lies ahead.
    std::string const folder = std::string(WEFT_SOURCE_DIR) + "/tests/integrator";
    auto const scene = make_scene(
        R"(<camera type="perspective" width="4" height="4" fov="0.01"/>)" + kWhiteSky +
            R"(<instance><shape type="mesh" filename="cube.obj"/><bsdf type="volume" absorption="0.5,1,0" scatter="0"/></instance>)",
        "type=\"path\" depth=\"1\"", folder);
    expect_mean(scene, Color(std::exp(-0.5f), std::exp(-1.f), 1), 200, 11, "inside");
}

TEST(Slab, LightInsideIsWeakenedOnItsWay) {
    // A point light in an absorbing ball of radius 2 around the plane's point: exp(-sigma r).
    auto const scene =
        make_scene(narrow_camera("0,5,-0.5") +
                       R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.5"/>
        <transform><scale value="0.1"/><rotate axis="1,0,0" angle="-90"/></transform></instance>
        <instance><shape type="sphere"/><bsdf type="volume" absorption="0.3,1,0" scatter="0"/><transform><scale value="2"/></transform></instance>
        <light type="point" position="0,3,0" power="30"/>)",
                   "type=\"path\" depth=\"2\"");
    double const unit = 30 / (4 * M_PI) / 9 * 0.5 / M_PI;
    // Light and camera each look through the ball's upper half.
    Color const truth(float(unit * std::exp(-4 * 0.3)), float(unit * std::exp(-4.0)), float(unit));
    auto const e = block_estimates(scene, 20000, 4, 12);
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(std::abs(e[size_t(c)].mean - double(truth[c])),
                  4.5 * std::sqrt(e[size_t(c)].variance) + 1e-3 * double(truth[c]))
            << c << ": " << e[size_t(c)].mean;
}

TEST(Alpha, TenCardsLetAThousandthThrough) {
    std::string cards;
    for (int i = 0; i < 10; ++i)
        cards +=
            R"(<instance alpha="0.5"><shape type="rectangle"/><transform><scale value="9"/><translate x="1" z=")" +
            std::to_string(i) + R"("/></transform></instance>)";
    // Seen by the camera: by chance. The light is behind the cards; the cards are black.
    auto const seen =
        make_scene(narrow_camera("0,0,-4") + cards + kWhiteSky, "type=\"path\" depth=\"2\"");
    expect_mean(seen, Color(1 / 1024.f), 100000, 13, "seen");
    // By a floor's light samples: shadow rays multiply.
    auto const floor = [&](char const* strategy) {
        return make_scene(
            R"(<camera type="perspective" width="4" height="4" fov="0.01"><transform><translate z="-1"/></transform></camera>
            <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="1"/><transform><scale value="0.5"/><translate z="-0.5"/></transform></instance>)" +
                cards + R"(<light type="directional" direction="0,0,1" intensity="1"/>)",
            std::string("type=\"path\" depth=\"2\" strategy=\"") + strategy + "\"");
    };
    for (char const* strategy : {"mis", "nee"})
        for (Estimate const& e : block_estimates(floor(strategy), 4, 4, 14))
            EXPECT_EQ(e.mean, 0) << "the camera sees the floor's other side";
    auto const lit = make_scene(
        R"(<camera type="perspective" width="4" height="4" fov="0.01"><transform><lookat origin="0.5,0,-0.25" target="0,0,-0.5"/></transform></camera>
        <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="1"/><transform><scale value="0.5"/><translate z="-0.5"/></transform></instance>)" +
            cards + R"(<light type="directional" direction="0,0,1" intensity="1"/>)",
        "type=\"path\" depth=\"2\"");
    for (Estimate const& e : block_estimates(lit, 4, 4, 15))
        EXPECT_NEAR(e.mean, 1 / M_PI / 1024, 1e-8);
}

TEST(Roulette, KeepsTheMean) {
    std::string const contents =
        R"(<camera type="perspective" width="8" height="8" fov="60"><transform><translate z="-0.9"/></transform></camera>
        <instance><shape type="mesh" filename="cube.obj"/><bsdf type="diffuse" albedo="0.8,0.5,0.2"/><transform><scale value="2"/></transform></instance>
        <instance><shape type="sphere"/><bsdf type="roughdielectric" roughness="0.4"/><transform><scale value="0.5"/><translate z="0.8"/></transform></instance>
        <light type="area"><instance><shape type="rectangle"/><emission type="lambertian" emission="4"/><transform><rotate axis="1,0,0" angle="90"/><translate y="1.9"/></transform></instance></light>)";
    std::string const folder = std::string(WEFT_SOURCE_DIR) + "/tests/integrator";
    auto const early = block_estimates(
        make_scene(contents, "type=\"path\" depth=\"40\" rouletteDepth=\"1\"", folder), 1500, 4, 1);
    auto const never = block_estimates(
        make_scene(contents, "type=\"path\" depth=\"40\" rouletteDepth=\"1000\"", folder), 700, 4,
        2);
    double const level = sidak(1e-3, int(early.size()));
    for (size_t i = 0; i < early.size(); ++i)
        EXPECT_GT(difference_p_value(early[i], never[i]), level)
            << i << ": " << early[i].mean << " +- " << std::sqrt(early[i].variance) << " and "
            << never[i].mean << " +- " << std::sqrt(never[i].variance);
}

TEST(Depth, CountsVertices) {
    std::string const contents =
        kCamera + R"(<instance><shape type="sphere"/><bsdf type="diffuse" albedo="0.5"/></instance>
        <light type="area"><instance><shape type="sphere"/><emission type="lambertian" emission="3,2,1"/><transform><scale value="0.7"/><translate x="1.5" y="1.5" z="-1"/></transform></instance></light>
        <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.5"/><emission type="lambertian" emission="0.25"/><transform><scale value="5"/><rotate axis="0,1,0" angle="180"/><translate z="2"/></transform></instance>)";
    // 0: nothing. 1: what the camera sees of lights. 2: direct light, as `direct` has it.
    for (Estimate const& e :
         block_estimates(make_scene(contents, "type=\"path\" depth=\"0\""), 4, 4, 1))
        EXPECT_EQ(e.mean, 0);
    auto const one = make_scene(contents, "type=\"path\" depth=\"1\"");
    for (Estimate const& e : block_estimates(one, 64, 4, 1)) EXPECT_GT(e.mean, 0.01);
    auto const behind = make_scene(
        narrow_camera("0,0,-4") +
            R"(<instance><shape type="sphere"/><bsdf type="diffuse"/></instance>)" + kWhiteSky,
        "type=\"path\" depth=\"1\"");
    for (Estimate const& e : block_estimates(behind, 4, 4, 1))
        EXPECT_EQ(e.mean, 0) << "a surface is lit from depth 2 on";
    auto const two = block_estimates(make_scene(contents, "type=\"path\" depth=\"2\""), 2000, 4, 1);
    auto const direct = block_estimates(make_scene(contents, "type=\"direct\""), 2000, 4, 2);
    double const level = sidak(1e-3, int(two.size()));
    for (size_t i = 0; i < two.size(); ++i)
        EXPECT_GT(difference_p_value(two[i], direct[i]), level)
            << i << ": " << two[i].mean << " and " << direct[i].mean;
    // lightwave's names are the same integrators.
    auto const named = block_estimates(make_scene(contents, "type=\"mis\" depth=\"5\""), 100, 4, 1);
    auto const path = block_estimates(make_scene(contents, "type=\"path\" depth=\"5\""), 100, 4, 1);
    for (size_t i = 0; i < named.size(); ++i) EXPECT_EQ(named[i].mean, path[i].mean);
}

} // namespace
} // namespace weft::integrator
