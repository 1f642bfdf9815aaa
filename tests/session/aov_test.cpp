// AOVs against what they promise: parts add up to the whole, ids to masks, guides to what is seen
// in mirrors.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "film/cryptomatte.h"
#include "session/render.h"
#include "tests/support/scenes.h"

namespace weft::session {
namespace {

using namespace weft::testing;
using film::Aov;

std::string const kCamera = R"(
    <camera type="thinlens" width="40" height="30" fov="50" lensRadius="0.05" focalDistance="4"><transform><lookat origin="0,1,-4" target="0,0,0" up="0,1,0"/></transform></camera>)";
std::string const kFloor = R"(
    <instance id="floor"><shape type="rectangle"/><bsdf id="tiles" type="diffuse"><texture name="albedo" type="checkerboard" scale="8,8" color0="0.2" color1="0.8"/></bsdf>
      <transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>)";
std::string const kLamp = R"(
    <light type="area" group="lamp"><instance id="lamp"><shape type="rectangle"/><emission type="lambertian" emission="5,4,3"/><transform><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>)";
std::string const kSky =
    R"(<light type="envmap" group="sky"><texture type="constant" value="0.3,0.4,0.5"/></light>)";

/// Scenes of every kind of scattering, with several groups and emission that is no light.
std::map<std::string, std::string> const kScenes{
    {"principled and opacity", kFloor + kLamp + kSky + R"(
        <instance alpha="0.6"><shape type="sphere"/><bsdf type="principled" metallic="0.5" roughness="0.3"/></instance>
        <instance group="neon"><shape type="sphere"/><emission type="lambertian" emission="0.5,0,2"/><transform><scale value="0.3"/><translate x="-1.3" y="-0.6"/></transform></instance>)"},
    {"glass and a medium inside", kFloor + kLamp + kSky + R"(
        <instance><shape type="sphere"/><bsdf type="dielectric"/><medium type="homogeneous" absorption="1,0.2,0" scatter="0.8"/></instance>
        <instance><shape type="sphere"/><bsdf type="roughdielectric" roughness="0.4"/><transform><scale value="0.5"/><translate x="-1.2" y="-0.5"/></transform></instance>
        <light type="point" position="2,2,-2" power="30" group="key"/>)"},
    {"fog", kFloor + kLamp + R"(
        <medium type="homogeneous" absorption="0.02" scatter="0.1"/>
        <instance><shape type="sphere"/><bsdf type="conductor" reflectance="0.9,0.8,0.5"/></instance>
        <light type="directional" direction="1,2,-1" intensity="2"/>)"},
    {"wax", kFloor + kLamp + kSky + R"(
        <instance><shape type="sphere"/><bsdf type="disney" subsurface="0.7" roughness="0.3"/></instance>)"},
    {"gel and a leaf", kFloor + kLamp + kSky + R"(
        <instance><shape type="rectangle"/><bsdf type="transparent" transmittance="0.9,0.3,0.2"/><transform><translate z="-1"/></transform></instance>
        <instance><shape type="sphere"/><bsdf type="translucent"/><transform><translate z="1"/></transform></instance>)"},
    {"layers", kFloor + kLamp + kSky + R"(
        <instance><shape type="sphere"/><bsdf type="layered">
          <layer opacity="0.4" label="dirt"><bsdf type="diffuse" albedo="0.3,0.2,0.1"/></layer>
          <layer opacity="0.7" label="paint"><bsdf type="coat" roughness="0" label="varnish"><bsdf type="disney" metallic="0.6" roughness="0.3"/></bsdf></layer>
          <layer><bsdf type="mix" label1="mirror"><bsdf type="principled"/><bsdf type="conductor"/></bsdf></layer></bsdf></instance>
        <instance><shape type="sphere"/><bsdf type="coat" label="varnish"><bsdf type="translucent"/></bsdf><transform><scale value="0.5"/><translate x="-1.2" y="-0.5"/></transform></instance>)"},
    {"layers, by kinds of scattering", kFloor + kLamp + R"(
        <instance><shape type="sphere"/><bsdf type="mix" label0="plastic" label1="metal"><bsdf type="principled" roughness="0.5"/><bsdf type="coat"><bsdf type="roughconductor" roughness="0.5"/></bsdf></bsdf></instance>
        <light type="point" position="2,2,-2" power="30" diffuse="0.5"/>)"},
};

RenderResult render_aovs(std::string const& contents, std::vector<Aov> aovs, int spp = 16,
                         std::string const& integrator = "type=\"path\" depth=\"8\"") {
    TestScene const scene = make_scene(contents, integrator);
    RenderOptions options;
    options.picture.aovs = std::move(aovs);
    options.limits.spp = spp;
    return render(*scene.stage, scene.job, options);
}

