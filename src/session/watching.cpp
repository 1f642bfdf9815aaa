#include "session/watching.h"

#include <algorithm>
#include <chrono>
#include <optional>

namespace weft::session {

namespace {

using Clock = std::chrono::steady_clock;

Clock::duration duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

} // namespace

Watching::Watching(std::vector<Watcher> const& watchers, std::function<RenderState()> snapshot)
    : watchers_(watchers), snapshot_(std::move(snapshot)) {
    if (!watchers.empty()) thread_ = std::thread([this] { run(); });
}

Watching::~Watching() {
    {
        std::lock_guard const lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Watching::run() {
    std::vector<Clock::time_point> due;
    for (Watcher const& w : watchers_) due.push_back(Clock::now() + duration(w.interval));
    while (true) {
        {
            std::unique_lock lock(mutex_);
            auto const next = *std::min_element(due.begin(), due.end());
            if (changed_.wait_until(lock, next, [&] { return over_; })) return;
        }
        std::optional<RenderState> state;
        for (size_t i = 0; i < due.size(); ++i)
            if (due[i] <= Clock::now()) {
                if (!state) state = snapshot_();
                watchers_[i].look(*state);
                due[i] = Clock::now() + duration(watchers_[i].interval);
            }
    }
}

} // namespace weft::session
