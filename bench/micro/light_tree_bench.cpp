// Google Benchmark: what it costs to choose one of many lights, and to ask for the chance of one:
// points, spheres and flat lamps at random places in a cube, seen from random points inside.
#include <benchmark/benchmark.h>

#include "base/hash.h"
#include "base/warp.h"
#include "lights/light_tree.h"

namespace {

using namespace weft;

lights::LightTree tree_of(int64_t count) {
    Rng rng(uint64_t(count) + 1);
    float const size = 0.2f / std::cbrt(float(count));
    std::vector<lights::LightBounds> lamps(static_cast<size_t>(count));
    for (size_t i = 0; i < lamps.size(); ++i) {
        lamps[i].low = lamps[i].high = rng.next3();
        if (i % 3 > 0) lamps[i].high += Vec3(size);
        if (i % 3 > 1) lamps[i].theta_o = 0;
        lamps[i].axis = square_to_sphere(rng.next2());
        lamps[i].power = 0.5f + rng.next();
    }
    return lights::LightTree(lamps);
}

struct Query {
    Vec3 ref, normal;
    float u;
    uint32_t light;
};

std::vector<Query> queries(int64_t count) {
    Rng rng(1);
    std::vector<Query> made;
    for (int i = 0; i < 4096; ++i) {
        Vec3 const ref = rng.next3(), normal = square_to_sphere(rng.next2());
        float const u = rng.next();
        made.push_back({ref, normal, u, rng.next_uint() % uint32_t(count)});
    }
    return made;
}

/// Asks a tree of as many lights as the benchmark says.
template <class Ask>
void time_queries(benchmark::State& state, Ask const& ask) {
    lights::LightTree const tree = tree_of(state.range(0));
    auto const made = queries(state.range(0));
    size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(ask(tree, made[i++ % made.size()]));
}

void light_tree_choose(benchmark::State& state) {
    time_queries(state, [](lights::LightTree const& tree, Query const& q) {
        return tree.choose(q.ref, q.normal, q.u);
    });
}
BENCHMARK(light_tree_choose)->DenseRange(1, 4)->RangeMultiplier(10)->Range(10, 100'000);

void light_tree_probability(benchmark::State& state) {
    time_queries(state, [](lights::LightTree const& tree, Query const& q) {
        return tree.probability(q.ref, q.normal, q.light);
    });
}
BENCHMARK(light_tree_probability)->DenseRange(1, 4)->RangeMultiplier(10)->Range(10, 100'000);

} // namespace
