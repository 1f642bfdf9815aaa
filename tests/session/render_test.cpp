// What a session promises: the picture does not depend on how it was made, and no render is lost.
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <unistd.h>

#include "session/render.h"
#include "tests/support/scenes.h"

namespace weft::session {
namespace {

using namespace weft::testing;

std::string const kContents = R"(
    <camera type="thinlens" width="75" height="50" fov="50" lensRadius="0.05" focalDistance="4"><transform><lookat origin="0,1,-4" target="0,0,0" up="0,1,0"/></transform></camera>
    <instance><shape type="rectangle"/><bsdf type="diffuse"><texture name="albedo" type="checkerboard" scale="8,8" color0="0.2" color1="0.8"/></bsdf>
      <transform><scale value="4"/><rotate axis="1,0,0" angle="-90"/><translate y="-1"/></transform></instance>
    <instance alpha="0.7"><shape type="sphere"/><bsdf type="principled" metallic="0.5"/></instance>
    <instance><shape type="sphere"/><bsdf type="dielectric"/><medium type="homogeneous" absorption="1,0.2,0" scatter="0.3"/><transform><scale value="0.6"/><translate x="1.2" z="-0.6"/></transform></instance>
    <light type="area"><instance><shape type="rectangle"/><emission type="lambertian" emission="5"/><transform><rotate axis="1,0,0" angle="90"/><translate y="3"/></transform></instance></light>
    <light type="envmap"><texture type="constant" value="0.3,0.4,0.5"/></light>)";

TestScene scene_with(std::string const& sampler = "type=\"sobol\" count=\"7\"") {
    return make_scene(kContents, "type=\"path\" depth=\"8\"", "", sampler);
}

RenderResult render_with(TestScene const& scene, RenderOptions const& options) {
    return render(*scene.stage, scene.job, options);
}

bool same_bits(std::vector<float> const& a, std::vector<float> const& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Render, IsTheSameHoweverItIsCutUp) {
    for (char const* sampler : {"type=\"sobol\" count=\"7\"", "type=\"halton\" count=\"5\"",
                                "type=\"independent\" count=\"3\""}) {
        TestScene const scene = scene_with(sampler);
        RenderOptions options;
        options.threads = 1;
        RenderResult const one = render_with(scene, options);
        EXPECT_EQ(one.bad_samples, 0u);
        EXPECT_FALSE(one.cancelled);
        for (int threads : {2, 4})
            for (int tile : {7, 32, 64}) {
                options.threads = threads;
                options.tile_size = tile;
                RenderResult const other = render_with(scene, options);
                EXPECT_TRUE(same_bits(one.image.pixels, other.image.pixels))
                    << threads << " threads, tiles of " << tile;
                EXPECT_EQ(other.pixel_samples, 75.0 * 50 * one.least_samples);
            }
    }
}

TEST(Render, AProfileChangesNothingAndAddsUp) {
    TestScene const scene = scene_with();
    RenderOptions options;
    options.threads = 2;
    options.limits.spp = 256;
    RenderResult const plain = render_with(scene, options);
    EXPECT_EQ(plain.profile.samples, 0u);
    options.observers.profile = true;
    RenderResult const profiled = render_with(scene, options);
    EXPECT_TRUE(same_bits(plain.image.pixels, profiled.image.pixels));
    Profile const& p = profiled.profile;
    EXPECT_GT(p.samples, 0u);
    EXPECT_LE(std::accumulate(p.seconds.begin(), p.seconds.end(), 0.0),
              p.processor_seconds * (1 + 1e-9));
    EXPECT_LE(p.processor_seconds, p.thread_seconds * 1.01);
    for (Feature const f : {Feature::ClosestHits, Feature::ShadowRays, Feature::Bsdf})
        EXPECT_GT(p.seconds[size_t(f)], 0) << feature_name(f);
    EXPECT_EQ(p.seconds[size_t(Feature::Textures)], 0) << "there is no image";
}

TEST(Render, FilesAreTheSameBytes) {
    TemporaryFolder const folder;
    TestScene const scene = scene_with();
    auto written = [&](std::string const& name, int threads) {
        RenderOptions options;
        options.threads = threads;
        image::write_exr(folder / name, render_with(scene, options).image);
        std::ifstream in(folder / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    std::string const one = written("one.exr", 1);
    EXPECT_GT(one.size(), 1000u);
    EXPECT_TRUE(one == written("four.exr", 4));
}

TEST(Render, AWorldCommittedAgainGivesTheSame) {
    RenderOptions const options;
    EXPECT_TRUE(same_bits(render_with(scene_with(), options).image.pixels,
                          render_with(scene_with(), options).image.pixels));
}

TEST(Render, ACropIsAPartOfTheWhole) {
    TestScene const scene = scene_with();
    RenderOptions options;
    image::Image const whole = render_with(scene, options).image;
    options.picture.crop = film::Region{{13, 5}, {41, 50}};
    RenderResult const part = render_with(scene, options);
    ASSERT_EQ(part.image.width, 28);
    ASSERT_EQ(part.image.height, 45);
    for (int y = 0; y < 45; ++y)
        for (int x = 0; x < 28; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(part.image.at(x, y, c), whole.at(x + 13, y + 5, c)) << x << ", " << y;
}

TEST(Render, ACropOutsideIsAnError) {
    TestScene const scene = scene_with();
    for (film::Region const& crop : {film::Region{{0, 0}, {76, 50}}, film::Region{{-1, 0}, {5, 5}},
                                     film::Region{{5, 5}, {5, 9}}, film::Region{{9, 5}, {5, 9}}}) {
        RenderOptions options;
        options.picture.crop = crop;
        EXPECT_THROW(render_with(scene, options), InputError);
    }
}

TEST(Render, APictureThatMemoryCannotHoldIsAnError) {
    if (double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)) > 1.8e11)
        GTEST_SKIP() << "this machine can hold the largest picture";
    TestScene const scene =
        make_scene(R"(<camera type="perspective" width="65536" height="65536"/>)");
    try {
        render_with(scene, {});
        FAIL();
    } catch (InputError const& e) {
        EXPECT_EQ(std::string(e.what()).rfind("test:1:1: a picture of 65536 x 65536 pixels", 0), 0u)
            << e.what();
    }
    RenderOptions options;
    options.picture.crop = film::Region{{65000, 65000}, {65010, 65010}};
    options.limits.spp = 1;
    EXPECT_EQ(render_with(scene, options).image.width, 10) << "a part of it fits";
}

TEST(Render, SamplesPerPixelAddUp) {
    // The picture of n samples is the mean of the first n: passes of 1, 1, 2, 4, ... change
    // nothing.
    TestScene const scene = scene_with();
    integrator::PixelRenderer const renderer(*scene.stage, scene.job.integrator, scene.job.sampler,
                                             0);
    for (int spp : {1, 2, 3, 9, 150}) {
        RenderOptions options;
        options.limits.spp = spp;
        options.picture.crop = film::Region{{30, 20}, {36, 24}};
        RenderResult const result = render_with(scene, options);
        EXPECT_EQ(result.least_samples, uint32_t(spp));
        for (int y = 20; y < 24; ++y)
            for (int x = 30; x < 36; ++x) {
                double sum = 0;
                for (int s = 0; s < spp; ++s) sum += double(renderer.sample({x, y}, uint32_t(s)).r);
                ASSERT_EQ(result.image.at(x - 30, y - 20, 0), float(sum * (1.0 / spp)));
            }
    }
    EXPECT_EQ(render_with(scene, {}).least_samples, 7u) << "what the scene says";
}

TEST(Render, SeedsGiveOtherNoise) {
    TestScene const scene = scene_with();
    RenderOptions options;
    image::Image const a = render_with(scene, options).image;
    options.picture.seed = 1;
    image::Image const b = render_with(scene, options).image;
    EXPECT_FALSE(same_bits(a.pixels, b.pixels));
    EXPECT_TRUE(same_bits(b.pixels, render_with(scene, options).image.pixels));
}

TEST(Cancel, KeepsWhatIsDone) {
    TestScene const scene = scene_with("type=\"sobol\" count=\"1000000\"");
    std::atomic<bool> cancel{false};
    RenderOptions options;
    options.limits.cancel = &cancel;
    options.observers.on_progress = [&](Progress const& p) {
        EXPECT_GE(p.fraction, 0);
        EXPECT_LT(p.fraction, 1);
        cancel = true;
    };
    RenderResult const result = render_with(scene, options);
    EXPECT_TRUE(result.cancelled);
    EXPECT_EQ(result.stopped_by, StoppedBy::user);
    EXPECT_GT(result.pixel_samples, 0);
    EXPECT_LT(result.pixel_samples, 75.0 * 50 * 1e6);
    ASSERT_EQ(result.image.pixels.size(), 75u * 50 * 3);
    double sum = 0;
    for (float v : result.image.pixels) {
        ASSERT_TRUE(std::isfinite(v));
        sum += double(v);
    }
    EXPECT_GT(sum, 0);
}

TEST(Cancel, LeavesEveryPixelTheMeanOfItsOwnSamples) {
    // The light of an even sky is 1 whatever the sample, so that a pixel is off where it is
    // divided by another's number of samples.
    TestScene const scene =
        make_scene(R"(
        <camera type="perspective" width="90" height="70" fov="50"/>
        <light type="envmap"><texture type="constant" value="1"/></light>)",
                   "type=\"path\" depth=\"2\"", "", "type=\"sobol\" count=\"1000000\"");
    std::atomic<bool> cancel{false};
    RenderOptions options;
    options.limits.cancel = &cancel;
    options.observers.on_progress = [&](Progress const& p) { cancel = p.samples_done > 0; };
    RenderResult const result = render_with(scene, options);
    EXPECT_TRUE(result.cancelled);
    EXPECT_GE(result.least_samples, 1u);
    EXPECT_GE(result.pixel_samples, 90.0 * 70 * result.least_samples);
    for (float v : result.image.pixels) ASSERT_EQ(v, 1);
}

TEST(Cancel, BeforeTheStartLeavesBlack) {
    TestScene const scene = scene_with();
    std::atomic<bool> const cancel{true};
    RenderOptions options;
    options.limits.cancel = &cancel;
    RenderResult const result = render_with(scene, options);
    EXPECT_TRUE(result.cancelled);
    EXPECT_EQ(result.pixel_samples, 0);
    EXPECT_EQ(result.least_samples, 0u);
    for (float v : result.image.pixels) ASSERT_EQ(v, 0);
}

TEST(Progress, EndsAtOne) {
    TestScene const scene = scene_with();
    RenderOptions options;
    Progress last;
    options.observers.on_progress = [&](Progress const& p) { last = p; };
    render_with(scene, options);
    EXPECT_EQ(last.fraction, 1);
    EXPECT_EQ(last.samples_done, 7u);
    EXPECT_EQ(last.seconds_left, 0);
}

TEST(Progress, IsUnknownUntilTheNoiseIsLookedAt) {
    // So many pixels that the first report comes long before each has the samples for a decision.
    TestScene const scene = make_scene(R"(
        <camera type="perspective" width="2000" height="1500" fov="50"/>
        <light type="envmap"><texture type="constant" value="1"/></light>)");
    for (double seconds : {0.0, 1e6}) {
        std::atomic<bool> cancel{false};
        RenderOptions options;
        options.limits.noise = 1e-4;
        options.limits.seconds = seconds;
        options.threads = 1;
        options.limits.cancel = &cancel;
        std::optional<Progress> first;
        options.observers.on_progress = [&](Progress const& p) {
            if (!first) first = p;
            cancel = true;
        };
        render_with(scene, options);
        ASSERT_TRUE(first && !first->noise);
        EXPECT_LT(first->fraction, 0.5);
        if (seconds > 0)
            EXPECT_GT(first->seconds_left, 1e5);
        else
            EXPECT_TRUE(std::isnan(first->seconds_left));
    }
}

TEST(BadSamples, AreCountedAndLocated) {
    // Two lamps whose light overflows where both are added, seen in the left half alone.
    TestScene const scene =
        make_scene(R"(
        <camera type="orthographic" width="20" height="10" scale="1"/>
        <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="1"/><transform><scale value="2"/><rotate axis="0,1,0" angle="180"/><translate z="1"/></transform></instance>
        <instance><shape type="rectangle"/><emission type="lambertian" emission="3e38"/><bsdf type="diffuse" albedo="1"/><transform><scale x="0.5"/><rotate axis="0,1,0" angle="180"/><translate x="-0.5" z="0.5"/></transform></instance>
        <light type="directional" direction="0,0,-1" intensity="1e38"/><light type="directional" direction="0,0.1,-1" intensity="3.4e38"/>
        <light type="envmap"><texture type="constant" value="1"/></light>)",
                   "type=\"path\" depth=\"2\"", "", "type=\"sobol\" count=\"3\"");
    RenderOptions options;
    options.threads = 1;
    RenderResult const one = render_with(scene, options);
    options.threads = 4;
    options.tile_size = 3;
    RenderResult const many = render_with(scene, options);
    EXPECT_GT(one.bad_samples, 0u);
    EXPECT_LT(one.bad_samples, 600u);
    EXPECT_EQ(one.bad_samples, many.bad_samples);
    ASSERT_EQ(one.first_bad_samples.size(), 4u);
    ASSERT_EQ(many.first_bad_samples.size(), 4u);
    integrator::PixelRenderer const renderer(*scene.stage, scene.job.integrator, scene.job.sampler,
                                             0);
    for (size_t i = 0; i < 4; ++i) {
        BadSample const &a = one.first_bad_samples[i], &b = many.first_bad_samples[i];
        EXPECT_EQ(a.pixel, b.pixel);
        EXPECT_EQ(a.sample, b.sample);
        EXPECT_FALSE(is_finite(a.value));
        EXPECT_FALSE(is_finite(renderer.sample(a.pixel, a.sample))) << "it can be made again";
    }
    // The first in pixel order, and every bad one counts as black while the others stay.
    uint64_t bad = 0;
    std::vector<std::pair<Vec2i, uint32_t>> first;
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) {
            double sum = 0;
            for (uint32_t s = 0; s < 3; ++s) {
                Color const c = renderer.sample({x, y}, s);
                if (!is_finite(c) && ++bad <= 4) first.emplace_back(Vec2i(x, y), s);
                sum += is_finite(c) ? double(c.r) : 0;
            }
            ASSERT_EQ(one.image.at(x, y, 0), float(sum * (1.0 / 3)));
            ASSERT_TRUE(std::isfinite(one.image.at(x, y, 0)));
        }
    EXPECT_EQ(one.bad_samples, bad);
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(one.first_bad_samples[i].pixel, first[i].first);
    EXPECT_TRUE(same_bits(one.image.pixels, many.image.pixels));
}

} // namespace
} // namespace weft::session
