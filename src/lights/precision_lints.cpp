// The part of the lints that is about coordinates too large for single precision.
#include <fmt/format.h>
#include <set>

#include "base/match.h"
#include "lights/lints.h"
#include "scene/camera_relative.h"

namespace weft::lights {

namespace {

/// Returns by how much neighbouring numbers of single precision differ at `x`.
double step_at(double x) { return std::abs(x) * 0x1p-23; }

/// Returns what is wrong with a mesh whose vertices are far from their origin; "" if nothing.
std::string complaint(scene::Mesh const& mesh) {
    if (mesh.positions.empty()) return "";
    Vec3 low = mesh.positions[0], high = low;
    for (Vec3 const& p : mesh.positions) {
        low = min(low, p);
        high = max(high, p);
    }
    double const largest = double(max_component(max(abs(low), abs(high)))),
                 size = double(max_component(high - low));
    if (!(largest >= scene::kFarAway && step_at(largest) > 1e-4 * size)) return "";
    return fmt::format("its vertices, {:.4g} from the origin of the mesh, have steps of {:.2g} in "
                       "single precision, and its shape suffers: centre the mesh, and let the "
                       "instance's transform, which is in double precision, take it there",
                       largest, step_at(largest));
}

} // namespace

std::vector<std::string> precision_warnings(world::World const& world) {
    scene::Scene const& scene = world.scene();
    std::vector<std::string> warnings;
    auto const warn = [&](SourceLocation const& where, std::string const& text) {
        if (!text.empty()) warnings.push_back(to_string(where) + ": " + text);
    };
    std::set<int32_t> seen; // meshes
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        auto const* mesh =
            std::get_if<scene::MeshShape>(&scene.shapes[size_t(scene.instances[i].shape.index)]);
        if (!mesh || !seen.insert(mesh->filename.resource).second) continue;
        warn(location_of(scene, scene::InstanceId{int32_t(i)}),
             complaint(*scene.meshes[size_t(mesh->filename.resource)]));
    }
    for (scene::LightId id : scene.contents.lights)
        match(scene.lights[size_t(id.index)], [&](auto const& light) {
            if constexpr (requires { light.position; }) {
                Vec3d const at = Vec3d(light.position) + world.origin();
                double const step = step_at(max_component(abs(at)));
                if (step > 1e-4 * double(length(light.position - world.camera().position())))
                    warn(location_of(scene, id),
                         fmt::format("its position is in single precision, whose steps are {:.2g} "
                                     "there; an area light stands where its transform says, in "
                                     "double precision",
                                     step));
            }
        });
    return warnings;
}

} // namespace weft::lights
