// The thread from which watchers look at a render: checkpoints, pictures of what is there so far.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "session/render_state.h"

namespace weft::session {

/// Calls each watcher after its interval, again and again, with what `snapshot` gives; not while
/// an earlier call goes on. The end of its life waits for a call that goes on.
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
