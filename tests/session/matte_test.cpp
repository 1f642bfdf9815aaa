// Passes that go together: what controls remove, holdouts, shadow catchers.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "session/render.h"
#include "tests/support/scenes.h"

namespace weft::session {
namespace {

using namespace weft::testing;
using film::Aov;

constexpr double kAlpha = 0.01; // for each test
constexpr int kSize = 16, kBlock = 4, kBlocks = kSize / kBlock * kSize / kBlock;

std::string const kCamera = R"(<camera type="perspective" width="16" height="16" fov="50">
    <transform><lookat origin="0,1,-4" target="0,0,0" up="0,1,0"/></transform></camera>)";

std::string floor(std::string const& attributes = "") {
    return "<instance " + attributes +
           R"(><shape type="rectangle"/><bsdf type="diffuse" albedo="0.8,0.5,0.3"/>
      <transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>)";
}
std::string ball(std::string const& attributes = "") {
    return "<instance " + attributes +
           R"(><shape type="sphere"/><bsdf type="principled" metallic="0.5" roughness="0.4" baseColor="0.3,0.6,0.9"/></instance>)";
}
std::string glass(std::string const& attributes = "") {
    return "<instance " + attributes +
           R"(><shape type="sphere"/><bsdf type="dielectric"/><transform><scale value="0.5"/><translate x="-1.3" y="-0.5" z="-0.5"/></transform></instance>)";
}
std::string lamp(std::string const& attributes = "") {
    return "<light type=\"area\" " + attributes +
           R"(><instance><shape type="rectangle"/><emission type="lambertian" emission="5,4,3"/><transform><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>)";
}
std::string sky(std::string const& attributes = "") {
    return "<light type=\"envmap\" " + attributes +
           R"(><texture type="constant" value="0.3,0.4,0.5"/></light>)";
}

/// Channels by name of a render with 16 x 16 pixels.
struct Pass {
    image::Image image;
    float at(std::string const& name, int pixel) const {
        auto const it = std::find(image.names.begin(), image.names.end(), name);
        if (it == image.names.end()) throw std::runtime_error("no channel " + name);
        return image
            .pixels[size_t(pixel) * size_t(image.channels) + size_t(it - image.names.begin())];
    }
};

Pass render_pass(std::string const& contents, std::vector<Aov> aovs, int spp, uint32_t seed,
                 std::string const& integrator) {
    TestScene const scene = make_scene(contents, "type=\"path\" " + integrator);
    RenderOptions options;
    options.picture.aovs = std::move(aovs);
    options.limits.spp = spp;
    options.picture.seed = seed;
    return {render(*scene.stage, scene.job, options).film.image()};
}

/// Means over blocks, with the variance of the mean that independent `seeds` show.
template <class F>
std::vector<Estimate> over_seeds(int seeds, F&& picture) {
    std::vector<double> sum(3 * kBlocks), squares(3 * kBlocks);
    for (int seed = 0; seed < seeds; ++seed) {
        std::vector<double> blocks(3 * kBlocks);
        std::vector<Color> const pixels = picture(uint32_t(seed));
        for (int i = 0; i < kSize * kSize; ++i) {
            int const block = i / kSize / kBlock * (kSize / kBlock) + i % kSize / kBlock;
            for (int c = 0; c < 3; ++c)
                blocks[size_t(3 * block + c)] += double(pixels[size_t(i)][c]) / (kBlock * kBlock);
        }
        for (size_t k = 0; k < blocks.size(); ++k) {
            sum[k] += blocks[k];
            squares[k] += blocks[k] * blocks[k];
        }
    }
    std::vector<Estimate> result(3 * kBlocks);
    for (size_t k = 0; k < result.size(); ++k) {
        double const mean = sum[k] / seeds;
        result[k] = {mean, std::max(0.0, squares[k] / seeds - mean * mean) / (seeds - 1)};
    }
    return result;
}

