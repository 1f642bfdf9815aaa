// What makes a render in parts the same as a render at once.
#include <gtest/gtest.h>

#include <cstring>

#include "image/texture_cache.h"
#include "scene/scene_hash.h"
#include "session/passes.h"
#include "session/render_state.h"
#include "session/tile_renderer.h"
#include "tests/support/scenes.h"

namespace weft::session {
namespace {

using namespace weft::testing;

TestScene small_scene(std::string const& more = "", std::string const& folder = "") {
    return make_scene(R"(
        <camera type="perspective" width="45" height="30" fov="50"><transform><lookat origin="0,1,-4" target="0,0,0" up="0,1,0"/></transform></camera>
        <instance id="ball"><shape type="sphere"/><bsdf type="principled" roughness="0.3"/></instance>
        <light type="point" position="2,3,-4" power="300"/>
        <light type="envmap"><texture type="constant" value="0.3,0.4,0.5"/></light>)" +
                          more,
                      "type=\"path\" depth=\"6\" aovs=\"depth, albedo, crypto_object\"", folder,
                      "type=\"sobol\" count=\"12\"");
}

/// Lit through a window of this width.
TestScene scene_with_portal(std::string const& width) {
    return small_scene(
        R"(<light type="envmap"><texture type="constant" value="1"/><portal><transform>
        <scale x=")" +
        width + R"(" y="1"/><translate y="2" z="2"/></transform></portal></light>)");
}

/// Lit by a lamp whose file, always of one name, says this intensity straight down.
TestScene scene_with_lamp(std::string const& candela) {
    TemporaryFolder const folder;
    std::ofstream(folder / "lamp.ies")
        << "IESNA91\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n" + candela + " 20\n";
    return small_scene("<light type=\"ies\" filename=\"lamp.ies\" position=\"0,2,0\"/>",
                       folder.path());
}

Identity identity_of(TestScene const& scene, RenderOptions const& options) {
    return identify(make_plan(*scene.stage, scene.job, options), options,
                    scene::scene_hash(*scene.job.scene));
}

RenderState part_of(TestScene const& scene, Part const& part, RenderOptions options = {}) {
    options.picture.part = part;
    options.tile_size = 8;
    Plan const plan = make_plan(*scene.stage, scene.job, options);
    options.identity = identity_of(scene, options);
    return to_state(render(plan, options), plan, options);
}

std::string message(std::vector<RenderState> parts) {
    std::vector<std::string> names;
    for (size_t i = 0; i < parts.size(); ++i) names.push_back("part" + std::to_string(i));
    try {
        merge(std::move(parts), names);
        return "";
    } catch (InputError const& e) {
        return e.what();
    }
}

/// The hash of a scene with a texture in `folder`, read through a cache with these options.
uint64_t hash_of_textured(std::string const& folder, image::TextureCacheOptions const& options) {
    auto const file = io::parse_scene(
        R"(<scene><camera type="perspective"/><instance><shape type="sphere"/><bsdf type="diffuse">
        <texture name="albedo" type="image" filename="map.exr"/></bsdf></instance></scene>)",
        "test", folder, {}, std::make_shared<image::TextureCache>(options));
    return scene::scene_hash(*file.jobs.at(0).scene);
}

TEST(SceneHash, IsOfTheContentsOfFiles) {
    TemporaryFolder const here, there, cache;
    image::TextureCacheOptions memory, tiles;
    tiles.small_texels = 0;
    tiles.folder = cache.path();
    image::Image picture = image::make_image(96, 64, 3);
    image::write_exr(here / "map.exr", picture);
    image::write_exr(there / "map.exr", picture);
    uint64_t const hash = hash_of_textured(here.path(), memory);
    EXPECT_EQ(hash_of_textured(there.path(), memory), hash) << "wherever it lies";
    EXPECT_EQ(hash_of_textured(there.path(), tiles), hash) << "in memory or not";
    picture.at(70, 40, 1) = 0.5f;
    image::write_exr(there / "map.exr", picture);
    uint64_t const changed = hash_of_textured(there.path(), tiles);
    EXPECT_NE(changed, hash) << "one texel";
    EXPECT_EQ(hash_of_textured(there.path(), memory), changed);
}

