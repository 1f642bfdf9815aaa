#include "apps/weft/interrupt.h"

#include <csignal>
#include <unistd.h>

#include "apps/weft/commands.h"

namespace weft::apps {

namespace {

// Signal handlers see nothing but globals.
std::atomic<bool> graceful{false};
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
    if (graceful) {
        interrupted = true;
        return;
    }
    constexpr char message[] = "stopped: no file is overwritten\n";
    [[maybe_unused]] auto const written = write(STDERR_FILENO, message, sizeof message - 1);
    _exit(kInterrupted);
}

} // namespace

void handle_interrupts() {
    struct sigaction action = {};
    action.sa_handler = on_signal;
    // The second signal finds the system's own handler, and files are read on.
    action.sa_flags = int(SA_RESETHAND) | SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

GracefulInterrupt::GracefulInterrupt() { graceful = true; }
GracefulInterrupt::~GracefulInterrupt() { graceful = false; }
std::atomic<bool> const& GracefulInterrupt::flag() const { return interrupted; }

} // namespace weft::apps