std::vector<Color> colors(Pass const& pass, std::string const& layer = "") {
    std::vector<Color> result;
    for (int i = 0; i < kSize * kSize; ++i)
        result.emplace_back(pass.at(layer + "R", i), pass.at(layer + "G", i),
                            pass.at(layer + "B", i));
    return result;
}

void expect_equal(std::vector<Estimate> const& a, std::vector<Estimate> const& b, int tests,
                  std::string const& what) {
    double const level = sidak(kAlpha, tests * int(a.size()));
    for (size_t k = 0; k < a.size(); ++k)
        EXPECT_GT(difference_p_value(a[k], b[k]), level)
            << what << ", block " << k / 3 << ", channel " << k % 3 << ": " << a[k].mean << " +- "
            << std::sqrt(a[k].variance) << " against " << b[k].mean << " +- "
            << std::sqrt(b[k].variance);
}

TEST(Removed, AddsUpWithBeautyToThePictureWithoutControls) {
    struct Case {
        std::string name, contents, integrator;
    };
    std::vector<Case> const cases{
        {"lights",
         floor("sets=\"set\"") + ball() + glass() +
             lamp("bounces=\"0\" specular=\"0.3\" diffuse=\"1.5\"") +
             sky("illuminates=\"-set\" visibleToCamera=\"false\""),
         "depth=\"6\""},
        {"objects",
         floor("traceDistance=\"2\"") +
             ball("visibleToDiffuse=\"false\" visibleToCamera=\"false\"") +
             glass("castShadows=\"false\"") + lamp("castShadows=\"false\"") + sky(),
         "depth=\"6\""},
        {"paths", floor() + ball() + glass() + lamp() + sky(),
         "depth=\"6\" caustics=\"false\" indirectClamp=\"0.2\" secondaryRoughness=\"0.5\""},
        {"mattes",
         floor("shadowCatcher=\"true\"") + ball("holdout=\"true\"") + glass() + lamp() + sky(),
         "depth=\"6\" secondarySpecular=\"false\""},
        {"materials",
         floor() +
             R"(<instance><shape type="sphere"/><bsdf type="secondary"><bsdf type="conductor"/><bsdf type="diffuse" albedo="0.1"/></bsdf></instance>)" +
             lamp() + sky(),
         "depth=\"6\""}};
    for (Case const& c : cases) {
        auto const sums = over_seeds(24, [&](uint32_t seed) {
            Pass const pass =
                render_pass(kCamera + c.contents, {Aov::removed}, 32, seed, c.integrator);
            auto all = colors(pass), removed = colors(pass, "removed.");
            for (size_t i = 0; i < all.size(); ++i) all[i] += removed[i];
            return all;
        });
        auto const whole = over_seeds(24, [&](uint32_t seed) {
            return colors(render_pass(kCamera + c.contents, {}, 32, 1000 + seed,
                                      "depth=\"6\" controls=\"false\""));
        });
        expect_equal(sums, whole, int(cases.size()), c.name);
        // And something was removed.
        Pass const pass = render_pass(kCamera + c.contents, {Aov::removed}, 8, 1, c.integrator);
        double total = 0;
        for (Color const& v : colors(pass, "removed.")) total += std::abs(double(average(v)));
        EXPECT_GT(total / (kSize * kSize), 1e-3) << c.name;
    }
}

TEST(Removed, IsBlackWithoutControlsAndNoOneElsePays) {
    std::string const contents = kCamera + floor() + ball() + glass() + lamp() + sky();
    Pass const pass = render_pass(contents, {Aov::removed}, 8, 1, "");
    for (Color const& v : colors(pass, "removed.")) EXPECT_EQ(v, Color(0));
    // Beauty is the same with and without.
    EXPECT_EQ(colors(pass), colors(render_pass(contents, {}, 8, 1, "")));
}