/// Channels of a film by name.
class Channels {
  public:
    explicit Channels(film::Film const& film) : image_(film.image()) {}
    size_t size() const { return image_.pixels.size() / size_t(image_.channels); }
    bool has(std::string const& name) const { return index(name) < image_.names.size(); }
    float at(std::string const& name, size_t pixel) const {
        if (!has(name)) throw std::runtime_error("no channel " + name);
        return image_.pixels[pixel * size_t(image_.channels) + index(name)];
    }
    float at(std::string const& name, int x, int y) const {
        return at(name, size_t(y) * size_t(image_.width) + size_t(x));
    }
    std::vector<std::string> const& names() const { return image_.names; }

  private:
    size_t index(std::string const& name) const {
        return size_t(std::find(image_.names.begin(), image_.names.end(), name) -
                      image_.names.begin());
    }
    image::Image image_;
};

/// The largest difference between the beauty and the sum of `layers`, relative to the beauty.
double worst_sum(Channels const& channels, std::vector<std::string> const& layers) {
    double worst = 0;
    for (size_t i = 0; i < channels.size(); ++i)
        for (char const* c : {"R", "G", "B"}) {
            double sum = 0;
            for (std::string const& layer : layers) sum += double(channels.at(layer + "." + c, i));
            double const beauty = double(channels.at(c, i));
            worst = std::max(worst, std::abs(sum - beauty) / std::max(beauty, 1e-3));
        }
    return worst;
}

std::vector<Aov> const kComponentAovs{Aov::emission,
                                      Aov::background,
                                      Aov::direct_diffuse,
                                      Aov::indirect_diffuse,
                                      Aov::direct_specular,
                                      Aov::indirect_specular,
                                      Aov::direct_transmission,
                                      Aov::indirect_transmission,
                                      Aov::direct_volume,
                                      Aov::indirect_volume,
                                      Aov::direct_subsurface,
                                      Aov::indirect_subsurface};

TEST(Aovs, LightFromBelowIsTheShareOfTheMatter) {
    auto const of = [](char const* subsurface) {
        return Channels(
            render_aovs(kCamera + kSky +
                            R"(<instance><shape type="sphere"/><bsdf type="disney" subsurface=")" +
                            subsurface + R"("/></instance>)",
                        {Aov::direct_diffuse, Aov::direct_subsurface}, 256)
                .film);
    };
    Channels const some = of("0.25"), all = of("1"), none = of("0");
    double diffuse = 0, below = 0, whole = 0;
    for (size_t i = 0; i < some.size(); ++i) {
        diffuse += double(some.at("direct_diffuse.G", i));
        below += double(some.at("direct_subsurface.G", i));
        whole += double(none.at("direct_diffuse.G", i));
        EXPECT_EQ(none.at("direct_subsurface.G", i), 0);
        EXPECT_EQ(all.at("direct_diffuse.G", i), 0);
    }
    EXPECT_NEAR(below / (diffuse + below), 0.25, 1e-5); // of one shape: exact but for rounding
    EXPECT_NEAR((diffuse + below) / whole, 1, 3e-3);    // noise of 300,000 samples
}

/// The layers whose names begin so.
std::vector<std::string> layers_like(Channels const& channels, std::string const& prefix) {
    std::vector<std::string> layers;
    for (std::string const& n : channels.names())
        if (n.starts_with(prefix) && n.ends_with(".R")) layers.push_back(n.substr(0, n.size() - 2));
    return layers;
}

TEST(Aovs, ComponentsGroupsAndLayersAddUpToBeauty) {
    for (auto const& [name, contents] : kScenes)
        for (char const* strategy : {"mis", "nee", "bsdf"}) {
            SCOPED_TRACE(name + ", " + strategy);
            std::vector<Aov> aovs = kComponentAovs;
            aovs.push_back(Aov::light_groups);
            aovs.push_back(Aov::layers);
            RenderResult const r =
                render_aovs(kCamera + contents, aovs, 16,
                            "type=\"path\" depth=\"8\" strategy=\"" + std::string(strategy) + "\"");
            EXPECT_EQ(r.bad_samples, 0u);
            Channels const channels(r.film);
            std::vector<std::string> components;
            for (Aov aov : kComponentAovs) components.emplace_back(scene::kAovs[size_t(aov)].name);
            std::vector<std::string> const groups = layers_like(channels, "light_"),
                                           layers = layers_like(channels, "layer_");
            EXPECT_GE(groups.size(), 2u);
            EXPECT_EQ(layers.size(), name == "layers" ? 5u : name.starts_with("layers") ? 3u : 1u);
            double const by_component = worst_sum(channels, components),
                         by_group = worst_sum(channels, groups),
                         by_layer = worst_sum(channels, layers);
            EXPECT_LT(by_component, 1e-5);
            EXPECT_LT(by_group, 1e-5);
            EXPECT_LT(by_layer, 1e-5);
            if (std::string(strategy) == "mis")
                std::printf("  %s: components to %.1e, groups to %.1e, layers to %.1e\n",
                            name.c_str(), by_component, by_group, by_layer);
        }
}

