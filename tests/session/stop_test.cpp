// Whoever wants something of a render that goes on is answered before the next sample. What is
// counted here is samples and processor time, so that other programs on the machine change nothing.
#include <gtest/gtest.h>

#include <ctime>
#include <thread>

#include "session/alarm.h"
#include "session/render_state.h"
#include "session/tile_renderer.h"
#include "tests/support/scenes.h"

namespace weft::session {
namespace {

using namespace weft::testing;

/// A render of one tile of 32 x 32 pixels, in a pass of 64 samples.
struct OneTile {
    TestScene scene = make_scene(R"(
        <camera type="perspective" width="32" height="32" fov="50"/>
        <light type="envmap"><texture type="constant" value="1"/></light>)");
    Plan plan = make_plan(*scene.stage, scene.job, {});
    integrator::PixelRenderer renderer{*scene.stage, scene.job.integrator, scene.job.sampler, 0};
    RenderResult result = empty_result();
    Gate gate;
    TileRenderer tiles{renderer, plan.tags, 0, result, gate};

    RenderResult empty_result() const {
        RenderResult r;
        r.film = film::Film(plan.region, plan.layout);
        r.pass.to = 64;
        return r;
    }
    uint32_t samples() const {
        uint32_t sum = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) sum += result.film.counts(x, y).all;
        return sum;
    }
};

TEST(TileRenderer, StopsBeforeTheNextSample) {
    for (uint32_t wanted : {0u, 1u, 100u, 2048u + 3u}) {
        OneTile tile;
        uint32_t asked = 0, told = 0;
        bool const whole = tile.tiles.render(
            tile.plan.region, [&] { return asked++ == wanted; }, [&](uint32_t n) { told += n; });
        EXPECT_FALSE(whole);
        EXPECT_EQ(tile.samples(), wanted);
        EXPECT_EQ(told, wanted);
    }
}

TEST(TileRenderer, GoesOnWhereItStopped) {
    OneTile once, often;
    auto const ignore = [](uint32_t) {};
    EXPECT_TRUE(once.tiles.render(
        once.plan.region, [] { return false; }, ignore));
    EXPECT_EQ(once.samples(), 32u * 32 * 64);
    uint32_t asked = 0;
    while (!often.tiles.render(
        often.plan.region, [&] { return ++asked % 1001 == 0; }, ignore)) {
    }
    EXPECT_TRUE(once.result.film == often.result.film);
}

TEST(TileRenderer, StandsStillBeforeTheNextSample) {
    OneTile tile;
    uint32_t seen = 0, asked = 0;
    std::thread watcher;
    auto const stop = [&] {
        if (++asked == 100) {
            watcher = std::thread([&] {
                auto const standing_still = tile.gate.stop();
                seen = tile.samples();
            });
            while (!tile.gate.is_wanted()) std::this_thread::yield();
        }
        return asked == 300;
    };
    tile.tiles.render(tile.plan.region, stop, [](uint32_t) {});
    watcher.join();
    EXPECT_EQ(seen, 100u) << "the sample that was about to be made, and no other";
    EXPECT_EQ(tile.samples(), 299u);
}

double processor_seconds() {
    timespec t = {};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

TEST(Cancel, IsAnsweredWithin50MillisecondsOfProcessorTime) {
    // A sample asks some hundred lights, so that a row of a tile takes a hundred times longer than
    // the limit allows in passes of 64 samples.
    std::string lamps;
    for (int i = 0; i < 400; ++i)
        lamps += "<light type=\"point\" power=\"1\" position=\"" + std::to_string(i % 20 - 10) +
                 "," + std::to_string(i / 20 - 10) + ",-4\"/>";
    TestScene const scene = make_scene(R"(
        <camera type="perspective" width="64" height="2" fov="50"><transform><translate z="-3"/></transform></camera>
        <instance><shape type="rectangle"/><bsdf type="diffuse"/><transform><scale value="20"/></transform></instance>)" +
                                           lamps,
                                       "type=\"path\" depth=\"2\" lightSamples=\"1024\"");
    RenderOptions options;
    options.threads = 2;
    options.limits.spp = 1 << 16;
    std::atomic<bool> cancel{false};
    options.limits.cancel = &cancel;
    double cancelled_at = 0;
    options.observers.watchers = {{0.001, [&](RenderState const& s) {
                                       if (s.pass.to < 128 || cancel) return;
                                       cancelled_at = processor_seconds();
                                       cancel = true;
                                   }}};
    RenderResult const result = render(*scene.stage, scene.job, options);
    EXPECT_LT(processor_seconds() - cancelled_at, 0.05);
    EXPECT_TRUE(result.cancelled);
    EXPECT_EQ(result.stopped_by, StoppedBy::user);
}

TEST(Alarm, RingsWhenItsTimeIsUp) {
    Alarm const soon(1e-3), late(1e6), never(0);
    while (!soon.has_rung()) std::this_thread::yield();
    EXPECT_FALSE(late.has_rung());
    EXPECT_FALSE(never.has_rung());
}

TEST(Time, EndsTheRenderBeforeTheNextSample) {
    TestScene const scene = make_scene(R"(
        <camera type="perspective" width="8" height="8" fov="50"/>
        <light type="envmap"><texture type="constant" value="1"/></light>)");
    // The first report that comes when every pixel has a sample waits until the time is up. On a
    // machine so busy that none comes before, there is more time.
    double samples_then = 0;
    for (double seconds = 0.5; samples_then == 0; seconds *= 4) {
        RenderOptions options;
        options.threads = 1;
        options.limits.seconds = seconds;
        Alarm const later(seconds + 0.5);
        options.observers.on_progress = [&](Progress const& p) {
            if (p.samples_done == 0 || samples_then > 0 || p.fraction == 1) return;
            samples_then = p.samples_per_second * p.seconds;
            while (!later.has_rung()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        };
        RenderResult const result = render(*scene.stage, scene.job, options);
        EXPECT_EQ(result.stopped_by, StoppedBy::time);
        EXPECT_FALSE(result.cancelled);
        EXPECT_GE(result.least_samples, 1u);
        if (samples_then > 0) {
            EXPECT_NEAR(result.pixel_samples, samples_then, 0.5);
        }
    }
}

TEST(Time, LeavesNoPixelBlack) {
    TestScene const scene = make_scene(R"(
        <camera type="perspective" width="70" height="50" fov="50"/>
        <light type="envmap"><texture type="constant" value="1"/></light>)");
    RenderOptions options;
    options.limits.seconds = 1e-9;
    RenderResult const result = render(*scene.stage, scene.job, options);
    EXPECT_EQ(result.stopped_by, StoppedBy::time);
    EXPECT_FALSE(result.cancelled);
    for (float v : result.image.pixels) ASSERT_EQ(v, 1);
}

} // namespace
} // namespace weft::session