TEST(Holdout, CutsAHoleForTheCameraAlone) {
    std::string const rest = kCamera + floor() + lamp();
    Pass const cut =
        render_pass(rest + ball("holdout=\"true\""), {Aov::alpha}, 64, 1, "depth=\"4\"");
    Pass const whole = render_pass(rest + ball(), {Aov::alpha}, 64, 1, "depth=\"4\"");
    Pass const alone = render_pass(kCamera + ball() + lamp(), {Aov::alpha}, 64, 1, "depth=\"4\"");
    int holes = 0, seen = 0;
    for (int i = 0; i < kSize * kSize; ++i) {
        float const covered = alone.at("A", i); // by the ball; the same camera rays
        if (covered == 1) {
            ++holes;
            EXPECT_EQ(cut.at("A", i), 0);
            EXPECT_EQ(cut.at("R", i), 0);
        } else if (covered == 0) {
            // Its shadow and its reflection are still there.
            ++seen;
            EXPECT_EQ(cut.at("A", i), whole.at("A", i));
            EXPECT_EQ(cut.at("R", i), whole.at("R", i));
        }
    }
    EXPECT_GT(holes, 20);
    EXPECT_GT(seen, 100);
}

/// Objects of a foreground and a background, each with places for attributes that one pass gives
/// all of them.
struct Split {
    std::string name;
    std::function<std::string(std::string const&)> foreground, background;
};

std::string gel(std::string const& attributes, std::string const& z) {
    return "<instance " + attributes +
           R"(><shape type="rectangle"/><bsdf type="transparent" transmittance="0.9,0.5,0.2"/><transform><scale value="1.2"/><translate z=")" +
           z + R"("/></transform></instance>)";
}
std::string lantern(std::string const& attributes) {
    return "<instance " + attributes +
           R"(><shape type="sphere"/><emission type="lambertian" emission="2,1,0.5"/><transform><scale value="0.3"/><translate x="1" y="-0.5" z="-1.5"/></transform></instance>)";
}

std::vector<Split> splits() {
    using Text = std::string const&;
    return {
        {"a glossy ball on a floor beside glass", [](Text a) { return ball(a); },
         [](Text a) { return floor(a) + glass(a); }},
        {"glass and a lantern before a ball", [](Text a) { return glass(a) + lantern(a); },
         [](Text a) { return floor(a) + ball(a); }},
        {"gels before and behind a half opaque ball",
         [](Text a) { return ball("alpha=\"0.4\" " + a); },
         [](Text a) { return floor(a) + gel(a, "-1.5") + gel(a, "1.5"); }},
        {"a gel of the foreground between things of the background",
         [](Text a) { return gel(a, "-1.2") + lantern(a); },
         [](Text a) { return floor(a) + ball(a) + gel(a, "-2"); }},
    };
}

TEST(Holdout, ForegroundAndBackgroundAddUpToThePictureInOnePass) {
    // Each pass holds out the other's objects, which still light it, and show in its mirrors and
    // glass. The sky is the background's.
    std::string const how = "depth=\"6\"", hidden = "visibleToCamera=\"false\"",
                      hold = "holdout=\"true\"";
    auto const with_alpha = [&](std::string const& contents, uint32_t seed) {
        Pass const pass = render_pass(kCamera + contents + lamp(), {Aov::alpha}, 16, seed, how);
        std::vector<Color> all = colors(pass);
        for (int i = 0; i < kSize * kSize; ++i) all.emplace_back(pass.at("A", i));
        return all;
    };
    auto const added = [](std::vector<Color> a, std::vector<Color> const& b) {
        for (size_t i = 0; i < a.size(); ++i) a[i] += b[i];
        return a;
    };
    auto const part = [](std::vector<Color> const& all, int which) {
        auto const from = all.begin() + which * kSize * kSize;
        return std::vector<Color>(from, from + kSize * kSize);
    };
    std::vector<Split> const all = splits();
    for (Split const& s : all)
        for (int which : {0, 1}) { // colours, alpha
            auto const whole = over_seeds(24, [&](uint32_t seed) {
                return part(with_alpha(s.foreground("") + s.background("") + sky(), seed), which);
            });
            auto const sum = over_seeds(24, [&](uint32_t seed) {
                return part(
                    added(with_alpha(s.foreground("") + s.background(hold) + sky(hidden),
                                     2000 + seed),
                          with_alpha(s.foreground(hold) + s.background("") + sky(), 3000 + seed)),
                    which);
            });
            expect_equal(whole, sum, 2 * int(all.size()), s.name + (which ? ", alpha" : ""));
        }
}

