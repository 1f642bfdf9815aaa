// Processor time of a render by feature (base/feature.h), measured by sampling.
//
// One thread wakes about every millisecond, at intervals drawn at random so that they fall in step
// with nothing, and looks at each thread that is at work: which feature it is at, and how much
// processor time it has had since the last look, by the system's clock of that very thread. The
// feature is given that time. So a thread that waits for a disk, or that another program keeps from
// its processor, gives no time to anything, and what the features were given adds up to the
// processor time that threads measure of themselves (`Profile::processor_seconds`), but for what
// came after the last look. A share p that n samples tell is right within sqrt(p (1 - p) / n).
//
// Other ways, and why not:
// * A timer on each thread's clock that sends SIGPROF, as in pbrt-v3: what it interrupts (reading
//   textures, waiting) must cope with EINTR, its handler may do next to nothing, signals get in
//   the way of a program's own, and Linux lets such timers fire on scheduler ticks only, some 250
//   times a second and in step with the scheduler.
// * The processor's time stamps read at every border: some 20 cycles each, too many for borders
//   such as that of a texture, counted by wall time, and paid for by all who do not profile, or
//   else by a branch at each border.
// * The system's profilers (perf) know functions, which are inlined into each other, and need
// rights.
//
// Where the system has no clock of other threads' processor time, wall time takes its place.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "base/feature.h"

namespace weft {

/// For people and programs: "closest hits".
std::string_view feature_name(Feature feature);

struct Profile {
    std::array<double, kFeatures> seconds{}; ///< of processor time, by Feature, from samples
    uint64_t samples = 0;                    ///< looks at a thread that had run since the last one
    double processor_seconds = 0;            ///< of all threads at work, measured
    double thread_seconds = 0; ///< wall time times threads: what they could have had; set by users

    Profile& operator+=(Profile const& o);
};

class Profiler {
  public:
    /// Starts to look.
    Profiler();
    ~Profiler();
    Profiler(Profiler const&) = delete;
    Profiler& operator=(Profiler const&) = delete;

    /// While it lives, the thread that made it is at work: looked at, and its time counted. Not
    /// nested. `profiler` may be null: then it does nothing.
    class Work {
      public:
        explicit Work(Profiler* profiler) : profiler_(profiler) {
            if (profiler_) profiler_->begin();
        }
        ~Work() {
            if (profiler_) profiler_->end();
        }
        Work(Work const&) = delete;
        Work& operator=(Work const&) = delete;

      private:
        Profiler* profiler_;
    };

    /// What was seen of work that has ended.
    Profile profile() const;

  private:
    struct Worker;

    void begin();
    void end();
    void run();
    void look();
    Worker& this_worker();

    mutable std::mutex mutex_; ///< of all below
    std::condition_variable changed_;
    bool over_ = false;
    std::vector<Worker> workers_;
    Profile profile_;
    std::thread thread_;
};

} // namespace weft
