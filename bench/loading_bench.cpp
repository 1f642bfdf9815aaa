#include "bench/loading_bench.h"

#include <fstream>

#include "bench/raw_limit.h"
#include "io/ply.h"
#include "io/scene_file.h"
#include "lights/stage.h"

namespace weft::bench {

namespace {

double read_file(std::string const& path) {
    Stopwatch const watch;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    std::vector<char> bytes(size_t(file.tellg()));
    file.seekg(0);
    file.read(bytes.data(), std::streamsize(bytes.size()));
    return watch.stop().wall;
}

/// `positions` has one vertex more than the mesh, which the kernel's loads may touch.
double build_kernel(std::vector<Vec3> const& positions,
                    std::vector<scene::Mesh::Triangle> const& triangles) {
    RTCDevice const device = rtcNewDevice("");
    RTCScene const scene = rtcNewScene(device);
    Stopwatch const watch;
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               positions.data(), 0, sizeof(Vec3), positions.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               triangles.data(), 0, sizeof triangles[0], triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    double const seconds = watch.stop().wall;
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return seconds;
}

} // namespace

LoadingFigures measure_loading(std::string const& scene_file, std::string const& mesh_file,
                               int rounds) {
    scene::Mesh const mesh = io::read_ply(mesh_file);
    std::vector<Vec3> positions = mesh.positions;
    positions.push_back(Vec3(0));
    auto const best = [](double& so_far, double seconds) { so_far = std::min(so_far, seconds); };
    LoadingFigures f{mesh.triangles.size(), kInfinity, kInfinity, kInfinity, kInfinity};
    for (int round = 0; round < rounds; ++round) {
        best(f.file_seconds, read_file(mesh_file));
        best(f.kernel_seconds, build_kernel(positions, mesh.triangles));
        Stopwatch const reading;
        scene::RenderJob const job = std::move(io::read_scene_file(scene_file).jobs.front());
        best(f.read_seconds, reading.stop().wall);
        Stopwatch const committing;
        auto const stage = lights::Stage::commit(job.scene);
        best(f.commit_seconds, committing.stop().wall);
    }
    return f;
}

} // namespace weft::bench
