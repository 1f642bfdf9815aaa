// Sheets that have no inside (`thinWalled`), beside what is known of them on paper.
#include <gtest/gtest.h>

#include "lobes/fresnel.h"
#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

std::string const kWhiteSky = R"(<light type="envmap"/>)";
std::string const kToTheEnd = "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"";
std::string const kCamera =
    R"(<camera type="perspective" width="8" height="8" fov="40"><transform><translate z="-4"/></transform></camera>)";

/// A camera at `origin` that sees almost nothing but the direction to the origin.
std::string narrow_camera(std::string const& origin) {
    return R"(<camera type="perspective" width="4" height="4" fov="0.01"><transform><lookat origin=")" +
           origin + R"(" target="0,0,0" up="0,1,0"/></transform></camera>)";
}

std::string sheet(std::string const& bsdf, std::string const& transform = "") {
    return "<instance><shape type=\"rectangle\"/>" + bsdf + "<transform>" + transform +
           "</transform></instance>";
}

/// What both sides of a pane reflect under an angle, with all that goes to and fro between them.
double reflected(double cosine, double ior) {
    double const r = double(lobes::fresnel_dielectric(float(cosine), float(ior)));
    double sum = r, between = (1 - r) * (1 - r) * r;
    for (int i = 0; i < 200; ++i, between *= r * r) sum += between;
    return sum;
}

void expect_mean(TestScene const& scene, double truth, int samples, std::string const& what) {
    auto const estimates = block_estimates(scene, samples, 4, 5);
    double const level = sidak(1e-3, int(estimates.size()));
    for (Estimate const& e : estimates)
        EXPECT_GT(difference_p_value(e, {truth, 0}), level)
            << what << ": " << e.mean << " +- " << std::sqrt(e.variance) << " instead of " << truth;
}

TEST(ThinWalls, ClearOnesDisappearInAFurnace) {
    // Open or closed: a bubble is two sheets in a row.
    for (
        char const* bsdf :
        {R"(<bsdf type="dielectric" ior="1.5" thinWalled="true"/>)",
         R"(<bsdf type="microfacet" roughness="0" ior="2.4" thinWalled="true"/>)",
         R"(<bsdf type="microfacet" roughness="0" thinFilmThickness="400" thinWalled="true"/>)",
         R"(<bsdf type="disney" baseColor="1" transmission="1" roughness="0" thinWalled="true"/>)"})
        for (char const* shape : {"sphere", "rectangle"})
            expect_mean(make_scene(kCamera + kWhiteSky + "<instance><shape type=\"" + shape +
                                       "\"/>" + bsdf + "</instance>",
                                   kToTheEnd),
                        1, 500, std::string(bsdf) + shape);
}

TEST(ThinWalls, RoughOnesKeepAllLightButWhatIsRoundedAway) {
    for (
        char const* of :
        {R"(type="roughdielectric" roughness="0.5")", R"(type="roughdielectric" roughness="1")",
         R"(type="roughdielectric" roughness="0.4" distribution="beckmann")",
         R"(type="microfacet" roughness="0.7" ior="2" shadowing="correlated" distribution="ggx")",
         R"(type="disney" baseColor="1" transmission="1" roughness="0.6" anisotropic="0.8")",
         R"(type="disney" baseColor="1" transmission="1" roughness="0.3" transmissionRoughness="0")",
         R"(type="disney" baseColor="1" transmission="1" roughness="0.4" thinFilmThickness="300")"})
        for (char const* origin : {"0,0,-4", "3,0,-1", "0,9,1"}) {
            auto const scene =
                make_scene(narrow_camera(origin) + kWhiteSky +
                               sheet(std::string("<bsdf thinWalled=\"true\" ") + of + "/>"),
                           kToTheEnd);
            for (Estimate const& e : block_estimates(scene, 20000, 4, 5)) {
                EXPECT_LE(e.mean, 1 + 1e-3 + 4 * std::sqrt(e.variance)) << of << origin;
                EXPECT_GE(e.mean, 0.98 - 4 * std::sqrt(e.variance)) << of << origin;
            }
        }
}

TEST(ThinWalls, APaneOverBlackReflectsBothOfItsSides) {
    std::string const black =
        sheet(R"(<bsdf type="diffuse" albedo="0"/>)", R"(<scale value="50"/><translate z="0.5"/>)");
    for (double const angle : {0.0, 50.0, 80.0}) {
        double const c = std::cos(angle * 3.14159265358979 / 180), s = std::sqrt(1 - c * c);
        std::string const origin = std::to_string(4 * s) + ",0," + std::to_string(-4 * c);
        for (char const* bsdf :
             {R"(<bsdf type="dielectric" ior="1.5" thinWalled="true"/>)",
              R"(<bsdf type="disney" transmission="1" roughness="0" thinWalled="true"/>)"})
            expect_mean(
                make_scene(narrow_camera(origin) + kWhiteSky + black + sheet(bsdf), kToTheEnd),
                reflected(c, 1.5), 20000, bsdf + std::to_string(angle));
    }
}

TEST(ThinWalls, LampsShineThroughAPane) {
    // By light sampling, since a lamp without size is not found otherwise: 60 degrees from the
    // normal, through a tinted pane that the camera does not look through.
    std::string const lamp =
        R"(<light type="directional" direction="0.8660254,0,-0.5" intensity="3.14159265"/>)";
    std::string const floor =
        sheet(R"(<bsdf type="diffuse" albedo="0.8"/>)", R"(<scale value="9"/>)");
    std::string const pane =
        sheet(R"(<bsdf type="dielectric" transmittance="0.5" thinWalled="true"/>)",
              R"(<scale value="9"/><translate x="5" z="-3"/>)");
    auto const scene_of = [&](std::string const& things) {
        return make_scene(narrow_camera("-4,0,-1") + lamp + floor + things,
                          "type=\"path\" depth=\"2\"");
    };
    expect_mean(scene_of(""), 0.8 * 0.5, 100, "no pane");
    expect_mean(scene_of(pane), 0.8 * 0.5 * 0.5 * (1 - reflected(0.5, 1.5)), 100, "a pane");
}

TEST(ThinWalls, HalfOfWhatScattersInALeafComesOutBehind) {
    std::string const lamp =
        R"(<light type="directional" direction="0,0,-1" intensity="3.14159265"/>)";
    auto const seen_from = [&](char const* origin, char const* thin) {
        std::string const leaf =
            R"(<bsdf type="disney" baseColor="0.6" specular="0" subsurface="1" thinWalled=")";
        return make_scene(narrow_camera(origin) + lamp + sheet(leaf + thin + "\"/>"), kToTheEnd);
    };
    expect_mean(seen_from("1,0,4", "true"), 0.3, 100, "behind");
    double const all = block_estimates(seen_from("1,0,-4", "false"), 1, 4, 5)[0].mean;
    expect_mean(seen_from("1,0,-4", "true"), all / 2, 100, "in front");
}

} // namespace
} // namespace weft::integrator
