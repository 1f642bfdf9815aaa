// The controls of lights, objects and paths: each takes away what it says, and nothing else.
// Every claim is an equation between pictures that are rendered in different ways, held to by
// z-tests.
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

constexpr double kAlpha = 0.01; // for each test

std::string const kCamera = R"(<camera type="perspective" width="8" height="8" fov="45">
    <transform><lookat origin="0,1.5,-5" target="0,0,0" up="0,1,0"/></transform></camera>)";

std::string floor(std::string const& attributes = "") {
    return "<instance " + attributes +
           R"(><shape type="rectangle"/><bsdf type="diffuse" albedo="0.7,0.5,0.3"/>
    <transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>)";
}
std::string ball(std::string const& at, std::string const& bsdf,
                 std::string const& attributes = "") {
    return "<instance " + attributes + "><shape type=\"sphere\"/>" + bsdf +
           "<transform><scale value=\"0.8\"/><translate value=\"" + at +
           "\"/></transform></instance>";
}
std::string const kGlossy =
    R"(<bsdf type="principled" baseColor="0.2,0.5,0.8" roughness="0.4" metallic="0.3" specular="1"/>)";
std::string const kRoughGlass = R"(<bsdf type="roughdielectric" roughness="0.5"/>)";
std::string wax(float subsurface, std::string const& color = "0.8,0.6,0.3") {
    return "<bsdf type=\"disney\" roughness=\"0.4\" baseColor=\"" + color + "\" subsurface=\"" +
           std::to_string(subsurface) + "\"/>";
}
std::string const kMirror = R"(<bsdf type="conductor" reflectance="0.9"/>)";

/// The lamp that is controlled, above what the camera sees.
std::string lamp(std::string const& controls = "", std::string const& instance = "") {
    return "<light type=\"area\" " + controls + "><instance " + instance +
           R"(><shape type="rectangle"/><emission type="lambertian" emission="3,4,5"/>
    <transform><scale value="1.5"/><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>)";
}
std::string point_lamp(std::string const& controls = "") {
    return R"(<light type="point" position="1,3,-2" power="60,50,40" )" + controls + "/>";
}
std::string sky(std::string const& controls = "") {
    return "<light type=\"envmap\" " + controls +
           R"(><texture type="constant" value="0.3,0.2,0.1"/></light>)";
}

/// Diffuse, glossy and transmitting surfaces.
std::string const kAllKinds =
    kCamera + floor() + ball("-0.9,-0.2,0", kGlossy) + ball("0.9,-0.2,0", kRoughGlass);

struct Picture {
    std::string contents;
    std::string integrator = "depth=\"5\"";
    double factor = 1;
};

std::vector<Estimate> sum_of(std::vector<Picture> const& pictures, int samples, uint32_t seed) {
    std::vector<Estimate> sum;
    for (Picture const& p : pictures) {
        auto const scene = make_scene(p.contents, "type=\"path\" " + p.integrator);
        auto const estimates = block_estimates(scene, samples, 4, seed++);
        sum.resize(estimates.size());
        for (size_t i = 0; i < sum.size(); ++i) {
            sum[i].mean += p.factor * estimates[i].mean;
            sum[i].variance += p.factor * p.factor * estimates[i].variance;
        }
    }
    return sum;
}

struct Equation {
    std::string name;
    std::vector<Picture> left, right;
};

void expect_equal(std::vector<Equation> const& equations, int samples = 2000) {
    double const level = sidak(kAlpha, int(equations.size()) * 12);
    uint32_t seed = 100;
    for (Equation const& e : equations) {
        auto const a = sum_of(e.left, samples, seed), b = sum_of(e.right, samples, seed + 50);
        seed += 100;
        for (size_t i = 0; i < a.size(); ++i)
            EXPECT_GT(difference_p_value(a[i], b[i]), level)
                << e.name << ", block " << i / 3 << ", channel " << i % 3 << ": " << a[i].mean
                << " +- " << std::sqrt(a[i].variance) << " against " << b[i].mean << " +- "
                << std::sqrt(b[i].variance);
    }
}

/// The same samples to the last bit.
void expect_same_bits(Picture const& a, Picture const& b, std::string const& what) {
    auto const one =
        block_estimates(make_scene(a.contents, "type=\"path\" " + a.integrator), 8, 1, 7);
    auto const two =
        block_estimates(make_scene(b.contents, "type=\"path\" " + b.integrator), 8, 1, 7);
    for (size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i].mean, two[i].mean) << what;
}