TEST(CameraVisibility, ForegroundOverBackgroundIsThePictureInOnePass) {
    // Each pass hides the other's objects from the camera alone. The edges of what is in front lie
    // between pixels: `over` knows nothing of where in a pixel two things are.
    std::string const camera = R"(<camera type="orthographic" width="16" height="16" scale="1"/>)",
                      how = "depth=\"6\" filter=\"box\"", hidden = "visibleToCamera=\"false\"";
    auto const front = [](std::string const& attributes) {
        return "<instance alpha=\"0.6\" " + attributes +
               R"(><shape type="rectangle"/><bsdf type="principled" metallic="0.5" roughness="0.4" baseColor="0.3,0.6,0.9"/><transform><scale value="0.5"/><rotate axis="0,1,0" angle="180"/><translate z="1"/></transform></instance>)";
    };
    auto const back = [](std::string const& attributes) {
        return "<instance " + attributes +
               R"(><shape type="rectangle"/><bsdf type="diffuse" albedo="0.8,0.5,0.3"/><transform><scale value="4"/><rotate axis="0,1,0" angle="180"/><translate z="2"/></transform></instance>)";
    };
    auto const whole = over_seeds(24, [&](uint32_t seed) {
        return colors(
            render_pass(camera + front("") + back("") + lamp() + sky(), {}, 32, seed, how));
    });
    auto const joined = over_seeds(24, [&](uint32_t seed) {
        Pass const over = render_pass(camera + front("") + back(hidden) + lamp() + sky(hidden),
                                      {Aov::alpha}, 32, 2000 + seed, how);
        auto const under = colors(render_pass(camera + front(hidden) + back("") + lamp() + sky(),
                                              {}, 32, 3000 + seed, how));
        auto result = colors(over);
        for (int i = 0; i < kSize * kSize; ++i)
            result[size_t(i)] += (1 - over.at("A", i)) * under[size_t(i)];
        return result;
    });
    expect_equal(whole, joined, 1, "over");
}

TEST(ShadowCatcher, RecombinesToThePictureInOnePass) {
    // Direct light; the lamps are colored differently, so that the shadows are.
    std::string const lights =
        lamp() + R"(<light type="point" position="-2,2,-2" power="20,30,90"/>)";
    std::string const how = "depth=\"2\"";
    auto const whole = over_seeds(24, [&](uint32_t seed) {
        return colors(render_pass(kCamera + floor() + ball() + lights, {}, 64, seed, how));
    });
    auto const joined = over_seeds(24, [&](uint32_t seed) {
        Pass const actors = render_pass(kCamera + floor("shadowCatcher=\"true\"") + ball() + lights,
                                        {Aov::alpha, Aov::shadow_catcher}, 64, 2000 + seed, how);
        // The set is the same everywhere and at all times: many samples once would do.
        auto set = colors(render_pass(kCamera + floor() + lights, {}, 64, 3000 + seed, how));
        auto result = colors(actors);
        auto const shadow = colors(actors, "shadow_catcher.");
        for (int i = 0; i < kSize * kSize; ++i)
            result[size_t(i)] += (1 - actors.at("A", i)) * set[size_t(i)] * shadow[size_t(i)];
        return result;
    });
    expect_equal(whole, joined, 1, "shadow catcher");
}

} // namespace
} // namespace weft::session
