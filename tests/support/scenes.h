// Scenes for tests: written as the text of scene files, committed, and rendered with statistics.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "image/write.h"
#include "integrator/pixel_renderer.h"
#include "io/scene_file.h"
#include "lights/stage.h"
#include "tests/support/statistics.h"

namespace weft::testing {

/// A folder that lasts as long as the object.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "weft_test_XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;
    std::string const& path() const { return path_; }
    std::string operator/(std::string const& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

/// A job whose scene holds `contents`, and the stage made of it with its world. Attributes of the
/// integrator and the sampler are given as in a file.
struct TestScene {
    scene::RenderJob job;
    std::unique_ptr<lights::Stage const> stage;
    world::World const* world;

    void commit(world::CommitOptions const& options = {}, bool compensate = false) {
        stage = lights::Stage::commit(job.scene, options, compensate);
        world = &stage->world();
    }
};

inline TestScene make_scene(std::string const& contents,
                            std::string const& integrator = "type=\"path\"",
                            std::string const& folder = "",
                            std::string const& sampler = "type=\"independent\"") {
    std::string const text = "<integrator " + integrator + "><sampler " + sampler + "/><scene>" +
                             contents + "</scene></integrator>";
    TestScene made{io::parse_scene(text, "test", folder).jobs.at(0), nullptr, nullptr};
    made.commit({}, integrator::combines_strategies(made.job.integrator));
    return made;
}

/// Estimates of the mean over blocks of pixels, by colour: estimates[3 * block + channel], blocks
/// row by row. The variance is that of independent samples within each pixel.
inline std::vector<Estimate> block_estimates(TestScene const& scene, int samples, int block,
                                             uint32_t seed) {
    integrator::PixelRenderer const renderer(*scene.stage, scene.job.integrator, scene.job.sampler,
                                             seed);
    Vec2i const size = scene.world->camera().size();
    int const columns = size.x / block, rows = size.y / block;
    std::vector<Estimate> result(size_t(3 * columns * rows));
    double const pixels = block * block;
    for (int y = 0; y < rows * block; ++y)
        for (int x = 0; x < columns * block; ++x) {
            double sum[3]{}, squares[3]{};
            for (int s = 0; s < samples; ++s) {
                Color const c = renderer.sample({x, y}, uint32_t(s));
                for (int k = 0; k < 3; ++k) {
                    sum[k] += double(c[k]);
                    squares[k] += double(c[k]) * double(c[k]);
                }
            }
            for (int k = 0; k < 3; ++k) {
                Estimate& e = result[size_t(3 * (y / block * columns + x / block) + k)];
                double const mean = sum[k] / samples;
                double const variance =
                    std::max(0.0, squares[k] / samples - mean * mean) / (samples - 1);
                e.mean += mean / pixels;
                e.variance += variance / (pixels * pixels);
            }
        }
    return result;
}

/// The two-sided probability of a difference at least as large, if the means were equal. Float
/// arithmetic may differ by a few ulps where there is no noise.
inline double difference_p_value(Estimate const& a, Estimate const& b) {
    double const rounding = 4e-6 * (std::abs(a.mean) + std::abs(b.mean));
    double const beyond = std::max(0.0, std::abs(a.mean - b.mean) - rounding),
                 variance = a.variance + b.variance;
    if (variance == 0) return beyond == 0 ? 1 : 0;
    return normal_tail(beyond / std::sqrt(variance));
}

/// A closed mesh: an icosahedron whose triangles are cut in four `levels` times, on the unit
/// sphere, counter-clockwise from outside; with normals and uvs where asked for.
inline scene::Mesh icosphere(int levels, bool with_normals) {
    scene::Mesh mesh;
    float const g = 1.6180339887f;
    for (float s : {-1.f, 1.f})
        for (float t : {-g, g}) {
            mesh.positions.push_back(normalize(Vec3(0, s, t)));
            mesh.positions.push_back(normalize(Vec3(s, t, 0)));
            mesh.positions.push_back(normalize(Vec3(t, 0, s)));
        }
    // The faces are the triples of vertices that are nearest neighbours of each other.
    auto near = [&](uint32_t a, uint32_t b) {
        return length(mesh.positions[a] - mesh.positions[b]) < 1.1f;
    };
    for (uint32_t a = 0; a < 12; ++a)
        for (uint32_t b = a + 1; b < 12; ++b)
            for (uint32_t c = b + 1; c < 12; ++c)
                if (near(a, b) && near(b, c) && near(a, c)) {
                    bool const outwards = dot(cross(mesh.positions[b] - mesh.positions[a],
                                                    mesh.positions[c] - mesh.positions[a]),
                                              mesh.positions[a]) > 0;
                    if (outwards)
                        mesh.triangles.push_back({{a, b, c}});
                    else
                        mesh.triangles.push_back({{a, c, b}});
                }
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        auto middle = [&](uint32_t a, uint32_t b) {
            auto const [it, fresh] =
                middles.emplace(std::minmax(a, b), uint32_t(mesh.positions.size()));
            if (fresh) mesh.positions.push_back(normalize(mesh.positions[a] + mesh.positions[b]));
            return it->second;
        };
        std::vector<scene::Mesh::Triangle> finer;
        for (auto const& t : mesh.triangles) {
            uint32_t const ab = middle(t.v[0], t.v[1]), bc = middle(t.v[1], t.v[2]),
                           ca = middle(t.v[2], t.v[0]);
            finer.push_back({{t.v[0], ab, ca}});
            finer.push_back({{t.v[1], bc, ab}});
            finer.push_back({{t.v[2], ca, bc}});
            finer.push_back({{ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    if (with_normals) mesh.normals = mesh.positions;
    for (Vec3 const& p : mesh.positions)
        mesh.uvs.push_back({0.5f + 0.5f * p.x, 0.5f + 0.4f * p.y + 0.1f * p.z});
    return mesh;
}

/// As an ASCII PLY with all digits of its floats.
inline void write_ply(std::string const& path, scene::Mesh const& mesh) {
    std::ofstream out(path);
    out.precision(9);
    out << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
        << "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!mesh.normals.empty()) out << "property float nx\nproperty float ny\nproperty float nz\n";
    if (!mesh.uvs.empty()) out << "property float s\nproperty float t\n";
    out << "element face " << mesh.triangles.size()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        Vec3 const& p = mesh.positions[i];
        out << p.x << ' ' << p.y << ' ' << p.z;
        if (!mesh.normals.empty())
            out << ' ' << mesh.normals[i].x << ' ' << mesh.normals[i].y << ' ' << mesh.normals[i].z;
        if (!mesh.uvs.empty()) out << ' ' << mesh.uvs[i].x << ' ' << mesh.uvs[i].y;
        out << '\n';
    }
    for (auto const& t : mesh.triangles)
        out << "3 " << t.v[0] << ' ' << t.v[1] << ' ' << t.v[2] << '\n';
}

} // namespace weft::testing
