// The values of a slow function, remembered for all threads.
//
// The function must depend on its key alone. So it does not matter which thread computes a value
// first, or whether a value is found or computed again: the bits are the same. That is also why
// nothing waits. A value that is being written, or for which there is no room, is computed once
// more.
#pragma once

#include <array>
#include <atomic>
#include <cstring>
#include <type_traits>

#include "base/hash.h"

namespace weft {

/// Room for up to `kSlots` values, a power of two. An instance must be static: its memory is then
/// zero from the start, and costs nothing before it is used. `Key` has no padding.
template <class Key, class Value, size_t kSlots>
class Memo {
  public:
    /// Returns compute(key).
    template <class F>
    Value get(Key const& key, F const& compute) {
        constexpr size_t most_probes = 8;
        uint32_t const hash = hash_of(key);
        for (size_t i = 0; i < most_probes; ++i) {
            Slot& slot = slots_[(hash + i) % kSlots];
            std::atomic_ref<State> shared(slot.state);
            State state = shared.load(std::memory_order_acquire);
            if (state == State::Empty &&
                shared.compare_exchange_strong(state, State::Writing, std::memory_order_acquire)) {
                slot.key = key;
                slot.value = compute(key);
                shared.store(State::Known, std::memory_order_release);
                return slot.value;
            }
            if (state == State::Known && std::memcmp(&slot.key, &key, sizeof(Key)) == 0)
                return slot.value;
        }
        return compute(key);
    }

  private:
    static_assert(std::has_unique_object_representations_v<Key>);
    static_assert(std::is_trivially_copyable_v<Value> && (kSlots & (kSlots - 1)) == 0);

    enum class State : uint32_t { Empty, Writing, Known };
    struct Slot {
        State state; ///< read and written as an atomic
        Key key;
        Value value;
    };

    static uint32_t hash_of(Key const& key) {
        static_assert(sizeof(Key) % sizeof(uint32_t) == 0);
        std::array<uint32_t, sizeof(Key) / sizeof(uint32_t)> words;
        std::memcpy(words.data(), &key, sizeof(Key));
        uint32_t hash = 0;
        for (uint32_t word : words) hash = hash_combine(hash, word);
        return hash;
    }

    std::array<Slot, kSlots> slots_;
};

} // namespace weft
