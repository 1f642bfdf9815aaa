// Tells when a time is up, at the price of reading a flag: a look at the clock before every sample
// would cost a part of short ones.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace weft::session {

class Alarm {
  public:
    /// Rings after `seconds`, which are less than 1e9; never where they are 0.
    explicit Alarm(double seconds) {
        if (seconds <= 0) return;
        auto const delay = std::chrono::duration<double>(seconds);
        thread_ = std::jthread([this, delay](std::stop_token const& over) {
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, over, delay, [] { return false; });
            if (!over.stop_requested()) rung_ = true;
        });
    }

    bool has_rung() const { return rung_.load(std::memory_order_relaxed); }

  private:
    std::atomic<bool> rung_{false};
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::jthread thread_; ///< the last member: it ends before what it uses does
};

} // namespace weft::session