TEST(Aovs, RemovedIsWhatClampingTook) {
    std::string const contents = kCamera + kScenes.at("glass and a medium inside");
    Channels const whole(render_aovs(contents, {}).film);
    Channels const cut(
        render_aovs(contents, {Aov::removed}, 16, "type=\"path\" depth=\"8\" indirectClamp=\"0.2\"")
            .film);
    double removed = 0;
    for (size_t i = 0; i < whole.size(); ++i) {
        removed += double(cut.at("removed.G", i));
        EXPECT_NEAR(cut.at("G", i) + cut.at("removed.G", i), whole.at("G", i),
                    1e-5f * std::max(whole.at("G", i), 1.f));
    }
    EXPECT_GT(removed / double(whole.size()), 0.001);
}

TEST(Aovs, LeaveTheBeautyAlone) {
    std::vector<Aov> all;
    for (size_t i = 0; i < film::kAovCount; ++i) all.push_back(Aov(i));
    for (auto const& [name, contents] : kScenes) {
        SCOPED_TRACE(name);
        EXPECT_EQ(render_aovs(kCamera + contents, all, 4).image.pixels,
                  render_aovs(kCamera + contents, {}, 4).image.pixels);
    }
}

TEST(Aovs, AreTheSameHoweverTheyAreCutUp) {
    std::vector<Aov> all;
    for (size_t i = 0; i < film::kAovCount; ++i) all.push_back(Aov(i));
    TestScene const scene = make_scene(kCamera + kScenes.at("glass and a medium inside"));
    RenderOptions options;
    options.picture.aovs = all;
    options.limits.spp = 5;
    options.threads = 1;
    RenderResult const one = render(*scene.stage, scene.job, options);
    options.threads = 4;
    options.tile_size = 7;
    EXPECT_TRUE(render(*scene.stage, scene.job, options).film == one.film);
    // Tiles merge to the whole.
    film::Film merged(one.film.region(), one.film.layout());
    for (film::Region const& part :
         {film::Region{{0, 0}, {17, 30}}, film::Region{{17, 0}, {40, 30}}}) {
        options.picture.crop = part;
        merged.merge(render(*scene.stage, scene.job, options).film);
    }
    EXPECT_TRUE(merged == one.film);
}

TEST(Aovs, ComponentsDoNotDependOnTheStrategy) {
    // Half diffuse, half glossy, under a lamp: light sampling and scattering give each kind of lobe
    // the same part. Means over the picture, by independent seeds.
    std::string const contents = R"(
        <camera type="orthographic" width="24" height="24" scale="1"/>
        <instance><shape type="rectangle"/><bsdf type="principled" baseColor="0.8,0.5,0.2" metallic="0" specular="1" roughness="0.5"/><transform><scale value="2"/><rotate axis="0,1,0" angle="180"/><translate z="1"/></transform></instance>
        <light type="area"><instance><shape type="rectangle"/><emission type="lambertian" emission="2"/><transform><scale value="1.5"/><translate z="-2"/></transform></instance></light>)";
    constexpr int seeds = 24;
    std::map<std::string, std::array<Estimate, 2>> estimates; // diffuse, specular
    for (char const* strategy : {"mis", "nee", "bsdf"}) {
        TestScene const scene = make_scene(contents, "type=\"path\" depth=\"2\" strategy=\"" +
                                                         std::string(strategy) + "\"");
        RenderOptions options;
        options.picture.aovs = {Aov::direct_diffuse, Aov::direct_specular};
        options.limits.spp = 16;
        double sums[2]{}, squares[2]{};
        for (int seed = 0; seed < seeds; ++seed) {
            options.picture.seed = uint32_t(100 * estimates.size() + size_t(seed));
            Channels const c(render(*scene.stage, scene.job, options).film);
            int k = 0;
            for (char const* name : {"direct_diffuse.R", "direct_specular.R"}) {
                double mean = 0;
                for (size_t i = 0; i < c.size(); ++i) mean += double(c.at(name, i));
                mean /= double(c.size());
                sums[k] += mean;
                squares[k++] += mean * mean;
            }
        }
        for (int k = 0; k < 2; ++k) {
            double const mean = sums[k] / seeds;
            EXPECT_GT(mean, 0.01);
            estimates[strategy][size_t(k)] = {mean,
                                              (squares[k] / seeds - mean * mean) / (seeds - 1)};
        }
    }
    for (size_t k = 0; k < 2; ++k)
        for (char const* other : {"nee", "bsdf"})
            EXPECT_GT(difference_p_value(estimates["mis"][k], estimates[other][k]), sidak(0.01, 4))
                << other << (k ? " specular" : " diffuse");
}

