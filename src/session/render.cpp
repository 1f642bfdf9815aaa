#include "session/render.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <thread>
#include <unistd.h>

#include "integrator/pixel_renderer.h"
#include "session/scene_tags.h"

namespace weft::session {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The end of the pass that starts at sample `from`: 1, 2, 4, ... so that a first picture is
/// there soon, and then as many as keep tiles long enough not to matter.
uint32_t pass_end(uint32_t from, uint32_t total) {
    constexpr uint32_t longest = 64;
    return std::min(total, from + std::clamp(from, 1u, longest));
}

/// Reports progress from whichever thread comes by first after a fifth of a second.
class ProgressMeter {
  public:
    ProgressMeter(RenderOptions const& options, double total) : options_(options), total_(total) {}

    void add(double pixel_samples, uint32_t samples_done) {
        double const done = done_.fetch_add(pixel_samples) + pixel_samples;
        if (!options_.on_progress) return;
        std::unique_lock lock(mutex_, std::try_to_lock);
        double const now = seconds_since(start_);
        if (!lock || now - last_ < 0.2) return;
        last_ = now;
        options_.on_progress(
            {done / total_, done / now, now, now * (total_ / done - 1), samples_done});
    }
    void finish(uint32_t samples) {
        double const now = seconds();
        if (options_.on_progress) options_.on_progress({1, done() / now, now, 0, samples});
    }
    double done() const { return done_.load(); }
    double seconds() const { return seconds_since(start_); }

  private:
    RenderOptions const& options_;
    double total_, last_ = 0;
    std::atomic<double> done_{0};
    std::mutex mutex_;
    Clock::time_point start_ = Clock::now();
};

class TileRenderer {
  public:
    TileRenderer(integrator::PixelRenderer const& renderer, film::Film& film, RenderResult& result)
        : renderer_(renderer), film_(film), result_(result) {}

    /// Adds the samples [from, to) to each pixel of the tile, row by row while `go_on()`. Returns
    /// how many it made.
    template <class GoOn>
    double render(film::Region const& tile, uint32_t from, uint32_t to, GoOn const& go_on) {
        film::SampleRecord own(film_.layout(), result_.tags);
        film::SampleRecord* const record = film_.layout().needs_record() ? &own : nullptr;
        int y = tile.from.y;
        for (; y < tile.to.y && go_on(); ++y)
            for (int x = tile.from.x; x < tile.to.x; ++x)
                for (uint32_t s = from; s < to; ++s) {
                    Color const c = renderer_.sample({x, y}, s, record);
                    bool const good = is_good(c) && (!record || record->finish());
                    if (!good) [[unlikely]]
                        report({{x, y}, s, c}, record);
                    film_.add(x, y, s, good ? c : Color(0), record);
                }
        return double(y - tile.from.y) * tile.width() * (to - from);
    }

  private:
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
    film::Film& film_;
    RenderResult& result_;
    std::mutex mutex_;
};

std::vector<film::Region> make_tiles(film::Region const& region, int size) {
    std::vector<film::Region> tiles;
    for (int y = region.from.y; y < region.to.y; y += size)
        for (int x = region.from.x; x < region.to.x; x += size)
            tiles.push_back(
                {{x, y}, {std::min(x + size, region.to.x), std::min(y + size, region.to.y)}});
    return tiles;
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

film::Layout make_layout(io::RenderJob const& job, RenderOptions const& options,
                         film::SceneTags const& tags) {
    auto const from_scene = wanted_aovs(job.integrator);
    std::vector<film::Aov> aovs(from_scene.begin(), from_scene.end());
    aovs.insert(aovs.end(), options.aovs.begin(), options.aovs.end());
    film::LayoutOptions o;
    o.half_sums = options.half_sums;
    o.light_groups = tags.light_groups;
    match(job.integrator, [&](auto const& i) {
        if constexpr (requires { i.outputs; })
            o.cryptomatte_levels = i.outputs.cryptomatte_levels;
        else if (!aovs.empty())
            throw InputError(job.where, "expected an integrator that follows light for AOVs, found "
                                        "<integrator type=\"" +
                                            std::string(i.info.type) + "\">");
    });
    return film::Layout(aovs, std::move(o));
}

/// Says so before the film's sums and the picture made of them ask for more than the machine has.
void check_memory(film::Region const& region, film::Layout const& layout,
                  SourceLocation const& where) {
    double const needed = double(region.width()) * region.height() *
                          double(film::Film::bytes_per_pixel(layout) +
                                 (3 + layout.channel_names().size()) * sizeof(float));
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
    return match(integrator, [](auto const& i) -> std::span<film::Aov const> {
        if constexpr (requires { i.outputs; }) return i.outputs.aovs;
        return {};
    });
}

RenderResult render(world::World const& world, io::RenderJob const& job,
                    RenderOptions const& options) {
    RenderResult result;
    result.region = region_of(world, options);
    result.tags = scene_tags(world);
    film::Layout const layout = make_layout(job, options, result.tags);
    check_memory(result.region, layout, job.where);
    result.samples = uint32_t(options.spp > 0 ? options.spp : sample_count(job.sampler));
    integrator::PixelRenderer const renderer(world, job.integrator, job.sampler, options.seed,
                                             int(result.samples));
    result.film = film::Film(result.region, layout);
    TileRenderer tiles(renderer, result.film, result);
    auto const regions = make_tiles(result.region, options.tile_size);
    double const pixels = double(result.region.width()) * result.region.height();
    ProgressMeter meter(options, pixels * result.samples);
    auto cancelled = [&] {
        return options.cancel && options.cancel->load(std::memory_order_relaxed);
    };

    int const threads = options.threads > 0
                            ? options.threads
                            : int(std::max(1u, std::thread::hardware_concurrency()));
    tbb::task_arena arena(threads);
    arena.execute([&] {
        for (uint32_t from = 0; from < result.samples && !cancelled();
             from = pass_end(from, result.samples)) {
            uint32_t const to = pass_end(from, result.samples);
            tbb::parallel_for(
                tbb::blocked_range<size_t>(0, regions.size(), 1),
                [&](auto const& range) {
                    for (size_t i = range.begin(); i != range.end() && !cancelled(); ++i)
                        meter.add(tiles.render(regions[i], from, to, [&] { return !cancelled(); }),
                                  from);
                },
                tbb::simple_partitioner());
        }
    });
    result.cancelled = cancelled() && meter.done() < pixels * result.samples;
    if (!result.cancelled) meter.finish(result.samples);
    result.image = result.film.mean();
    result.least_samples = result.film.least_samples();
    result.seconds = meter.seconds();
    result.pixel_samples = meter.done();
    return result;
}

} // namespace weft::session
