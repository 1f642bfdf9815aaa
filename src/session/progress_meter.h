// Counts samples and tells how far a render is, a few times a second.
#pragma once

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

#include "session/options.h"

namespace weft::session {

/// Reports every fifth of a second, from whichever thread calls `add` first after that.
class ProgressMeter {
  public:
    /// `samples_before` and `seconds_before` are those of the render that this one goes on from.
    ProgressMeter(RenderOptions const& options, double samples_before, double seconds_before)
        : options_(options), before_(samples_before), seconds_before_(seconds_before) {}

    /// Sets how many pixel samples there will be, by what is known now; not a number: nobody knows.
    void expect(double total) { total_ = total; }
    void reached(double noise) {
        std::lock_guard const lock(mutex_);
        noise_ = noise;
    }

    void add(double pixel_samples, uint32_t samples_done) {
        made_.fetch_add(pixel_samples, std::memory_order_relaxed);
        if (!options_.observers.on_progress) return;
        std::unique_lock lock(mutex_, std::try_to_lock);
        double const now = seconds();
        if (!lock || now - last_ < 0.2) return;
        last_ = now;
        double const left = seconds_left();
        double fraction = done() / total_;
        if (options_.limits.seconds > 0 || std::isnan(fraction))
            fraction = std::isnan(left) ? 0 : now / (now + left);
        options_.observers.on_progress(
            {std::min(fraction, 1.0), made_ / now, now, left, samples_done, noise_});
    }
    void finish(uint32_t samples) {
        if (options_.observers.on_progress)
            options_.observers.on_progress({1, rate(), seconds(), 0, samples, noise_});
    }

    double done() const { return before_ + made_; } ///< pixel samples of the film
    double rate() const { return made_ / std::max(seconds(), 1e-9); }
    /// Returns the seconds since the start of this render.
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    double all_seconds() const { return seconds_before_ + seconds(); }

  private:
    double seconds_left() const {
        double const more = total_ - done(); // the maximum with 0 would hide that nobody knows it
        double const left = std::isnan(more) ? more : std::max(0.0, more) / rate();
        if (options_.limits.seconds <= 0) return left;
        double const until = std::max(0.0, options_.limits.seconds - seconds());
        return std::isnan(left) ? until : std::min(left, until);
    }

    RenderOptions const& options_;
    double before_, seconds_before_, last_ = 0;
    std::atomic<double> total_{0}, made_{0};
    std::optional<double> noise_;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace weft::session