TEST(State, IsReadAsItIsWritten) {
    TestScene const scene = small_scene();
    RenderState state = part_of(scene, {2, 3, 0, 0});
    state.note = "a \"note\"\n";
    state.seconds = 1.0 / 3;
    state.pass.active.assign(6 * 4, 1); // blocks of 8 x 8 pixels
    state.pass.active[1] = 0;
    state.bad_samples = 5;
    float const nan = std::numeric_limits<float>::quiet_NaN();
    state.first_bad_samples = {{{3, 4}, 7, Color(nan, 1, -2)}};
    std::string const bytes = write_state(state);
    RenderState const back = read_state(bytes, "name");
    EXPECT_TRUE(back.film == state.film);
    EXPECT_EQ(back.identity, state.identity);
    EXPECT_EQ(back.part, state.part);
    EXPECT_EQ(back.pass, state.pass);
    EXPECT_EQ(back.note, state.note);
    EXPECT_EQ(back.seconds, state.seconds);
    EXPECT_EQ(back.bad_samples, 5u);
    ASSERT_EQ(back.first_bad_samples.size(), 1u);
    EXPECT_EQ(0, std::memcmp(&back.first_bad_samples[0].value, &state.first_bad_samples[0].value,
                             sizeof(Color)));
    EXPECT_EQ(write_state(back), bytes);
}

TEST(State, NotesWhatIsDamaged) {
    TestScene const scene = small_scene();
    std::string const bytes = write_state(part_of(scene, {1, 8, 0, 0}));
    for (size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 97) {
        std::string changed = bytes;
        changed[at] = char(changed[at] ^ 4);
        EXPECT_THROW(read_state(changed, "name"), InputError) << at;
        EXPECT_THROW(read_state(std::string_view(bytes).substr(0, at), "name"), InputError) << at;
    }
}

TEST(State, HasAByteForEachBlock) {
    RenderState state = part_of(small_scene(), {});
    state.pass.active = {1, 0, 1};
    EXPECT_THROW(read_state(write_state(state), "name"), InputError);
}

TEST(Identity, KnowsWhatTexturesAreFilteredFor) {
    // Without --spp the sampler's count is no limit of such a render, but makes its footprints.
    std::string const contents = "<camera type=\"perspective\" width=\"8\" height=\"8\"/>";
    auto const identity = [&](char const* count, RenderOptions const& options) {
        TestScene const scene = make_scene(contents, "type=\"path\"", "",
                                           "type=\"sobol\" count=\"" + std::string(count) + "\"");
        return identity_of(scene, options);
    };
    RenderOptions options;
    options.limits.noise = 0.1;
    EXPECT_NE(difference(identity("4", options), identity("16", options)), "");
    options.limits.spp = 64;
    EXPECT_EQ(difference(identity("4", options), identity("16", options)), "");
    RenderOptions stated;
    stated.limits.spp = 16;
    EXPECT_EQ(difference(identity("4", stated), identity("16", {})), "");
}

TEST(Parts, ShardsJoinToTheSameFilm) {
    TestScene const scene = small_scene();
    RenderState const whole = part_of(scene, {});
    for (int shards : {2, 5}) {
        std::vector<RenderState> parts;
        std::vector<std::string> names;
        for (int k = shards; k >= 1; --k) {
            parts.push_back(part_of(scene, {k, shards, 0, 0}));
            names.push_back(std::to_string(k));
        }
        RenderState const joined = merge(std::move(parts), names);
        EXPECT_TRUE(joined.film == whole.film) << shards << " shards";
        EXPECT_EQ(joined.identity, whole.identity);
    }
}

