#include "session/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <thread>
#include <unistd.h>

#include "integrator/pixel_renderer.h"
#include "session/adaptive.h"
#include "session/gate.h"
#include "session/progress_meter.h"
#include "session/render_state.h"
#include "session/scene_tags.h"
#include "session/watching.h"

namespace weft::session {

namespace {

/// The end of the pass that starts at sample `from`: 1, 2, 4, ... so that a first picture is
/// there soon, and then as many as keep tiles long enough not to matter.
uint32_t pass_end(uint32_t from, uint32_t limit) {
    constexpr uint32_t longest = 64;
    return std::min(limit, from + std::clamp(from, 1u, longest));
}

class TileRenderer {
  public:
    TileRenderer(integrator::PixelRenderer const& renderer, RenderOptions const& options,
                 RenderResult& result, Gate& gate)
        : renderer_(renderer), first_(options.part.first), film_(result.film), result_(result),
          gate_(gate), grid_(result.region) {}

    /// Gives the tile's pixels, where their blocks are active, the samples that they lack of the
    /// pass at hand; row by row while `go_on()`. Returns how many it made.
    template <class GoOn>
    double render(film::Region const& tile, GoOn const& go_on) {
        film::SampleRecord own(film_.layout(), result_.tags);
        film::SampleRecord* const record = film_.layout().needs_record() ? &own : nullptr;
        double made = 0;
        for (int y = tile.from.y; y < tile.to.y && go_on(); ++y) {
            auto const working = gate_.enter();
            PassState const& pass = result_.pass;
            for (int x = tile.from.x; x < tile.to.x; ++x) {
                if (!pass.active.empty() && !pass.active[grid_.index(x, y)]) continue;
                uint32_t const from = first_ + film_.counts(x, y).all;
                for (uint32_t s = from; s < pass.to; ++s) add({x, y}, s, record);
                made += pass.to - std::min(from, pass.to);
            }
        }
        return made;
    }

  private:
    void add(Vec2i pixel, uint32_t s, film::SampleRecord* record) {
        Color const c = renderer_.sample(pixel, s, record);
        FeatureScope const scope(Feature::Film);
        bool const good = is_good(c) && (!record || record->finish());
        if (!good) [[unlikely]]
            report({pixel, s, c}, record);
        film_.add(pixel.x, pixel.y, s, good ? c : Color(0), record);
    }

    bool is_good(Color const& c) const {
        return is_finite(c) && (min_component(c) >= 0 || !renderer_.follows_light());
    }

    void report(BadSample const& bad, film::SampleRecord* record) {
        if (record) record->clear();
        std::lock_guard lock(mutex_);
        ++result_.bad_samples;
        auto& list = result_.first_bad_samples;
        list.push_back(bad);
        auto key = [](BadSample const& b) { return std::tuple(b.pixel.y, b.pixel.x, b.sample); };
        std::sort(list.begin(), list.end(),
                  [&](auto const& a, auto const& b) { return key(a) < key(b); });
        if (list.size() > 4) list.pop_back();
    }