TEST(LightControls, Bounces) {
    std::string const depth2 = "depth=\"2\"", depth3 = "depth=\"3\"";
    std::vector<Equation> equations;
    for (auto const& [name, light] : {std::pair<std::string, std::string (*)(std::string const&)>{
                                          "lamp", [](std::string const& c) { return lamp(c); }},
                                      {"point", [](std::string const& c) { return point_lamp(c); }},
                                      {"sky", [](std::string const& c) { return sky(c); }}}) {
        auto const with = [&](std::string const& controls) { return kAllKinds + light(controls); };
        equations.push_back(
            {name + ": 0 is direct light", {{with("bounces=\"0\"")}}, {{with(""), depth2}}});
        equations.push_back(
            {name + ": 1 is one more", {{with("bounces=\"1\"")}}, {{with(""), depth3}}});
        // What is seen of the light itself (depth 1) has no factor.
        equations.push_back({name + ": direct and indirect are factors",
                             {{with("direct=\"2\" indirect=\"0.5\"")}},
                             {{with(""), "depth=\"1\"", -1},
                              {with(""), depth2, 1.5},
                              {with(""), "depth=\"5\"", 0.5}}});
    }
    expect_equal(equations);
}

TEST(LightControls, KindsOfScatteringSumUp) {
    std::vector<Equation> equations;
    std::string const fog =
        R"(<medium type="homogeneous" absorption="0.02" scatter="0.1,0.15,0.2" phase="0.3"/>)";
    std::string const others[] = {"diffuse=\"0\" ", "specular=\"0\" ", "transmission=\"0\" ",
                                  "volume=\"0\" ", "subsurface=\"0\" "};
    for (std::string const strategy : {"mis", "nee", "bsdf"}) {
        std::string const how = "depth=\"4\" strategy=\"" + strategy + "\"";
        for (bool foggy : {false, true}) {
            std::string const scene =
                kAllKinds + ball("0,-0.2,-1.4", wax(0.6f)) + (foggy ? fog : "");
            Equation e{strategy + (foggy ? ", fog" : ""), {}, {{scene + lamp(), how}}};
            for (int kept = 0; kept < 5; ++kept) {
                std::string controls;
                for (int k = 0; k < 5; ++k)
                    if (k != kept) controls += others[k];
                // The light itself is in each of the five.
                e.left.push_back({scene + lamp(controls), how});
            }
            e.right.push_back({scene + lamp(), "depth=\"1\"", 4});
            equations.push_back(e);
        }
        equations.push_back({strategy + ": factors",
                             {{kAllKinds + lamp("diffuse=\"2\" specular=\"2\" transmission=\"2\""),
                               "depth=\"3\" strategy=\"" + strategy + "\""}},
                             {{kAllKinds + lamp(), "depth=\"3\" strategy=\"" + strategy + "\"", 2},
                              {kAllKinds + lamp(), "depth=\"1\"", -1}}});
    }
    // Light from below the surface is a part of what the same matter sends back diffusely without.
    for (std::string const strategy : {"mis", "nee", "bsdf"}) {
        std::string const how = "depth=\"2\" strategy=\"" + strategy + "\"";
        auto const lit = [&](std::string const& material, std::string const& controls,
                             double factor) -> Picture {
            return {kCamera + floor() + ball("0,-0.2,0", material) + lamp(controls), how, factor};
        };
        equations.push_back({strategy + ": no light from below",
                             {lit(wax(0.6f), "subsurface=\"0\"", 1)},
                             {lit(wax(0), "", 0.4), lit(wax(0, "0"), "", 0.6)}});
        equations.push_back({strategy + ": light from below alone",
                             {lit(wax(0.6f), "diffuse=\"0\"", 1)},
                             {lit(wax(0), "diffuse=\"0\"", 1), lit(wax(1), "diffuse=\"0\"", 0.6),
                              lit(wax(0), "diffuse=\"0\"", -0.6)}});
    }
    // What has no gloss loses nothing without gloss, and all of it without diffuse light.
    std::string const diffuse = kCamera + floor();
    equations.push_back({"no specular light on a floor",
                         {{diffuse + lamp("specular=\"0\" transmission=\"0\" volume=\"0\"")}},
                         {{diffuse + lamp()}}});
    equations.push_back(
        {"no diffuse light on a floor", {{diffuse + point_lamp("diffuse=\"0\"")}}, {{diffuse}}});
    expect_equal(equations);
}

