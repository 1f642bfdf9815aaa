#include "bench/render_bench.h"

#include "bench/raw_limit.h"
#include "integrator/pixel_renderer.h"
#include "io/scene_file.h"
#include "session/render.h"

namespace weft::bench {

namespace {

/// Pixel samples whose rays are recorded at most; a path has about ten rays of 56 bytes each.
constexpr double kRecordedSamples = 1 << 21;

Cost keep_best(Cost const& best, Cost const& c) {
    return {std::min(best.wall, c.wall), std::min(best.cpu, c.cpu)};
}

struct RayCount {
    double all = 0, shadow = 0;
};

RayCount count_rays(world::RayRecorder const& recorder) {
    RayCount count;
    for (auto const& list : recorder.lists())
        for (world::RecordedRay const& ray : *list) {
            ++count.all;
            count.shadow += ray.query == world::Query::shadow;
        }
    return count;
}

/// Renders with few enough samples per pixel, and returns how many those are.
int record_rays(scene::RenderJob const& job, bool compensate, int spp,
                world::RayRecorder& recorder) {
    auto const stage = lights::Stage::commit(job.scene, {.recorder = &recorder}, compensate);
    Vec2i const size = stage->world().camera().size();
    session::RenderOptions options;
    options.limits.spp = std::clamp(int(kRecordedSamples / (double(size.x) * size.y)), 1, spp);
    session::render(*stage, job, options);
    return options.limits.spp;
}

} // namespace

double relative_variance(image::Image const& a, image::Image const& b) {
    double sum = 0;
    size_t const pixels = size_t(a.width) * size_t(a.height);
    for (size_t i = 0; i < pixels; ++i) {
        auto pixel_luminance = [&](image::Image const& im) {
            float const* p = &im.pixels[size_t(im.channels) * i];
            return double(luminance(Color(p[0], p[1], p[2])));
        };
        double const x = pixel_luminance(a), y = pixel_luminance(b), m = (x + y) / 2;
        sum += (x - y) * (x - y) / 2 / (m * m + 0.01);
    }
    return sum / double(pixels);
}

RenderFigures measure_render(std::string const& scene_file, world::RayRecorder& recorder,
                             int rounds) {
    scene::RenderJob const job = std::move(io::read_scene_file(scene_file).jobs.front());
    bool const compensate = integrator::combines_strategies(job.integrator);
    int const spp = session::sample_count(job.sampler);
    for (auto const& list : recorder.lists()) list->clear();
    int const recorded_spp = record_rays(job, compensate, spp, recorder);
    RayCount const rays = count_rays(recorder);
    auto const stage = lights::Stage::commit(job.scene, {}, compensate);
    world::World const& world = stage->world();
    Vec2i const size = world.camera().size();
    double const pixels = double(size.x) * size.y;

    Cost render{kInfinity, kInfinity}, kernel = render;
    std::vector<image::Image> images;
    for (int round = 0; round < rounds; ++round) {
        session::RenderOptions options;
        options.picture.seed = uint32_t(round);
        Stopwatch const watch;
        session::RenderResult result = session::render(*stage, job, options);
        render = keep_best(render, watch.stop());
        if (images.size() < 2) images.push_back(std::move(result.image));
        kernel = keep_best(kernel, replay(world, recorder));
    }

    double const scale = double(spp) / recorded_spp;
    RenderFigures f;
    f.triangles = world.statistics().triangles;
    f.width = size.x;
    f.height = size.y;
    f.spp = uint32_t(spp);
    f.seconds = render.wall;
    f.pixel_samples_per_second = pixels * spp / render.wall;
    f.rays_per_second = rays.all * scale / render.wall;
    f.rays_per_sample = rays.all / (pixels * recorded_spp);
    f.shadow_rays = rays.shadow / rays.all;
    f.share = kernel.wall * scale / render.wall;
    f.cpu_share = kernel.cpu * scale / render.cpu;
    f.variance = relative_variance(images[0], images[1]);
    return f;
}

} // namespace weft::bench