/// A wall of three layers, of which those not in `kept` are black, under a lamp and a sky.
std::string layered_wall(std::string const& kept) {
    auto const layer = [&](std::string const& name, std::string const& attributes,
                           std::string const& bsdf) {
        bool const is_kept = kept.find(name) != std::string::npos;
        return "<layer label=\"" + name + "\" " + attributes + ">" +
               (is_kept ? bsdf : "<bsdf type=\"diffuse\" albedo=\"0\"/>") + "</layer>";
    };
    return R"(<camera type="orthographic" width="16" height="16" scale="1"/>
        <instance><shape type="rectangle"/><bsdf type="layered">)" +
           layer("dust", "opacity=\"0.3\"", "<bsdf type=\"diffuse\" albedo=\"0.8,0.5,0.2\"/>") +
           layer(
               "paint", "opacity=\"0.6\"",
               R"(<bsdf type="principled" baseColor="0.2,0.5,0.8" metallic="0" specular="1" roughness="0.5"/>)") +
           layer("metal", "", R"(<bsdf type="roughconductor" roughness="0.4"/>)") +
           R"(</bsdf><transform><scale value="2"/><rotate axis="0,1,0" angle="180"/><translate z="1"/></transform></instance>
        <light type="area"><instance><shape type="rectangle"/><emission type="lambertian" emission="2"/><transform><scale value="1.5"/><translate x="1" z="-2"/></transform></instance></light>)" +
           kSky;
}

/// The mean over a picture of a channel, from independent seeds.
Estimate over_seeds(std::string const& contents, std::vector<Aov> const& aovs,
                    std::string const& channel, std::string const& integrator, uint32_t seed) {
    TestScene const scene = make_scene(contents, integrator);
    RenderOptions options;
    options.picture.aovs = aovs;
    options.limits.spp = 16;
    std::vector<double> means;
    for (options.picture.seed = seed; options.picture.seed < seed + 24; ++options.picture.seed) {
        Channels const c(render(*scene.stage, scene.job, options).film);
        double sum = 0;
        for (size_t i = 0; i < c.size(); ++i) sum += double(c.at(channel, i));
        means.push_back(sum / double(c.size()));
    }
    return estimate(means);
}

TEST(Layers, AreWhatIsLeftWithTheOthersBlack) {
    // Whatever finds the light, and also where diffuse and glossy scattering are told apart.
    uint32_t seed = 1;
    for (std::string const how :
         {"strategy=\"mis\"", "strategy=\"nee\"", "strategy=\"bsdf\"", "caustics=\"false\""})
        for (std::string const layer : {"dust", "paint", "metal"}) {
            std::string const integrator = "type=\"path\" depth=\"2\" " + how;
            Estimate const part = over_seeds(layered_wall("dust paint metal"), {Aov::layers},
                                             "layer_" + layer + ".G", integrator, seed += 100),
                           alone =
                               over_seeds(layered_wall(layer), {}, "G", integrator, seed += 100);
            EXPECT_GT(part.mean, 0.01);
            EXPECT_GT(difference_p_value(part, alone), sidak(0.01, 12))
                << layer << ", " << how << ": " << part.mean << " against " << alone.mean;
        }
}

TEST(Layers, AreNamedByTheInnermostLabel) {
    Channels const c(render_aovs(kCamera + R"(
        <instance><shape type="sphere"/><bsdf type="layered">
          <layer opacity="0.5" label="outer"><bsdf type="mix" amount="0.25" label1="inner"><bsdf type="diffuse"/><bsdf type="diffuse"/></bsdf></layer>
          <layer><bsdf type="diffuse"/></layer></bsdf></instance>
        <light type="envmap"><texture type="constant" value="1"/></light>)",
                                 {Aov::layers}, 4)
                         .film);
    EXPECT_EQ(layers_like(c, "layer_"),
              (std::vector<std::string>{"layer_default", "layer_outer", "layer_inner"}));
    EXPECT_NEAR(c.at("layer_outer.R", 20, 15), 0.375 * c.at("R", 20, 15), 1e-5);
    EXPECT_NEAR(c.at("layer_inner.R", 20, 15), 0.125 * c.at("R", 20, 15), 1e-5);
    EXPECT_EQ(c.at("layer_default.R", 0, 0), 1) << "the background is in no layer";
}

