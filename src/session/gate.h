// Lets many threads work at once, and now and then one that wants all of them to stand still. The
// one is not starved: while it waits, nobody else comes in, and who works can see that it waits.
#pragma once

#include <atomic>
#include <mutex>
#include <shared_mutex>

namespace weft::session {

class Gate {
  public:
    using Turn = std::shared_lock<std::shared_mutex>;

    /// Held while working.
    Turn enter() {
        std::lock_guard const turn(turnstile_);
        return Turn(work_);
    }
    /// Returns whether somebody waits in `stop`: whoever works then gives up his turn soon. Costs
    /// no more than reading a flag.
    bool is_wanted() const { return wanted_.load(std::memory_order_relaxed); }
    /// Held while everybody stands still.
    std::unique_lock<std::shared_mutex> stop() {
        std::lock_guard const turn(turnstile_);
        wanted_ = true; // who sees it cannot come in again before
        std::unique_lock all(work_);
        wanted_ = false;
        return all;
    }

  private:
    std::atomic<bool> wanted_{false};
    std::mutex turnstile_;
    std::shared_mutex work_;
};

} // namespace weft::session
