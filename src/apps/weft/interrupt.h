// What Ctrl-C (SIGINT) and SIGTERM do: they end the program at once with exit code 130, except
// while a GracefulInterrupt lives. That one is told, so that it can stop and keep its work; a
// second signal then kills the program whatever it does.
#pragma once

#include <atomic>

namespace weft::apps {

/// Installs the handlers. To be called first in main.
void handle_interrupts();

/// While it lives, the first signal sets `flag` and nothing else. One at a time.
class GracefulInterrupt {
  public:
    GracefulInterrupt();
    ~GracefulInterrupt();
    GracefulInterrupt(GracefulInterrupt const&) = delete;
    GracefulInterrupt& operator=(GracefulInterrupt const&) = delete;

    std::atomic<bool> const& flag() const;
};

} // namespace weft::apps