TEST(LightControls, Visibility) {
    auto const dark = [&](std::string const& more) { return kCamera + floor() + more; };
    std::string const bulb = R"(<instance><shape type="sphere"/>
        <emission type="lambertian" emission="2,3,4"/></instance></light>)";
    std::vector<Equation> equations;
    equations.push_back(
        {"not for the camera",
         {{kCamera + "<light type=\"area\" visibleToCamera=\"false\">" + bulb, "depth=\"1\""}},
         {{kCamera}}});
    equations.push_back({"but lit by it",
                         {{kAllKinds + lamp("visibleToCamera=\"false\"")}},
                         {{kAllKinds + lamp()}}});
    equations.push_back({"a sky that is not for the camera",
                         {{dark(sky("visibleToCamera=\"false\""))}, {dark(sky()), "depth=\"1\""}},
                         {{dark(sky())}}});
    // Mirrors lose it, rough surfaces do not.
    std::string const mirror = kCamera + ball("0,0,0", kMirror);
    equations.push_back({"not in a mirror",
                         {{mirror + lamp("visibleToSecondary=\"false\"")}},
                         {{mirror + lamp(), "depth=\"1\""}}});
    equations.push_back({"not of the sky in a mirror",
                         {{mirror + sky("visibleToSecondary=\"false\"")}},
                         {{mirror + sky(), "depth=\"1\""}}});
    for (std::string const strategy : {"mis", "nee", "bsdf"})
        for (std::string const& light :
             {lamp("visibleToSecondary=\"false\""), sky("visibleToSecondary=\"false\"")}) {
            bool const is_sky = light[13] == 'e';
            equations.push_back({"still on rough surfaces, " + strategy,
                                 {{kAllKinds + light, "depth=\"2\" strategy=\"" + strategy + "\""}},
                                 {{kAllKinds + (is_sky ? sky() : lamp()), "depth=\"2\""}}});
        }
    expect_equal(equations);
}

TEST(LightControls, TheCameraSeesLampsWhereTheySaySo) {
    // Radiance of a ball of power P and radius r: P / (4 pi^2 r^2).
    std::string const camera = R"(<camera type="perspective" width="8" height="8" fov="45">
        <transform><lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform></camera>)";
    auto const with = [&](std::string const& light) { return camera + light; };
    std::string const ball =
        R"(<light type="point" position="0.7,0.4,1" power="39.4784176" radius="1.5" )";
    std::string const disk =
        R"(<light type="directional" direction="0,0,1" angle="20" intensity="2" )";
    double const disk_radiance = 2 / (M_PI * std::pow(std::sin(M_PI / 18), 2));
    std::vector<Equation> equations;
    for (std::string const strategy : {"mis", "nee", "bsdf"}) {
        std::string const how = "depth=\"3\" strategy=\"" + strategy + "\"";
        auto const shown = [&](std::string const& lamp) -> Picture {
            return {with(lamp + "visibleToCamera=\"true\"/>"), how};
        };
        equations.push_back({strategy + ": ball",
                             {shown(ball)},
                             {{with(R"(<light type="area"><instance><shape type="sphere"/>
                                 <emission type="lambertian" emission="0.444444444"/>
                                 <transform><scale value="1.5"/><translate value="0.7,0.4,1"/></transform></instance></light>)"),
                               how}}});
        // The disk fills part of the view, as one of the same radiance in front does.
        equations.push_back(
            {strategy + ": disk",
             {shown(disk)},
             {{with(
                   R"(<light type="area"><instance><shape type="disk"/><emission type="lambertian" emission=")" +
                   std::to_string(disk_radiance) + R"("/><transform><scale value=")" +
                   std::to_string(5 * std::tan(M_PI / 18)) +
                   R"("/><rotate axis="0,1,0" angle="180"/></transform></instance></light>)"),
               how}}});
        for (std::string const& lamp : {ball, disk})
            equations.push_back({strategy + ": hidden otherwise",
                                 {{with(lamp + "/>"), how}},
                                 {{with(lamp + "visibleToCamera=\"false\"/>"), how, 0}}});
    }
    expect_equal(equations);
}