TEST(Aovs, OfTheFirstSurfaceAreItsOwn) {
    std::string const contents = R"(
        <camera type="perspective" width="40" height="40" fov="40"/>
        <instance id="wall"><shape type="rectangle"/><bsdf type="diffuse" albedo="0.25,0.5,0.75"/><transform><scale x="9" y="9"/><rotate axis="0,1,0" angle="180"/><translate z="5"/></transform></instance>
        <instance><shape type="sphere"/><bsdf type="diffuse" albedo="1"/><transform><translate z="3"/><scale value="1"/></transform></instance>)";
    Channels const c(
        render_aovs(contents, {Aov::depth, Aov::position, Aov::normal, Aov::normal_geometric,
                               Aov::uv, Aov::albedo, Aov::alpha, Aov::sample_count})
            .film);
    EXPECT_NEAR(c.at("Z", 1, 1), 5, 1e-5) << "along the axis, not along the ray";
    EXPECT_NEAR(c.at("P.Z", 1, 1), 5, 1e-5);
    EXPECT_NEAR(c.at("N.Z", 1, 1), -1, 1e-6) << "towards the camera";
    EXPECT_NEAR(c.at("Ng.Z", 1, 1), -1, 1e-6);
    EXPECT_NEAR(c.at("albedo.G", 1, 1), 0.5f, 1e-6);
    EXPECT_NEAR(c.at("Z", 20, 20), 2, 1e-2);
    EXPECT_LT(c.at("N.Z", 20, 20), -0.99f);
    EXPECT_EQ(c.at("A", 1, 1), 1);
    EXPECT_EQ(c.at("sample_count", 7, 7), 16);
    EXPECT_NE(c.at("UV.U", 1, 1), c.at("UV.U", 38, 1));
}

TEST(Aovs, AlphaIsWhatIsCovered) {
    std::string const contents = R"(
        <camera type="orthographic" width="30" height="10" scale="1.5"/>
        <instance alpha="0.3"><shape type="rectangle"/><bsdf type="diffuse"/><transform><scale value="0.5"/><translate x="-1" z="1"/></transform></instance>
        <instance><shape type="rectangle"/><bsdf type="transparent" transmittance="0.2,0.5,0.8"/><transform><scale value="0.5"/><translate z="1"/></transform></instance>
        <instance><shape type="rectangle"/><bsdf type="dielectric"/><transform><scale value="0.5"/><translate x="1" z="1"/></transform></instance>
        <light type="envmap"><texture type="constant" value="1"/></light>)";
    Channels const c(render_aovs(contents, {Aov::alpha}, 1024).film);
    // 4.5 standard deviations of a fraction of 1024 samples.
    EXPECT_NEAR(c.at("A", 5, 5), 0.3, 4.5 * std::sqrt(0.3 * 0.7 / 1024));
    EXPECT_NEAR(c.at("A", 15, 5), 0.5, 1e-5) << "a gel covers by what it takes";
    EXPECT_EQ(c.at("A", 25, 5), 1) << "glass is there";
    Channels const empty(render_aovs(R"(<camera type="orthographic" width="4" height="4"/>
        <light type="envmap"><texture type="constant" value="1"/></light>)",
                                     {Aov::alpha, Aov::depth})
                             .film);
    EXPECT_EQ(empty.at("A", 2, 2), 0);
    EXPECT_EQ(empty.at("Z", 2, 2), film::kNoDepth);
}

TEST(Guides, FollowMirrorsAndGlass) {
    // A mirror at 45 degrees shows a red wall on the right; a pane of glass is in front of a green
    // one.
    std::string const contents = R"(
        <camera type="orthographic" width="20" height="10" scale="2"/>
        <instance><shape type="rectangle"/><bsdf type="conductor" reflectance="0.5,0.9,0.9"/><transform><scale value="0.9"/><rotate axis="0,1,0" angle="-135"/><translate x="-1" z="2"/></transform></instance>
        <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.8,0.1,0.1"/><transform><scale value="9"/><rotate axis="0,1,0" angle="90"/><translate x="-7" z="0"/></transform></instance>
        <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.1,0.8,0.1"/><transform><scale value="9"/><rotate axis="0,1,0" angle="180"/><translate z="9"/></transform></instance>
        <instance><shape type="sphere"/><bsdf type="dielectric" ior="1.0001"/><transform><scale value="0.9"/><translate x="1" z="3"/></transform></instance>)";
    Channels const c(
        render_aovs(contents, {Aov::denoise_albedo, Aov::denoise_normal, Aov::albedo}, 64).film);
    EXPECT_NEAR(c.at("denoise_albedo.R", 5, 5), 0.8 * 0.5, 1e-4)
        << "the mirror's colour multiplies";
    EXPECT_NEAR(c.at("denoise_albedo.G", 5, 5), 0.1 * 0.9, 1e-4);
    EXPECT_NEAR(std::abs(c.at("denoise_normal.X", 5, 5)), 1, 1e-4);
    EXPECT_NEAR(c.at("albedo.R", 5, 5), 0.5, 1e-4) << "of the first surface";
    EXPECT_NEAR(c.at("denoise_albedo.G", 15, 5), 0.8, 1e-2) << "through glass";
    EXPECT_NEAR(c.at("denoise_normal.Z", 15, 5), -1, 1e-2);
}

