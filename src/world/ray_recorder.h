// Keeps the rays of a render, thread by thread in the order in which they were traced.
// `World::replay` traces them again: the time that takes is the limit of any renderer on this
// kernel.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "shading/materials.h"
#include "world/ray.h"

namespace weft::world {

/// What a ray asks of the world.
enum class Query : uint8_t {
    closest,  ///< World::intersect
    passable, ///< World::intersect_passable
    solid,    ///< World::intersect_solid
    shadow,   ///< World::visibility
};

struct RecordedRay {
    Ray ray;
    Query query = Query::closest;
    shading::Look look;      ///< of a shadow ray
    uint32_t alpha_seed = 0; ///< of the others: decides which partly transparent surfaces they meet
};

class RayRecorder {
  public:
    /// Appends to the list of the calling thread.
    void record(RecordedRay const& ray) { mine().push_back(ray); }

    /// Returns one list per thread that has traced. Only while no thread records.
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