TEST(Parts, RangesOfSamplesJoinWithinRounding) {
    TestScene const scene = small_scene();
    image::Image const whole = part_of(scene, {}).film.image();
    image::Image const joined = merge({part_of(scene, {1, 1, 5, 12}), part_of(scene, {2, 2, 0, 5}),
                                       part_of(scene, {1, 2, 0, 5})},
                                      {"a", "b", "c"})
                                    .film.image();
    ASSERT_EQ(joined.names, whole.names);
    for (size_t i = 0; i < whole.pixels.size(); ++i) {
        if (std::isnan(whole.pixels[i])) continue; // ids as floats
        ASSERT_FLOAT_EQ(joined.pixels[i], whole.pixels[i]) << i;
    }
}

TEST(Parts, ThatDoNotFitAreRefusedByName) {
    TestScene const scene = small_scene();
    RenderState const one = part_of(scene, {1, 3, 0, 0}), two = part_of(scene, {2, 3, 0, 0}),
                      three = part_of(scene, {3, 3, 0, 0});
    EXPECT_EQ(message({one, two, three}), "");
    EXPECT_EQ(message({one, three}), "cannot merge: missing: shard 2/3");
    EXPECT_EQ(message({one, two, two, three}),
              "cannot merge: shard 2/3 is there twice: part1 and part2");
    EXPECT_EQ(message({one, two, part_of(scene, {2, 2, 0, 0})}),
              "cannot merge: part2 is shard 2/2 with tiles of 8, but part0 is shard 1/3 with tiles "
              "of 8");
    EXPECT_EQ(message({part_of(scene, {1, 1, 0, 5}), part_of(scene, {1, 1, 6, 12})}),
              "cannot merge: missing: samples 5:6");
    EXPECT_EQ(message({part_of(scene, {1, 1, 0, 5})}), "cannot merge: missing: samples 5:12");
    EXPECT_EQ(message({part_of(scene, {1, 1, 0, 6}), part_of(scene, {1, 1, 5, 12})}),
              "cannot merge: samples 5:6 are there twice, in part1 too");
    RenderOptions other;
    other.picture.seed = 3;
    EXPECT_EQ(message({one, two, part_of(scene, {3, 3, 0, 0}, other)}),
              "cannot merge: part2 is of another render than part0 ('here'): seed is '0' here and "
              "'3' there");
    TestScene const foreign = small_scene("<instance><shape type=\"sphere\"/></instance>");
    EXPECT_NE(message({one, two, part_of(foreign, {3, 3, 0, 0})}).find("part2 is of another"),
              std::string::npos);
    for (auto const& [a, b] : {std::pair(scene_with_portal("1"), scene_with_portal("0.5")),
                               std::pair(scene_with_lamp("100"), scene_with_lamp("50"))})
        EXPECT_NE(
            message({part_of(a, {1, 2, 0, 0}), part_of(b, {2, 2, 0, 0})}).find("is of another"),
            std::string::npos);
    RenderState stopped = three;
    stopped.film = film::Film(three.film.region(), three.film.layout());
    EXPECT_EQ(message({one, two, stopped}),
              "cannot merge: part2 (shard 3/3) was stopped before it was done");
}

TEST(Identity, SaysWhatDiffers) {
    TestScene const scene = small_scene();
    RenderOptions a;
    auto const of = [&](RenderOptions const& o) { return identity_of(scene, o); };
    EXPECT_EQ(difference(of(a), of(a)), "");
    std::vector<std::pair<RenderOptions, std::string>> const others{
        {{.limits = {.spp = 13}}, "samples per pixel is '12' here and '13' there"},
        {{.picture = {.crop = film::Region{{0, 0}, {8, 8}}}},
         "crop is '0,0,45,30' here and '0,0,8,8' there"},
        {{.picture = {.seed = 1}}, "seed is '0' here and '1' there"},
        {{.picture = {.aovs = {film::Aov::uv}}}, "channels is 'R G B"},
        {{.picture = {.version = "2"}}, "version is '' here and '2' there"},
        {{.picture = {.kernel = "avx2"}}, "kernel is 'any' here and 'avx2' there"},
    };
    for (auto const& [other, expected] : others)
        EXPECT_EQ(difference(of(a), of(other)).rfind(expected, 0), 0u)
            << difference(of(a), of(other));
    RenderOptions same;
    same.threads = 3;
    same.tile_size = 7;
    EXPECT_EQ(difference(of(a), of(same)), "");
}