TEST(Guides, FollowNearlySmoothSurfaces) {
    // A lacquered black card at 45 degrees shows a red wall on the right; a ball of nearly smooth
    // glass, which hardly bends light, is in front of a green one.
    auto const guides = [](std::string const& glass) {
        return Channels(
            render_aovs(
                R"(
        <camera type="orthographic" width="20" height="10" scale="2"/>
        <instance><shape type="rectangle"/><bsdf type="disney" baseColor="0" specular="0" clearcoat="1" clearcoatRoughness="0.05"/><transform><scale value="0.9"/><rotate axis="0,1,0" angle="-135"/><translate x="-1" z="2"/></transform></instance>
        <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.8,0.1,0.1"/><transform><scale value="9"/><rotate axis="0,1,0" angle="90"/><translate x="-7" z="0"/></transform></instance>
        <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.1,0.8,0.1"/><transform><scale value="9"/><rotate axis="0,1,0" angle="180"/><translate z="9"/></transform></instance>
        <instance><shape type="sphere"/>)" +
                    glass +
                    R"(<transform><scale value="0.9"/><translate x="1" z="3"/></transform></instance>)",
                {Aov::denoise_albedo}, 256)
                .film);
    };
    for (std::string const glass :
         {R"(<bsdf type="roughdielectric" ior="1.01" roughness="0.05"/>)",
          R"(<bsdf type="roughdielectric" ior="1.01" roughness="0.2" distribution="beckmann"/>)",
          R"(<bsdf type="microfacet" ior="1.01" roughness="0.1" distribution="ashikhminShirley"/>)",
          R"(<bsdf type="disney" baseColor="1" ior="1.01" transmission="1" roughness="0.1"/>)"}) {
        Channels const c = guides(glass);
        EXPECT_NEAR(c.at("denoise_albedo.R", 15, 5), 0.1, 0.02) << glass;
        EXPECT_NEAR(c.at("denoise_albedo.G", 15, 5), 0.8, 0.02) << glass;
        EXPECT_NEAR(c.at("denoise_albedo.R", 5, 5) / c.at("denoise_albedo.G", 5, 5), 8, 0.1);
    }
    // What blurs is seen for itself.
    Channels const frosted = guides(R"(<bsdf type="roughdielectric" ior="1.01" roughness="0.5"/>)");
    EXPECT_NEAR(frosted.at("denoise_albedo.R", 15, 5), 1, 0.02);
}

TEST(Guides, AreFilteredLikeBeauty) {
    // Out of focus the edge between dark and bright is as wide in the guide as in the picture of
    // the same pattern that shines.
    auto const wall = [](std::string const& surface) {
        return R"(
        <camera type="thinlens" width="40" height="8" fov="50" lensRadius="0.4" focalDistance="2"/>
        <instance><shape type="rectangle"/>)" +
               surface +
               R"(<transform><scale x="40" y="40"/><rotate axis="0,1,0" angle="180"/><translate z="8"/></transform></instance>)";
    };
    std::string const pattern = R"(type="checkerboard" scale="2,1" color0="0.1" color1="0.9"/>)";
    Channels const c(
        render_aovs(wall("<bsdf type=\"diffuse\"><texture name=\"albedo\" " + pattern + "</bsdf>"),
                    {Aov::denoise_albedo}, 256)
            .film);
    Channels const shining(render_aovs(wall("<emission type=\"lambertian\"><texture "
                                            "name=\"emission\" " +
                                            pattern + "</emission>"),
                                       {}, 256)
                               .film);
    int between = 0;
    for (int x = 0; x < 40; ++x) {
        float const guide = c.at("denoise_albedo.R", x, 4);
        EXPECT_NEAR(guide, shining.at("R", x, 4), 1e-6f);
        between += guide > 0.15f && guide < 0.85f;
    }
    EXPECT_GT(between, 3) << "no edge, or a sharp one";
}