TEST(LightControls, Shadows) {
    // Blockers that the camera does not see; at depth 2 they do nothing but cast shadows.
    auto const card = [](std::string const& x, std::string const& attributes) {
        return "<instance " + attributes +
               R"(><shape type="rectangle"/><transform><scale value="0.7"/><rotate axis="1,0,0" angle="90"/><translate y="2.2" x=")" +
               x + "\"/></transform></instance>";
    };
    std::string const left = card("-0.8", "sets=\"left cards\""),
                      right = card("0.8", "sets=\"right cards\"");
    std::string const base = kAllKinds;
    std::vector<Equation> equations;
    for (std::string const strategy : {"mis", "nee", "bsdf"}) {
        std::string const how = "depth=\"2\" strategy=\"" + strategy + "\"";
        auto const equal = [&](std::string const& name, std::string const& a,
                               std::string const& b) {
            equations.push_back({name + ", " + strategy, {{base + a, how}}, {{base + b, how}}});
        };
        equal("no shadows at all", card("-0.8", "") + lamp("castShadows=\"false\""),
              card("-0.8", "castShadows=\"false\" visibleToDiffuse=\"false\" "
                           "visibleToGlossy=\"false\" visibleToTransmission=\"false\"") +
                  lamp("castShadows=\"false\""));
        equal("shadows of the left card alone", left + right + point_lamp("shadowedBy=\"left\""),
              left + point_lamp("shadowedBy=\"cards\""));
        equal("shadows of all cards but the left", left + right + sky("shadowedBy=\"cards -left\""),
              right + sky("shadowedBy=\"right\""));
        equal("an object without a shadow",
              card("0", "castShadows=\"false\" visibleToDiffuse=\"false\" "
                        "visibleToGlossy=\"false\" visibleToTransmission=\"false\"") +
                  lamp(),
              lamp());
    }
    expect_equal(equations);
}

TEST(LightControls, Links) {
    auto const scene = [&](std::string const& light) {
        return kCamera + floor("sets=\"set\"") +
               ball("-0.9,-0.2,0", kGlossy, "sets=\"cast hero\"") +
               ball("0.9,-0.2,0", kRoughGlass, "sets=\"cast\"") + light;
    };
    std::vector<Equation> equations;
    std::string const direct = "depth=\"2\"";
    // What one set gets and what the others get is all.
    for (std::string const strategy : {"mis", "nee", "bsdf"}) {
        std::string const how = direct + " strategy=\"" + strategy + "\"";
        for (auto const light : {+[](std::string const& c) { return lamp(c); },
                                 +[](std::string const& c) { return sky(c); }})
            equations.push_back({strategy,
                                 {{scene(light("illuminates=\"cast\"")), how},
                                  {scene(light("illuminates=\"-cast\"")), how}},
                                 {{scene(light("")), how}, {scene(light("")), "depth=\"1\""}}});
        equations.push_back({"exceptions, " + strategy,
                             {{scene(point_lamp("illuminates=\"cast -hero\"")), how},
                              {scene(point_lamp("illuminates=\"hero set\"")), how}},
                             {{scene(point_lamp()), how}}});
    }
    equations.push_back({"nothing to light", // all are in a set
                         {{scene(point_lamp("illuminates=\"-cast -set\""))}},
                         {{scene("")}}});
    expect_equal(equations);
}

TEST(LightControls, Distance) {
    std::vector<Equation> equations;
    for (std::string const strategy : {"mis", "nee", "bsdf"}) {
        std::string const how = "depth=\"4\" strategy=\"" + strategy + "\"";
        equations.push_back({"all near, " + strategy,
                             {{kAllKinds + lamp("maxDistance=\"100\""), how}},
                             {{kAllKinds + lamp(), "depth=\"4\""}}});
        equations.push_back({"all far, " + strategy,
                             {{kAllKinds + lamp("maxDistance=\"0.5\""), how}},
                             {{kAllKinds + lamp(), "depth=\"1\""}}});
        equations.push_back({"some far, " + strategy,
                             {{kAllKinds + lamp("maxDistance=\"4\""), how}},
                             {{kAllKinds + lamp("maxDistance=\"4\""), "depth=\"4\""}}});
        // A light that is too weak for secondary rays is a light without bounces.
        equations.push_back({"culled, " + strategy,
                             {{kAllKinds + lamp("minContribution=\"1e6\""), how}},
                             {{kAllKinds + lamp(), "depth=\"2\""}}});
        equations.push_back({"not culled, " + strategy,
                             {{kAllKinds + lamp("minContribution=\"1e-6\""), how}},
                             {{kAllKinds + lamp(), "depth=\"4\""}}});
    }
    expect_equal(equations);
}

