// Lets many threads work at once, and now and then one that wants all of them to stand still. The
// one is not starved: while it waits, nobody else comes in.
#pragma once

#include <mutex>
#include <shared_mutex>

namespace weft::session {

class Gate {
  public:
    /// Held while working.
    std::shared_lock<std::shared_mutex> enter() {
        std::lock_guard const turn(turnstile_);
        return std::shared_lock(work_);
    }
    /// Held while everybody stands still.
    std::unique_lock<std::shared_mutex> stop() {
        std::lock_guard const turn(turnstile_);
        return std::unique_lock(work_);
    }

  private:
    std::mutex turnstile_;
    std::shared_mutex work_;
};

} // namespace weft::session
