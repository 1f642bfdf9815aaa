#include "base/memo.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

using namespace weft;

namespace {

struct Key {
    uint32_t a, b;
};

double slow(Key const& key) { return key.a * 1e3 + key.b; }

Memo<Key, double, 64> small, large_enough;

TEST(Memo, ComputesOnceWhatFits) {
    int computed = 0;
    auto const count = [&](Key const& key) {
        ++computed;
        return slow(key);
    };
    for (int round = 0; round < 3; ++round)
        for (uint32_t i = 0; i < 6; ++i) EXPECT_EQ(large_enough.get({i, 5}, count), i * 1e3 + 5);
    EXPECT_EQ(computed, 6);
}

/// Far more keys than there is room for, asked for by many threads at the same time.
TEST(Memo, SaysWhatTheFunctionSays) {
    std::vector<std::thread> threads;
    std::array<int, 4> wrong{};
    for (size_t t = 0; t < wrong.size(); ++t)
        threads.emplace_back([&, t] {
            for (uint32_t i = 0; i < 20000; ++i) {
                Key const key{hash32(i) % 300, uint32_t(i % 3)};
                wrong[t] += small.get(key, slow) != slow(key);
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, (std::array<int, 4>{}));
}

} // namespace