/// A square lamp in the middle of the picture, four away, and what is between it and the camera.
std::string lamp_seen(std::string const& camera, std::string const& between = "") {
    return "<camera width=\"20\" height=\"20\" fov=\"40\" " + camera + "/>" + between + R"(
        <light type="area"><instance><shape type="rectangle"/><emission type="lambertian" emission="9,8,7"/><transform><scale value="0.7"/><rotate axis="0,1,0" angle="180"/><translate z="4"/></transform></instance></light>
        <light type="envmap"><texture type="constant" value="0.3,0.4,0.5"/></light>)";
}

TEST(Guides, KeepLightInFocusAlone) {
    // The corner shows the sky, the middle the lamp. The lens spreads a point at distance z over
    // 0.2 |1 / focus - 1 / z| / 0.0182 pixels.
    auto const kept = [](std::string const& contents) {
        Channels const c(render_aovs(contents, {Aov::denoise_albedo}).film);
        return std::pair(c.at("denoise_kept.G", 10, 10), c.at("denoise_kept.G", 0, 0));
    };
    using Kept = std::pair<float, float>;
    std::string const pinhole = "type=\"perspective\"",
                      lens = "type=\"thinlens\" lensRadius=\"0.2\" focalDistance=";
    EXPECT_EQ(kept(lamp_seen(pinhole)), Kept(8, 0.4f));
    EXPECT_EQ(kept(lamp_seen(lens + "\"4.5\"")), Kept(8, 0)) << "0.3 and 2.4 pixels";
    EXPECT_EQ(kept(lamp_seen(lens + "\"15\"")), Kept(0, 0.4f)) << "2.0 and 0.7";
    EXPECT_EQ(kept(lamp_seen(lens + "\"2\"")), Kept(0, 0)) << "2.7 and 5.5";
    std::string const pane =
        R"(<instance alpha="ALPHA"><shape type="rectangle"/>BSDF<transform><translate z="2"/></transform></instance>)";
    auto const behind = [&](std::string const& alpha, std::string const& bsdf) {
        std::string text = pane;
        text.replace(text.find("ALPHA"), 5, alpha);
        text.replace(text.find("BSDF"), 4, bsdf);
        return lamp_seen(pinhole, text);
    };
    EXPECT_EQ(kept(behind("0.5", "<bsdf type=\"diffuse\"/>")).first, 0) << "noisy holes";
    EXPECT_EQ(kept(behind("1", "<bsdf type=\"transparent\" transmittance=\"0.5\"/>")).first, 0);
    EXPECT_EQ(
        kept(lamp_seen(pinhole, R"(<medium type="homogeneous" absorption="0" scatter="0.1"/>)")),
        Kept(0, 0));
}

/// A mask by the specification's procedure: the coverage of every rank whose id is that of `name`.
double mask(Channels const& c, std::string const& layer, std::string const& name, size_t pixel) {
    uint32_t const id = film::cryptomatte_id(name);
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        std::string const n = layer + "0" + std::to_string(i);
        if (std::bit_cast<uint32_t>(c.at(n + ".R", pixel)) == id)
            sum += double(c.at(n + ".G", pixel));
        if (std::bit_cast<uint32_t>(c.at(n + ".B", pixel)) == id)
            sum += double(c.at(n + ".A", pixel));
    }
    return sum;
}

TEST(Cryptomatte, HashesAsPublished) {
    // Vectors of the reference implementation, and keys that renderers in use write.
    EXPECT_EQ(film::murmur_hash3(""), 0u);
    EXPECT_EQ(film::murmur_hash3("", 1), 0x514e28b7u);
    EXPECT_EQ(film::murmur_hash3("test"), 0xba6bd213u);
    EXPECT_EQ(film::murmur_hash3("Hello, world!"), 0xc0363e43u);
    EXPECT_EQ(film::murmur_hash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
    EXPECT_EQ(film::murmur_hash3("crypto_material") >> 4, 0xbda530au);
    for (int i = 0; i < 100000; ++i) {
        uint32_t const id = film::cryptomatte_id("object " + std::to_string(i));
        EXPECT_TRUE(std::isnormal(std::bit_cast<float>(id)));
        uint32_t const hash = film::murmur_hash3("object " + std::to_string(i));
        EXPECT_TRUE(id == hash || id == (hash ^ 0x00800000u));
    }
}

TEST(Cryptomatte, SaysHowToReadIt) {
    auto const m =
        film::cryptomatte_metadata("CryptoObject", {{"a \"b\"", 0x12345678u}, {"c", 0xau}});
    EXPECT_EQ(m.at("cryptomatte/3ae39a5/name"), "CryptoObject");
    EXPECT_EQ(m.at("cryptomatte/3ae39a5/hash"), "MurmurHash3_32");
    EXPECT_EQ(m.at("cryptomatte/3ae39a5/conversion"), "uint32_to_float32");
    EXPECT_EQ(m.at("cryptomatte/3ae39a5/manifest"), R"({"a \"b\"":"12345678","c":"0000000a"})");
}