/// Returns the state of a render that is stopped after `samples` pixel samples.
RenderState stopped_state(Plan const& plan, RenderOptions const& options, int samples) {
    RenderResult result;
    result.film = film::Film(plan.region, plan.layout);
    integrator::PixelRenderer const renderer(plan.stage, plan.job.integrator, plan.job.sampler,
                                             options.picture.seed, plan.footprint_samples);
    Gate gate;
    TileRenderer tiles(renderer, plan.tags, 0, result, gate);
    ProgressMeter meter(options, 0, 0);
    Passes passes(plan, options, result, gate, meter);
    int left = samples;
    do {
        for (film::Region const& tile : make_tiles(plan.region, options.tile_size))
            tiles.render(
                tile, [&] { return left == 0 || left-- == 0; }, [](uint32_t) {});
    } while (left > 0 && passes.next() == Passes::Next::Pass);
    EXPECT_EQ(left, 0) << "the render has fewer samples";
    return to_state(std::move(result), plan, options);
}

void expect_resumed_is_same(TestScene const& scene, RenderOptions options) {
    Plan const plan = make_plan(*scene.stage, scene.job, options);
    RenderResult const whole = render(plan, options);
    auto const all = int(whole.pixel_samples);
    // Within a pixel and after one, within the first pass and within late ones.
    for (int samples :
         {0, 1, 1000, 45 * 30, 45 * 30 + 1, 3 * 45 * 30, all / 2, all - 777, all - 1}) {
        RenderState const stopped = stopped_state(plan, options, samples);
        EXPECT_FALSE(stopped.film == whole.film);
        RenderState const state = read_state(write_state(stopped), "state");
        options.resume = &state;
        RenderResult const resumed = render(plan, options);
        EXPECT_TRUE(resumed.film == whole.film) << "stopped after " << samples << " of " << all;
        EXPECT_EQ(resumed.least_samples, whole.least_samples);
        EXPECT_EQ(resumed.pixel_samples, whole.pixel_samples);
    }
}

TEST(Resume, GivesTheSameBits) {
    RenderOptions options;
    options.limits.spp = 100;
    expect_resumed_is_same(small_scene(), options);
}

TEST(Resume, OfAnAdaptiveRenderGivesTheSameBits) {
    RenderOptions options;
    options.limits.spp = 200;
    options.limits.noise = 0.04;
    expect_resumed_is_same(small_scene(), options);
}

TEST(Watcher, SeesTheFirstSamplesOfEachPixel) {
    TestScene const scene = make_scene(R"(
        <camera type="perspective" width="6" height="4" fov="50"/>
        <instance><shape type="sphere"/><bsdf type="diffuse"/><transform><translate z="4"/></transform></instance>
        <light type="envmap"><texture type="constant" value="0.3,0.4,0.5"/></light>)");
    RenderOptions options;
    options.limits.spp = 1 << 24;
    std::atomic<bool> cancel{false};
    options.limits.cancel = &cancel;
    std::vector<RenderState> states;
    options.observers.watchers = {{0.001, [&](RenderState const& s) {
                                       states.push_back(s);
                                       cancel = states.size() == 3 && s.film.least_samples() > 0;
                                       if (states.size() == 3) states.erase(states.begin());
                                   }}};
    RenderResult const result = render(*scene.stage, scene.job, options);
    EXPECT_TRUE(result.cancelled);
    integrator::PixelRenderer const renderer(*scene.stage, scene.job.integrator, scene.job.sampler,
                                             0);
    film::Film const& film = states.back().film;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x) {
            uint32_t const n = film.counts(x, y).all;
            EXPECT_GE(result.film.counts(x, y).all, n);
            double sum = 0;
            for (uint32_t s = 0; s < n; ++s) sum += double(renderer.sample({x, y}, s).g);
            ASSERT_EQ(film.mean(x, y).g, float(sum * (1.0 / n)));
        }
}

} // namespace
} // namespace weft::session