TEST(ObjectControls, Visibility) {
    // A wall beside what the camera sees, which reflects light to it and casts a shadow.
    auto const wall = [](std::string const& attributes) {
        return "<instance " + attributes +
               R"(><shape type="rectangle"/><bsdf type="diffuse" albedo="0.9,0.4,0.2"/>
            <transform><scale value="2"/><rotate axis="0,1,0" angle="-90"/><translate x="2.5"/></transform></instance>)";
    };
    auto const hide = [](std::string const& kind) { return "visibleTo" + kind + "=\"false\" "; };
    std::string const quiet = hide("Camera") + "castShadows=\"false\" ";
    struct Kind {
        std::string name, bsdf;
    };
    std::vector<Equation> equations;
    for (Kind const& kind :
         {Kind{"Diffuse", R"(<bsdf type="diffuse" albedo="0.8"/>)"},
          Kind{"Glossy", R"(<bsdf type="roughconductor" roughness="0.4" reflectance="0.8"/>)"}})
        for (std::string const strategy : {"mis", "nee"}) {
            std::string const base = kCamera + ball("0,0,0", kind.bsdf) + sky();
            std::string const how = "depth=\"3\" strategy=\"" + strategy + "\"";
            std::string others;
            for (std::string const other : {"Diffuse", "Glossy", "Transmission", "Volume"})
                if (other != kind.name) others += hide(other);
            equations.push_back({"as if absent for " + kind.name + ", " + strategy,
                                 {{base + wall(quiet + hide(kind.name)), how}},
                                 {{base, how}}});
            // Of its own inner reflections there are none: it is flat.
            equations.push_back({"there for " + kind.name + ", " + strategy,
                                 {{base + wall(quiet + others), how}},
                                 {{base + wall(quiet), how}}});
        }
    // Parts of one material each see their own world, and emission goes along.
    std::string const both = kCamera + ball("0,0,0", kGlossy);
    for (std::string const strategy : {"mis", "nee", "bsdf"}) {
        std::string const how = "depth=\"2\" strategy=\"" + strategy + "\"";
        equations.push_back({"light of an object for one kind alone, " + strategy,
                             {{both + lamp("", "visibleToDiffuse=\"false\""), how}},
                             {{both + lamp("diffuse=\"0\""), "depth=\"2\""}}});
    }
    expect_equal(equations);
}

TEST(ObjectControls, TraceDistance) {
    // Far walls close the sky off, but not for the ball, which sees them from afar.
    std::string const walls =
        R"(<instance visibleToCamera="false"><shape type="sphere"/><bsdf type="diffuse" albedo="0.5"/>
        <transform><scale value="-20"/></transform></instance>)";
    std::vector<Equation> equations;
    for (std::string const strategy : {"mis", "nee", "bsdf"})
        for (std::string const& bsdf :
             {std::string(R"(<bsdf type="diffuse" albedo="0.8"/>)"), kGlossy}) {
            std::string const how = "depth=\"4\" strategy=\"" + strategy + "\"";
            equations.push_back(
                {"short, " + strategy,
                 {{kCamera + ball("0,0,0", bsdf, "traceDistance=\"15\"") + walls + sky(), how}},
                 {{kCamera + ball("0,0,0", bsdf) + sky(), how}}});
            equations.push_back({"long, " + strategy,
                                 {{kCamera + ball("0,0,0", bsdf, "traceDistance=\"50\"") +
                                       floor("traceDistance=\"50\"") + lamp(),
                                   how}},
                                 {{kCamera + ball("0,0,0", bsdf) + floor() + lamp(), how}}});
            equations.push_back(
                {"lights beyond, " + strategy,
                 {{kCamera + ball("0,0,0", bsdf, "traceDistance=\"1\"") + lamp(), how}},
                 {{kCamera + ball("0,0,0", bsdf) + lamp(), "depth=\"1\""}}});
        }
    expect_equal(equations);
}

