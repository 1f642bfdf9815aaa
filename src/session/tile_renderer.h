// Makes the samples of tiles: what each thread of a render does.
#pragma once

#include <mutex>
#include <utility>

#include "integrator/pixel_renderer.h"
#include "session/adaptive.h"
#include "session/gate.h"
#include "session/render.h"

namespace weft::session {

class TileRenderer {
  public:
    /// All of them outlive the object. `first` is the first sample of a pixel. The samples go to
    /// the film of `result`, and follow its pass.
    TileRenderer(integrator::PixelRenderer const& renderer, film::SceneTags const& tags,
                 uint32_t first, RenderResult& result, Gate& gate)
        : renderer_(renderer), tags_(tags), first_(first), result_(result), gate_(gate),
          grid_(result.film.region()) {}

    /// Makes the samples of the pass at hand that the tile's pixels lack, until `stop()` says so:
    /// it is asked before every sample. Outside of the gate, after every few samples and at the
    /// end, `report(n)` is told of n more. Returns whether the tile has all samples of the pass.
    template <class Stop, class Report>
    bool render(film::Region const& tile, Stop const& stop, Report const& report) {
        film::SampleRecord own(result_.film.layout(), tags_);
        film::SampleRecord* const record = own.layout().needs_record() ? &own : nullptr;
        Gate::Turn turn = gate_.enter();
        uint32_t made = 0;
        bool const whole = for_each_lacking(tile, [&](Vec2i pixel, uint32_t sample) {
            if (made == kSamplesPerTurn || gate_.is_wanted()) [[unlikely]] {
                turn.unlock();
                report(std::exchange(made, 0));
                turn = gate_.enter();
            }
            if (stop()) return false;
            add(pixel, sample, record);
            ++made;
            return true;
        });
        turn.unlock();
        report(made);
        return whole;
    }

  private:
    static constexpr uint32_t kSamplesPerTurn = 64;

    /// Calls `visit(pixel, sample)` for all samples of the pass that the tile lacks, while it
    /// returns true. Returns whether it always did.
    template <class Visit>
    bool for_each_lacking(film::Region const& tile, Visit const& visit) {
        PassState const& pass = result_.pass;
        for (int y = tile.from.y; y < tile.to.y; ++y)
            for (int x = tile.from.x; x < tile.to.x; ++x) {
                if (!pass.active.empty() && !pass.active[grid_.index(x, y)]) continue;
                for (uint32_t s = first_ + result_.film.counts(x, y).all; s < pass.to; ++s)
                    if (!visit(Vec2i(x, y), s)) return false;
            }
        return true;
    }

    void add(Vec2i pixel, uint32_t s, film::SampleRecord* record) {
        bool lost_track = false;
        Color const c = renderer_.sample(pixel, s, record, &lost_track);
        if (lost_track) [[unlikely]]
            count_lost();
        FeatureScope const scope(Feature::Film);
        bool const good = is_good(c) && (!record || record->finish());
        if (!good) [[unlikely]]
            report_bad({pixel, s, c}, record);
        result_.film.add(pixel.x, pixel.y, s, good ? c : Color(0), record);
    }

    bool is_good(Color const& c) const {
        return is_finite(c) && (min_component(c) >= 0 || !renderer_.follows_light());
    }

    void count_lost() {
        std::lock_guard lock(mutex_);
        ++result_.lost_samples;
    }

    void report_bad(BadSample const& bad, film::SampleRecord* record) {
        if (record) record->drop();
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
    film::SceneTags const& tags_;
    uint32_t first_;
    RenderResult& result_;
    Gate& gate_;
    BlockGrid grid_;
    std::mutex mutex_; ///< of the bad and the lost samples
};

} // namespace weft::session
