// weft_bench [OUT.json] [NAME...]: runs all benchmarks or those named, prints a table, and writes
// the figures to OUT.json. docs/performance.md says what each means.
// weft_bench assets: only makes the files that the scenes name.
// weft_bench variance A B: prints the relative variance of two pictures of one scene.
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/assets.h"
#include "bench/loading_bench.h"
#include "bench/render_bench.h"

namespace weft::bench {

namespace {

std::string const kScenes = WEFT_SOURCE_DIR "/bench/scenes/",
                  kAssets = WEFT_SOURCE_DIR "/build/bench";

struct RenderBench {
    std::string name;
    double share_target = 0; ///< least share of the raw limit; 0: none
    double work_target = 0;  ///< largest seconds x variance; 0: none
};

/// Seconds x variance is what a renderer needs for a picture of given noise. The Cornell box is
/// held to half the best product measured with other renderers on a machine of two such
/// processors: 5.5 s x 1.09e-3 (Mitsuba 3, 16-wide LLVM mode).
std::vector<RenderBench> const kRenderBenches{{"diffuse_area", 0.55, 0},
                                              {"glass_textures_env", 0.45, 0},
                                              {"disney", 0.40, 0},
                                              {"instances", 0, 0},
                                              {"cornell", 0, 3.0e-3}};
constexpr char const* kLoadingBench = "load_1m";
constexpr double kLoadingTarget = 2;

nlohmann::ordered_json to_json(RenderBench const& bench, RenderFigures const& f) {
    nlohmann::ordered_json j{{"name", bench.name},
                             {"triangles", f.triangles},
                             {"width", f.width},
                             {"height", f.height},
                             {"spp", f.spp},
                             {"seconds", f.seconds},
                             {"pixel_samples_per_second", f.pixel_samples_per_second},
                             {"rays_per_second", f.rays_per_second},
                             {"rays_per_sample", f.rays_per_sample},
                             {"shadow_rays", f.shadow_rays},
                             {"share_of_raw_limit", f.share},
                             {"share_of_raw_limit_cpu", f.cpu_share},
                             {"relative_variance", f.variance},
                             {"seconds_times_variance", f.seconds * f.variance}};
    if (bench.share_target > 0) j["share_target"] = bench.share_target;
    if (bench.work_target > 0) j["seconds_times_variance_target"] = bench.work_target;
    return j;
}

nlohmann::ordered_json to_json(LoadingFigures const& f) {
    return {{"name", kLoadingBench},
            {"triangles", f.triangles},
            {"file_seconds", f.file_seconds},
            {"kernel_seconds", f.kernel_seconds},
            {"read_seconds", f.read_seconds},
            {"commit_seconds", f.commit_seconds},
            {"ratio", f.ratio()},
            {"ratio_target", kLoadingTarget}};
}

char const* verdict(bool met) { return met ? "met" : "MISSED"; }

void print_row(RenderBench const& bench, RenderFigures const& f) {
    fmt::print("{:<20}{:>10}{:>9.2f}{:>11.2f}{:>9.2f}{:>9.2f}{:>9.2f}{:>12.2e}{:>12.2e}",
               bench.name, f.triangles, f.seconds, f.pixel_samples_per_second * 1e-6,
               f.rays_per_second * 1e-6, f.share, f.cpu_share, f.variance, f.seconds * f.variance);
    if (bench.share_target > 0)
        fmt::print("  share >= {}: {}", bench.share_target, verdict(f.share >= bench.share_target));
    if (bench.work_target > 0)
        fmt::print("  s x variance <= {:.1e}: {}", bench.work_target,
                   verdict(f.seconds * f.variance <= bench.work_target));
    fmt::print("\n");
    std::fflush(stdout);
}

void print_loading(LoadingFigures const& f) {
    fmt::print("{:<20}{:>10}  read {:.0f} ms + commit {:.0f} ms = {:.2f} x (file {:.0f} ms + "
               "Embree {:.0f} ms)  <= {}: {}\n",
               kLoadingBench, f.triangles, f.read_seconds * 1e3, f.commit_seconds * 1e3, f.ratio(),
               f.file_seconds * 1e3, f.kernel_seconds * 1e3, kLoadingTarget,
               verdict(f.ratio() <= kLoadingTarget));
}

int run(std::vector<std::string> names) {
    std::string output;
    std::erase_if(names,
                  [&](std::string const& s) { return s.ends_with(".json") && (output = s, true); });
    std::vector<std::string> known{kLoadingBench};
    for (RenderBench const& bench : kRenderBenches) known.push_back(bench.name);
    for (std::string const& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            fmt::print(stderr, "weft_bench: unknown benchmark '{}'; known: {}\n", name,
                       fmt::join(known, ", "));
            return 2;
        }
    auto wanted = [&](std::string const& name) {
        return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
    };

    make_assets(kAssets);
    nlohmann::ordered_json report{{"threads", std::thread::hardware_concurrency()},
                                  {"renders", nlohmann::ordered_json::array()}};
    fmt::print("{:<20}{:>10}{:>9}{:>11}{:>9}{:>9}{:>9}{:>12}{:>12}\n", "scene", "triangles",
               "seconds", "Msamples/s", "Mrays/s", "share", "cpu", "variance", "s x var");
    world::RayRecorder recorder;
    for (RenderBench const& bench : kRenderBenches) {
        if (!wanted(bench.name)) continue;
        RenderFigures const f = measure_render(kScenes + bench.name + ".xml", recorder);
        print_row(bench, f);
        report["renders"].push_back(to_json(bench, f));
    }
    if (wanted(kLoadingBench)) {
        LoadingFigures const f = measure_loading(kScenes + std::string(kLoadingBench) + ".xml",
                                                 kAssets + "/million.ply");
        print_loading(f);
        report["loading"] = to_json(f);
    }
    if (output.empty()) return 0;
    std::ofstream file(output);
    file << report.dump(2) << '\n';
    if (file.flush()) return 0;
    fmt::print(stderr, "weft_bench: cannot write {}\n", output);
    return 1;
}

int print_variance(std::string const& a, std::string const& b) {
    image::Image const first = image::read_image(a), second = image::read_image(b);
    if (first.width != second.width || first.height != second.height) {
        fmt::print(stderr, "weft_bench: expected pictures of one size, found {} x {} and {} x {}\n",
                   first.width, first.height, second.width, second.height);
        return 2;
    }
    fmt::print("{}\n", relative_variance(first, second));
    return 0;
}

} // namespace

} // namespace weft::bench

int main(int argc, char** argv) {
    try {
        std::vector<std::string> const arguments{argv + 1, argv + argc};
        if (arguments.size() == 3 && arguments[0] == "variance")
            return weft::bench::print_variance(arguments[1], arguments[2]);
        if (arguments.size() == 1 && arguments[0] == "assets") {
            weft::bench::make_assets(weft::bench::kAssets);
            return 0;
        }
        return weft::bench::run(arguments);
    } catch (std::exception const& e) {
        fmt::print(stderr, "weft_bench: {}\n", e.what());
        return 1;
    }
}
