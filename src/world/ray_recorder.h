// The rays of a render, thread by thread in the order in which they were traced, so that they
// can be replayed through the kernel alone: what that takes is the limit of any renderer on it.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "world/ray.h"

namespace weft::world {

struct RecordedRay {
    Ray ray;
    bool shadow;
};

class RayRecorder {
  public:
    void record(Ray const& ray, bool shadow) { mine().push_back({ray, shadow}); }

    /// One list per thread that has traced.
    std::vector<std::unique_ptr<std::vector<RecordedRay>>> const& lists() const { return lists_; }

  private:
    std::vector<RecordedRay>& mine() {
        // By number, not by address: another recorder may come to live at the same one.
        thread_local uint64_t owner = 0;
        thread_local std::vector<RecordedRay>* list = nullptr;
        if (owner != id_) {
            std::lock_guard lock(mutex_);
            lists_.push_back(std::make_unique<std::vector<RecordedRay>>());
            list = lists_.back().get();
            owner = id_;
        }
        return *list;
    }

    static uint64_t next_id() {
        static std::atomic<uint64_t> last{0};
        return ++last;
    }

    uint64_t const id_ = next_id();
    std::mutex mutex_;
    std::vector<std::unique_ptr<std::vector<RecordedRay>>> lists_;
};

} // namespace weft::world