    integrator::PixelRenderer const& renderer_;
    uint32_t first_;
    film::Film& film_;
    RenderResult& result_;
    Gate& gate_;
    BlockGrid grid_;
    std::mutex mutex_;
};

/// Says so before the film's sums and the picture made of them ask for more than the machine has.
void check_memory(film::Region const& region, film::Layout const& layout, bool watched,
                  SourceLocation const& where) {
    // Watchers look at a copy of the film, and a checkpoint is a second one in bytes.
    double const film = double(film::Film::bytes_per_pixel(layout)) * (watched ? 3 : 1);
    double const picture = double(3 + layout.channel_names().size()) * sizeof(float);
    double const needed = double(region.width()) * region.height() * (film + picture);
    double const there = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
    auto const gib = [](double bytes) { return std::to_string(int64_t(bytes / (1 << 30))); };
    if (there > 0 && needed > there)
        throw InputError(where, "a picture of " + std::to_string(region.width()) + " x " +
                                    std::to_string(region.height()) + " pixels takes " +
                                    gib(needed) + " GiB, expected at most the " + gib(there) +
                                    " GiB of this machine; --crop renders a part of it");
}

} // namespace

int sample_count(scene::Sampler const& sampler) {
    return match(sampler, [](auto const& s) { return s.count; });
}

std::span<film::Aov const> wanted_aovs(scene::Integrator const& integrator) {
    scene::Outputs const* const outputs = scene::outputs_of(integrator);
    return outputs ? std::span<film::Aov const>(outputs->aovs) : std::span<film::Aov const>();
}

film::Region region_of(world::World const& world, RenderOptions const& options) {
    Vec2i const size = world.camera().size();
    if (!options.crop) return {{0, 0}, size};
    film::Region const& c = *options.crop;
    bool const inside = c.from.x >= 0 && c.from.y >= 0 && c.to.x <= size.x && c.to.y <= size.y;
    if (!inside || c.width() <= 0 || c.height() <= 0)
        throw InputError(
            "--crop expects a region inside of the picture of " + std::to_string(size.x) + " x " +
            std::to_string(size.y) + " pixels, found " + std::to_string(c.from.x) + "," +
            std::to_string(c.from.y) + "," + std::to_string(c.to.x) + "," + std::to_string(c.to.y));
    return c;
}

film::Layout make_layout(lights::Stage const& stage, scene::RenderJob const& job,
                         RenderOptions const& options) {
    film::SceneTags const tags = scene_tags(stage);
    auto const from_scene = wanted_aovs(job.integrator);
    std::vector<film::Aov> aovs(from_scene.begin(), from_scene.end());
    aovs.insert(aovs.end(), options.aovs.begin(), options.aovs.end());
    film::LayoutOptions o;
    o.half_sums = options.half_sums || options.noise > 0;
    o.light_groups = tags.light_groups;
    o.layers = tags.layers;
    if (scene::Outputs const* const outputs = scene::outputs_of(job.integrator))
        o.cryptomatte_levels = outputs->cryptomatte_levels;
    else if (!aovs.empty())
        throw InputError(
            job.where,
            "expected an integrator that follows light for AOVs, found <integrator type=\"" +
                std::string(match(job.integrator, [](auto const& i) { return i.info.type; })) +
                "\">");
    return film::Layout(aovs, std::move(o));
}

/// Where a render without an own number of samples ends at the latest.
constexpr uint32_t kMostSamples = 1 << 16;

uint32_t sample_limit(scene::RenderJob const& job, RenderOptions const& options) {
    if (options.spp > 0) return uint32_t(options.spp);
    return options.noise > 0 || options.seconds > 0 ? kMostSamples
                                                    : uint32_t(sample_count(job.sampler));
}

int footprint_samples(scene::RenderJob const& job, RenderOptions const& options) {
    return options.spp > 0 ? options.spp : sample_count(job.sampler);
}

namespace {

/// The passes of one render, and what it decides between them.
class Passes {
  public:
    Passes(RenderOptions const& options, RenderResult& result, Gate& gate, ProgressMeter& meter)
        : options_(options), result_(result), gate_(gate), meter_(meter),
          first_(options.part.first),
          limit_(options.part.last > 0 ? options.part.last : result.samples) {
        if (result.pass.to == 0) result.pass.to = next_end(first_);
    }

    /// Whether there is another pass after the one that is done.
    bool go_on() {
        PassState next;
        uint32_t const done = result_.pass.to;
        if (options_.noise > 0 && !decide(done, next)) return stop(StoppedBy::noise);
        if (done >= limit_) return stop(StoppedBy::samples);
        next.to = next_end(done);
        if (options_.seconds > 0 && !fits(done, next)) return stop(StoppedBy::time);
        auto const standing_still = gate_.stop();
        result_.pass = std::move(next);
        return true;
    }

  private:
    uint32_t next_end(uint32_t from) const {
        return options_.noise > 0 ? adaptive_pass_end(from, limit_)
                                  : first_ + pass_end(from - first_, limit_ - first_);
    }

    bool stop(StoppedBy why) {
        result_.stopped_by = why;
        return false;
    }

    /// False where the noise is reached everywhere.
    bool decide(uint32_t done, PassState& next) {
        if (done < std::min(kLeastSamples, limit_)) return true;
        std::vector<float> const errors = block_errors(result_.film);
        double const noise = double(*std::max_element(errors.begin(), errors.end()));
        result_.noise = noise;
        meter_.reached(noise);
        meter_.expect(meter_.done() + samples_needed(result_.film, errors, options_.noise, limit_));
        next.active = active_blocks(result_.film, errors, options_.noise, limit_);
        return noise > options_.noise;
    }

    /// Shortens the next pass to what the time left is likely to hold; false where that is none.
    bool fits(uint32_t done, PassState& next) const {
        double const left = options_.seconds - meter_.seconds();
        double pixels = double(result_.region.pixels()) / options_.part.shards;
        if (!next.active.empty()) {
            BlockGrid const grid(result_.region);
            pixels = 0;
            for (size_t i = 0; i < next.active.size(); ++i)
                if (next.active[i]) pixels += double(grid.block(i).pixels());
        }
        double const samples = std::floor(left * meter_.rate() / pixels);
        if (!(samples >= 1)) return false;
        next.to = uint32_t(std::min(double(next.to), double(done) + samples));
        return true;
    }

