#include "bench/raw_limit.h"

#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>

namespace weft::bench {

namespace {

Cost now() {
    double const wall =
        std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    return {wall, double(std::clock()) / CLOCKS_PER_SEC};
}

} // namespace

Cost replay(world::World const& world, world::RayRecorder const& rays) {
    constexpr size_t chunk = 1 << 14;
    auto const& lists = rays.lists();
    std::vector<std::atomic<size_t>> next(lists.size());
    std::atomic<uint32_t> sum{0};
    auto work = [&](size_t own) {
        uint32_t mine = 0;
        for (size_t step = 0; step < lists.size(); ++step) {
            size_t const k = (own + step) % lists.size();
            auto const& list = *lists[k];
            for (size_t from = next[k].fetch_add(chunk); from < list.size();
                 from = next[k].fetch_add(chunk))
                for (size_t i = from; i < std::min(from + chunk, list.size()); ++i)
                    mine += world.replay(list[i]);
        }
        sum += mine; // read by nobody, but an atomic store stays
    };
    Stopwatch const watch;
    std::vector<std::jthread> threads;
    for (size_t i = 0; i < lists.size(); ++i) threads.emplace_back(work, i);
    for (auto& thread : threads) thread.join();
    return watch.stop();
}

Stopwatch::Stopwatch() : start_(now()) {}

Cost Stopwatch::stop() const {
    Cost const end = now();
    return {end.wall - start_.wall, end.cpu - start_.cpu};
}

} // namespace weft::bench
