// Google Benchmark: what it costs to evaluate one hit of a `disney` surface, from its node network
// to a sampled direction, beside a ray of the kernel on the same machine. The scene is that of the
// benchmark `disney`, whose meshes and textures `weft_bench` writes: run that first.
#include <benchmark/benchmark.h>

#include "base/hash.h"
#include "base/warp.h"
#include "bench/assets.h"
#include "io/scene_file.h"
#include "world/world.h"

namespace {

using namespace weft;

struct SeenPoint {
    shading::SurfacePoint point;
    Vec3 wo;
    Vec3 u;
};

/// The world of the scene, and points of it that the camera sees in no order.
struct Fixture {
    std::shared_ptr<scene::Scene const> scene;
    std::unique_ptr<world::World const> world;
    std::vector<SeenPoint> seen;

    Fixture() {
        bench::make_assets(WEFT_SOURCE_DIR "/build/bench");
        scene = io::read_scene_file(WEFT_SOURCE_DIR "/bench/scenes/disney.xml").jobs.front().scene;
        world = world::World::commit(scene);
        Vec2i const size = world->camera().size();
        Rng rng(1);
        while (seen.size() < 4096) {
            Vec2 const raster(rng.next() * float(size.x), rng.next() * float(size.y));
            world::Ray const ray = world->camera().ray(raster, {0.5f, 0.5f}, 0, 1);
            if (world::Hit const hit = world->intersect(ray))
                seen.push_back({world->surface(ray, hit), -ray.direction, rng.next3()});
        }
    }
};

Fixture const& fixture() {
    static Fixture const f;
    return f;
}

void disney_hit(benchmark::State& state) {
    Fixture const& f = fixture();
    size_t i = 0;
    for (auto _ : state) {
        SeenPoint const& s = f.seen[i++ % f.seen.size()];
        shading::Shading const shading = f.world->shade(s.point, s.wo);
        benchmark::DoNotOptimize(shading.bsdf.sample(s.wo, s.u));
    }
}
BENCHMARK(disney_hit);

void kernel_ray(benchmark::State& state) {
    Fixture const& f = fixture();
    size_t i = 0;
    for (auto _ : state) {
        SeenPoint const& s = f.seen[i++ % f.seen.size()];
        world::Ray ray;
        ray.direction = Frame(s.point.ng).to_world(square_to_cosine_hemisphere({s.u.x, s.u.y}));
        ray.origin = shading::offset_origin(s.point, ray.direction);
        benchmark::DoNotOptimize(f.world->intersect(ray));
    }
}
BENCHMARK(kernel_ray);

} // namespace

BENCHMARK_MAIN();