    RenderOptions const& options_;
    RenderResult& result_;
    Gate& gate_;
    ProgressMeter& meter_;
    uint32_t first_, limit_;
};

/// Takes over what an earlier render left.
void resume(RenderState const& state, RenderResult& result) {
    result.film = state.film;
    result.pass = state.pass;
    result.bad_samples = state.bad_samples;
    result.first_bad_samples = state.first_bad_samples;
}

double pixel_samples(film::Film const& film) {
    film::Region const& r = film.region();
    double sum = 0;
    for (int y = r.from.y; y < r.to.y; ++y)
        for (int x = r.from.x; x < r.to.x; ++x) sum += film.counts(x, y).all;
    return sum;
}

/// Samples that the whole render is to make, where that is known before it starts.
double expected_samples(RenderOptions const& options, RenderResult const& result,
                        std::vector<film::Region> const& tiles) {
    if (options.noise > 0) return std::numeric_limits<double>::quiet_NaN();
    double pixels = 0;
    for (film::Region const& tile : tiles) pixels += double(tile.pixels());
    uint32_t const last = options.part.last > 0 ? options.part.last : result.samples;
    return pixels * (last - options.part.first);
}

RenderState state_of(RenderResult const& result, Identity const& identity,
                     RenderOptions const& options) {
    RenderState s;
    s.identity = identity;
    s.part = options.part;
    s.tile_size = options.tile_size;
    s.samples = result.samples;
    s.pass = result.pass;
    s.seconds = result.seconds;
    s.bad_samples = result.bad_samples;
    s.first_bad_samples = result.first_bad_samples;
    return s;
}

} // namespace

RenderState starting_state(lights::Stage const& stage, scene::RenderJob const& job,
                           RenderOptions const& options) {
    RenderResult fresh;
    fresh.samples = sample_limit(job, options);
    fresh.film = film::Film(region_of(stage.world(), options), make_layout(stage, job, options));
    return to_state(std::move(fresh), stage, job, options);
}

RenderState to_state(RenderResult&& result, lights::Stage const& stage, scene::RenderJob const& job,
                     RenderOptions const& options) {
    RenderState state = state_of(result, identify(stage, job, options), options);
    state.film = std::move(result.film);
    return state;
}

RenderResult render(lights::Stage const& stage, scene::RenderJob const& job,
                    RenderOptions const& options) {
    RenderResult result;
    result.region = region_of(stage.world(), options);
    result.tags = scene_tags(stage);
    film::Layout const layout = make_layout(stage, job, options);
    check_memory(result.region, layout, !options.watchers.empty(), job.where);
    result.samples = sample_limit(job, options);
    integrator::PixelRenderer const renderer(stage, job.integrator, job.sampler, options.seed,
                                             footprint_samples(job, options));
    result.film = film::Film(result.region, layout);
    double seconds_before = 0;
    if (options.resume) {
        resume(*options.resume, result);
        seconds_before = options.resume->seconds;
    }
    Gate gate;
    TileRenderer tiles(renderer, options, result, gate);
    auto const regions = make_tiles(result.region, options.tile_size, options.part);
    ProgressMeter meter(options, pixel_samples(result.film), seconds_before);
    meter.expect(expected_samples(options, result, regions));
    Passes passes(options, result, gate, meter);
    auto cancelled = [&] {
        return options.cancel && options.cancel->load(std::memory_order_relaxed);
    };
    uint32_t samples_done = result.film.least_samples();
    std::optional<Profiler> profiler;
    if (options.profile) profiler.emplace();
    Profiler* const watched = profiler ? &*profiler : nullptr;
    auto const render_pass = [&] {
        tbb::parallel_for(
            tbb::blocked_range<size_t>(0, regions.size(), 1),
            [&](auto const& range) {
                Profiler::Work const work(watched);
                for (size_t i = range.begin(); i != range.end() && !cancelled(); ++i)
                    meter.add(tiles.render(regions[i], [&] { return !cancelled(); }), samples_done);
            },
            tbb::simple_partitioner());
        if (!cancelled()) samples_done = result.pass.to;
    };

    Identity const identity = options.watchers.empty() ? Identity() : identify(stage, job, options);
    std::optional<Watching> watching(std::in_place, options.watchers, [&] {
        auto const standing_still = gate.stop();
        RenderState state = state_of(result, identity, options);
        state.film = result.film;
        state.seconds = meter.all_seconds();
        return state;
    });
    int const threads = options.threads > 0
                            ? options.threads
                            : int(std::max(1u, std::thread::hardware_concurrency()));
    tbb::task_arena arena(threads);
    bool done = false;
    arena.execute([&] {
        while (!done && !cancelled()) {
            render_pass();
            Profiler::Work const work(watched);
            FeatureScope const scope(Feature::Film);
            done = !cancelled() && !passes.go_on();
        }
    });
    watching.reset();
    if (profiler) {
        result.profile = profiler->profile();
        result.profile.thread_seconds = threads * meter.seconds();
    }
    result.cancelled = !done && !(meter.done() == expected_samples(options, result, regions));
    if (result.cancelled) result.stopped_by = StoppedBy::user;
    result.image = result.film.mean();
    result.least_samples = result.film.least_samples();
    if (done) meter.finish(result.least_samples);
    result.seconds = meter.all_seconds();
    result.pixel_samples = meter.done();
    result.samples_per_second = meter.rate();
    return result;
}

} // namespace weft::session
