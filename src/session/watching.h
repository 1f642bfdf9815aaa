// The thread from which watchers look at a render: checkpoints, pictures of what is there so far.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "session/render_state.h"

namespace weft::session {

/// Calls each watcher again and again, after its interval, with the state that `snapshot` returns.
/// One call is made at a time, and the destructor waits for it.
class Watching {
  public:
    Watching(std::vector<Watcher> const& watchers, std::function<RenderState()> snapshot);
    Watching(Watching const&) = delete;
    Watching& operator=(Watching const&) = delete;
    ~Watching();

  private:
    void run();

    std::vector<Watcher> const& watchers_;
    std::function<RenderState()> snapshot_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool over_ = false;
    std::thread thread_;
};

} // namespace weft::session
