#include "session/render.h"

#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <thread>
#include <unistd.h>

#include "session/alarm.h"
#include "session/passes.h"
#include "session/render_state.h"
#include "session/tile_renderer.h"
#include "session/watching.h"

namespace weft::session {

namespace {

/// Says so before the film's sums and the picture made of them ask for more than the machine has.
void check_memory(Plan const& plan, bool watched) {
    // Watchers look at a copy of the film, and a checkpoint is a second one in bytes.
    double const film = double(film::Film::bytes_per_pixel(plan.layout)) * (watched ? 3 : 1);
    double const picture = double(3 + plan.layout.channel_names().size()) * sizeof(float);
    double const needed = double(plan.region.width()) * plan.region.height() * (film + picture);
    double const there = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
    auto const gib = [](double bytes) { return std::to_string(int64_t(bytes / (1 << 30))); };
    if (there > 0 && needed > there)
        throw InputError(plan.job.where, "a picture of " + std::to_string(plan.region.width()) +
                                             " x " + std::to_string(plan.region.height()) +
                                             " pixels takes " + gib(needed) +
                                             " GiB, expected at most the " + gib(there) +
                                             " GiB of this machine; --crop renders a part of it");
}

double pixel_samples(film::Film const& film) {
    film::Region const& r = film.region();
    double sum = 0;
    for (int y = r.from.y; y < r.to.y; ++y)
        for (int x = r.from.x; x < r.to.x; ++x) sum += film.counts(x, y).all;
    return sum;
}

/// Returns the pixel samples that the whole render is to make; not a number where that is not known
/// before it starts.
double expected_samples(Plan const& plan, RenderOptions const& options,
                        std::vector<film::Region> const& tiles) {
    if (options.limits.noise > 0) return std::numeric_limits<double>::quiet_NaN();
    double pixels = 0;
    for (film::Region const& tile : tiles) pixels += double(tile.pixels());
    Part const& part = options.picture.part;
    return pixels * ((part.last > 0 ? part.last : plan.samples) - part.first);
}

/// Returns a result without samples, or with those of the state that is resumed.
RenderResult first_result(Plan const& plan, RenderState const* resumed) {
    RenderResult result;
    if (!resumed) {
        result.film = film::Film(plan.region, plan.layout);
        return result;
    }
    result.film = resumed->film;
    result.pass = resumed->pass;
    result.bad_samples = resumed->bad_samples;
    result.first_bad_samples = resumed->first_bad_samples;
    return result;
}

/// One render, from its first sample to its last.
class Run {
  public:
    Run(Plan const& plan, RenderOptions const& options)
        : plan_(plan), options_(options), result_(first_result(plan, options.resume)),
          renderer_(plan.stage, plan.job.integrator, plan.job.sampler, options.picture.seed,
                    plan.footprint_samples),
          tiles_(make_tiles(plan.region, options.tile_size, options.picture.part)),
          tile_renderer_(renderer_, plan.tags, options.picture.part.first, result_, gate_),
          meter_(options, pixel_samples(result_.film),
                 options.resume ? options.resume->seconds : 0),
          passes_(plan, options, result_, gate_, meter_), alarm_(options.limits.seconds),
          samples_done_(result_.film.least_samples()) {
        meter_.expect(expected_samples(plan, options, tiles_));
        if (options.observers.profile) profiler_.emplace();
    }

    RenderResult run() {
        int const threads = options_.threads > 0
                                ? options_.threads
                                : int(std::max(1u, std::thread::hardware_concurrency()));
        {
            Watching const watching(options_.observers.watchers, [this] { return snapshot(); });
            tbb::task_arena(threads).execute([this] { render_passes(); });
        }
        if (profiler_) {
            result_.profile = profiler_->profile();
            result_.profile.thread_seconds = threads * meter_.seconds();
        }
        result_.image = result_.film.mean();
        result_.least_samples = result_.film.least_samples();
        if (!result_.cancelled) meter_.finish(result_.least_samples);
        result_.seconds = meter_.all_seconds();
        result_.pixel_samples = meter_.done();
        result_.samples_per_second = meter_.rate();
        return std::move(result_);
    }

  private:
    /// The end of the time leaves no pixel black.
    bool time_is_up() const { return samples_done_ > 0 && alarm_.has_rung(); }

    void render_passes() {
        auto next = Passes::Next::Pass;
        while (next == Passes::Next::Pass) {
            if (!render_pass()) {
                result_.stopped_by =
                    is_cancelled(options_.limits) ? StoppedBy::user : StoppedBy::time;
                break;
            }
            samples_done_ = result_.pass.to;
            Profiler::Work const work(profiler());
            FeatureScope const scope(Feature::Film);
            next = passes_.next();
        }
        if (next == Passes::Next::Interrupted) result_.stopped_by = StoppedBy::user;
        result_.cancelled = result_.stopped_by == StoppedBy::user;
    }

    /// Returns whether all tiles have all samples of the pass.
    bool render_pass() {
        std::atomic<bool> whole{true};
        auto const stop = [this] { return is_cancelled(options_.limits) || time_is_up(); };
        auto const report = [this](uint32_t made) { meter_.add(made, samples_done_); };
        tbb::parallel_for(
            tbb::blocked_range<size_t>(0, tiles_.size(), 1),
            [&](auto const& range) {
                Profiler::Work const work(profiler());
                for (size_t i = range.begin(); i != range.end(); ++i)
                    if (!tile_renderer_.render(tiles_[i], stop, report)) whole = false;
            },
            tbb::simple_partitioner());
        return whole;
    }

    RenderState snapshot() {
        auto const standing_still = gate_.stop();
        RenderState state = make_state(result_, plan_, options_);
        state.film = result_.film;
        state.seconds = meter_.all_seconds();
        return state;
    }

    Profiler* profiler() { return profiler_ ? &*profiler_ : nullptr; }

    Plan const& plan_;
    RenderOptions const& options_;
    RenderResult result_;
    integrator::PixelRenderer const renderer_;
    Gate gate_;
    std::vector<film::Region> const tiles_;
    TileRenderer tile_renderer_;
    ProgressMeter meter_;
    Passes passes_;
    std::optional<Profiler> profiler_;
    Alarm alarm_;
    uint32_t samples_done_; ///< by every pixel; changes between passes
};

} // namespace

RenderResult render(Plan const& plan, RenderOptions const& options) {
    check_memory(plan, !options.observers.watchers.empty());
    return Run(plan, options).run();
}

RenderResult render(lights::Stage const& stage, scene::RenderJob const& job,
                    RenderOptions const& options) {
    return render(make_plan(stage, job, options), options);
}

} // namespace weft::session
