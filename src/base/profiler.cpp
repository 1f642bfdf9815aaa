#include "base/profiler.h"

#include <chrono>
#include <ctime>

#include <pthread.h>
#include <unistd.h>

#include "base/hash.h"

namespace weft {

namespace {

/// Processor time of the thread that made it, for any thread to read while that one lives.
class ThreadClock {
  public:
#if defined(_POSIX_THREAD_CPUTIME) && _POSIX_THREAD_CPUTIME >= 0
    ThreadClock() {
        if (pthread_getcpuclockid(pthread_self(), &clock_) != 0) clock_ = CLOCK_MONOTONIC;
    }

  private:
    clockid_t clock_;
#else
  private:
    clockid_t clock_ = CLOCK_MONOTONIC;
#endif

  public:
    double seconds() const {
        timespec t = {};
        clock_gettime(clock_, &t);
        return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
    }
};

constexpr std::array<std::string_view, kFeatures> kNames{
    "integration", "closest hits", "shadow rays",    "surface points", "shading", "textures",
    "bsdf",        "light choice", "light sampling", "media",          "camera",  "film"};

} // namespace

std::string_view feature_name(Feature feature) { return kNames[size_t(feature)]; }

Profile& Profile::operator+=(Profile const& o) {
    for (size_t i = 0; i < kFeatures; ++i) seconds[i] += o.seconds[i];
    samples += o.samples;
    processor_seconds += o.processor_seconds;
    thread_seconds += o.thread_seconds;
    return *this;
}

/// A thread that is or was at work.
struct Profiler::Worker {
    std::thread::id id;
    std::atomic<Feature> const* feature = nullptr; ///< null: not at work
    ThreadClock clock{};
    double began = 0;   ///< its clock when its work began
    double last = 0;    ///< its clock when it was last looked at, or began
    double pending = 0; ///< seconds of earlier work that no look has given to a feature
};

Profiler::Profiler() : thread_([this] { run(); }) {}

Profiler::~Profiler() {
    {
        std::lock_guard const lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

Profile Profiler::profile() const {
    std::lock_guard const lock(mutex_);
    return profile_;
}

Profiler::Worker& Profiler::this_worker() {
    auto const id = std::this_thread::get_id();
    for (Worker& w : workers_)
        if (w.id == id) return w;
    return workers_.emplace_back(Worker{.id = id});
}

void Profiler::begin() {
    std::lock_guard const lock(mutex_);
    Worker& w = this_worker();
    w.clock = ThreadClock(); // a thread that is gone may have left its id to this one
    w.feature = &detail::current_feature;
    w.began = w.last = w.clock.seconds();
}

void Profiler::end() {
    std::lock_guard const lock(mutex_);
    Worker& w = this_worker();
    double const now = w.clock.seconds();
    profile_.processor_seconds += now - w.began;
    w.pending += now - w.last;
    w.feature = nullptr;
}

void Profiler::look() {
    for (Worker& w : workers_) {
        if (!w.feature) continue;
        double const now = w.clock.seconds();
        if (now == w.last) continue; // it has not run, and is where it was
        profile_.seconds[size_t(w.feature->load(std::memory_order_relaxed))] +=
            w.pending + now - w.last;
        ++profile_.samples;
        w.last = now;
        w.pending = 0;
    }
}

void Profiler::run() {
    Rng rng;
    std::unique_lock lock(mutex_);
    auto const interval = [&] {
        return std::chrono::duration<double, std::milli>(0.5 + double(rng.next()));
    };
    while (!changed_.wait_for(lock, interval(), [&] { return over_; })) look();
}

} // namespace weft