TEST(PathRules, CausticsAndGloss) {
    // Off camera: a mirror that throws light onto the floor.
    auto const above = [](std::string const& bsdf) {
        return ball("0,2.6,0", bsdf, "visibleToCamera=\"false\"");
    };
    std::string const black = R"(<bsdf type="diffuse" albedo="0"/>)";
    std::string const scene = kCamera + floor();
    std::string const light = sky();
    std::vector<Equation> equations;
    for (std::string const strategy : {"mis", "bsdf"}) {
        std::string const how = "depth=\"3\" strategy=\"" + strategy + "\" ";
        for (std::string const& bsdf :
             {kMirror,
              std::string(R"(<bsdf type="roughconductor" roughness="0.5" reflectance="0.9"/>)")}) {
            equations.push_back({"no caustics, " + strategy,
                                 {{scene + above(bsdf) + light, how + "caustics=\"false\""}},
                                 {{scene + above(black) + light, how}}});
            equations.push_back(
                {"no gloss after a diffuse bounce, " + strategy,
                 {{scene + above(bsdf) + light, how + "secondarySpecular=\"false\""}},
                 {{scene + above(black) + light, how}}});
        }
        // A mirror that the camera sees is none of that.
        std::string const seen = kCamera + floor() + ball("0,0,0", kMirror) + light;
        equations.push_back({"mirrors stay, " + strategy,
                             {{seen, "depth=\"2\" caustics=\"false\" secondarySpecular=\"false\""}},
                             {{seen, "depth=\"2\""}}});
        // The diffuse part of a surface is no caustic.
        equations.push_back(
            {"diffuse light stays, " + strategy,
             {{scene + floor() + light, how + "caustics=\"false\" secondarySpecular=\"false\""}},
             {{scene + floor() + light, how}}});
    }
    auto const metal = [&](std::string const& roughness) {
        return above(R"(<bsdf type="roughconductor" reflectance="0.9" roughness=")" + roughness +
                     "\"/>");
    };
    equations.push_back(
        {"roughening",
         {{scene + metal("0.1") + lamp(), "depth=\"3\" secondaryRoughness=\"0.6\""}},
         {{scene + metal("0.6") + lamp(), "depth=\"3\""}}});
    equations.push_back(
        {"roughening of a mirror",
         {{scene + above(kMirror) + lamp(), "depth=\"3\" secondaryRoughness=\"0.6\""}},
         {{scene + metal("0.6") + lamp(), "depth=\"3\""}}});
    expect_equal(equations);
}

TEST(PathRules, IndirectClampLimitsIndirectLightAlone) {
    std::string const scene = kAllKinds + lamp() + sky();
    expect_same_bits({scene, "depth=\"2\""}, {scene, "depth=\"2\" indirectClamp=\"0.01\""},
                     "direct");
    expect_same_bits({scene, "depth=\"5\""}, {scene, "depth=\"5\" indirectClamp=\"1e9\""},
                     "no limit");
    // At depth 3 there is one light sample and one ray that may find the lamp or the sky.
    auto const direct = make_scene(scene, "type=\"path\" depth=\"2\"");
    auto const limited =
        make_scene(scene, "type=\"path\" depth=\"3\" indirectClamp=\"0.01\" rouletteDepth=\"9\"");
    auto const whole = make_scene(scene, "type=\"path\" depth=\"3\" rouletteDepth=\"9\"");
    PixelRenderer const a(*direct.stage, direct.job.integrator, direct.job.sampler, 1);
    PixelRenderer const b(*limited.stage, limited.job.integrator, limited.job.sampler, 1);
    PixelRenderer const c(*whole.stage, whole.job.integrator, whole.job.sampler, 1);
    int cut = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (uint32_t s = 0; s < 50; ++s) {
                float const indirect = max_component(b.sample({x, y}, s) - a.sample({x, y}, s));
                EXPECT_LE(indirect, 2 * 0.01f * 1.0001f + 1e-5f);
                cut += max_component(c.sample({x, y}, s) - a.sample({x, y}, s)) > 0.1f;
            }
    EXPECT_GT(cut, 100);
}

TEST(Controls, OffMeansThereWereNone) {
    auto const scene = [&](bool controlled) {
        auto const if_so = [&](std::string const& text) { return controlled ? text : ""; };
        return kCamera + floor(if_so("sets=\"set\" traceDistance=\"2\"")) +
               ball("-0.9,-0.2,0", kGlossy, if_so("visibleToDiffuse=\"false\"")) +
               ball("0.9,-0.2,0", kRoughGlass,
                    if_so("castShadows=\"false\" visibleToCamera=\"false\"")) +
               lamp(if_so("bounces=\"0\" illuminates=\"set\" specular=\"0.3\"")) +
               point_lamp(if_so("shadowedBy=\"set\" minContribution=\"3\"")) +
               sky(if_so("visibleToCamera=\"false\" maxDistance=\"3\""));
    };
    expect_same_bits({scene(true), "controls=\"false\" caustics=\"false\" indirectClamp=\"0.1\""},
                     {scene(false), ""}, "controls off");
    // And that there are none costs no bit.
    expect_same_bits({scene(false), ""}, {scene(false), "controls=\"false\""}, "no controls");
}

} // namespace
} // namespace weft::integrator