TEST(Cryptomatte, MasksAreTheObjectsOwnCoverage) {
    // The matte by hand: each object in turn shines, all else is black.
    std::string const names[]{"front", "back", "crowd"};
    auto const contents = [&](std::string const& shining) {
        auto const paint = [&](std::string const& name) {
            return "<bsdf id=\"m_" + name + "\" type=\"diffuse\" albedo=\"0\"/>" +
                   std::string(name == shining ? "<emission type=\"lambertian\" emission=\"1\"/>"
                                               : "");
        };
        return R"(<camera type="thinlens" width="40" height="30" fov="50" lensRadius="0.2" focalDistance="3"/>
            <instance id="front" alpha="0.5"><shape type="rectangle"/>)" +
               paint("front") +
               R"(<transform><rotate axis="0,1,0" angle="160"/><translate x="-0.5" z="3"/></transform></instance>
            <instance id="back"><shape type="sphere"/>)" +
               paint("back") + R"(<transform><translate x="0.5" z="4"/></transform></instance>
            <instance id="crowd"><shape type="group">
              <instance id="one"><shape type="sphere"/><transform><scale value="0.2"/><translate x="0.9" y="0.5" z="2.5"/></transform></instance>
              <instance id="two"><shape type="sphere"/><transform><scale value="0.2"/><translate x="0.9" y="-0.5" z="2.5"/></transform></instance>
            </shape>)" +
               paint("crowd") + "</instance>";
    };
    Channels const ids(
        render_aovs(contents(""), {Aov::crypto_object, Aov::crypto_material, Aov::crypto_asset}, 64)
            .film);
    double worst = 0;
    for (std::string const& name : names) {
        Channels const matte(render_aovs(contents(name), {}, 64).film);
        for (size_t i = 0; i < ids.size(); ++i) {
            double const wanted = double(matte.at("R", i));
            double const asset = mask(ids, "CryptoAsset", name, i);
            double const material = mask(ids, "CryptoMaterial", "m_" + name, i);
            double const object = name == "crowd" ? mask(ids, "CryptoObject", "crowd/one", i) +
                                                        mask(ids, "CryptoObject", "crowd/two", i)
                                                  : mask(ids, "CryptoObject", name, i);
            for (double found : {asset, material, object})
                worst = std::max(worst, std::abs(found - wanted));
        }
    }
    std::printf("  masks to %.1e\n", worst);
    EXPECT_LT(worst, 1e-6);
}

TEST(Aovs, OfOtherIntegratorsAreAnError) {
    EXPECT_THROW(render_aovs(kCamera, {Aov::albedo}, 1, "type=\"normal\""), InputError);
}

TEST(Aovs, OfTheSceneAreMade) {
    RenderResult const r =
        render_aovs(kCamera + kFloor, {Aov::uv}, 1,
                    "type=\"path\" aovs=\"depth, albedo crypto_object\" cryptomatteLevels=\"4\"");
    Channels const c(r.film);
    EXPECT_TRUE(c.has("Z") && c.has("albedo.R") && c.has("UV.V") && c.has("CryptoObject01.A"));
    EXPECT_FALSE(c.has("CryptoObject02.R") || c.has("A"));
}

TEST(Groups, ComeFromTheLightThenFromTheInstance) {
    RenderResult const r = render_aovs(kCamera + R"(
        <light type="area"><instance group="inner"><shape type="rectangle"/><emission type="lambertian" emission="1"/><transform><translate z="2"/></transform></instance></light>
        <light type="area" group="outer"><instance group="ignored"><shape type="rectangle"/><emission type="lambertian" emission="1"/><transform><translate x="4" z="2"/></transform></instance></light>
        <instance group="glow"><shape type="sphere"/><emission type="lambertian" emission="1"/></instance>)",
                                       {Aov::light_groups}, 1);
    Channels const c(r.film);
    for (char const* name : {"light_default.R", "light_inner.G", "light_outer.B", "light_glow.R"})
        EXPECT_TRUE(c.has(name)) << name;
}

} // namespace
} // namespace weft::session
