#include "scene/camera_relative.h"

#include <cmath>
#include <map>
#include <set>

#include "base/match.h"

namespace weft::scene {

namespace {

Vec3d camera_position(Scene const& scene) {
    return match(scene.cameras[size_t(scene.contents.camera.index)],
                 [](auto const& c) { return c.view.transform.origin; });
}

/// Returns a point of an instance.
Vec3d place_of(Scene const& scene, Instance const& instance) {
    auto const* mesh = std::get_if<MeshShape>(&scene.shapes[size_t(instance.shape.index)]);
    Vec3d first(0, 0, 0);
    if (mesh && !scene.meshes[size_t(mesh->filename.resource)]->positions.empty())
        first = Vec3d(scene.meshes[size_t(mesh->filename.resource)]->positions[0]);
    return instance.transform.point(first);
}

/// Returns whether most instances are far nearer to the camera than to the origin.
bool is_around(Scene const& scene, Vec3d const& camera) {
    size_t near = 0;
    for (InstanceId id : scene.contents.instances) {
        Vec3d const p = place_of(scene, scene.instances[size_t(id.index)]);
        near += 4 * length(p - camera) < length(p);
    }
    return 2 * near > scene.contents.instances.size();
}

/// To multiples of 16, so that what lies on a grid stays on one, and a camera that moves a little
/// leaves the origin where it is.
Vec3d rounded(Vec3d const& p) {
    auto const round = [](double x) { return 16 * std::round(x / 16); };
    return {round(p.x), round(p.y), round(p.z)};
}

/// Gives an instance that also stands in a group a twin there, which is not moved.
void part_from_groups(Scene& scene, std::set<int32_t> const& roots) {
    std::map<int32_t, int32_t> twins;
    for (Shape& shape : scene.shapes) {
        auto* const group = std::get_if<Group>(&shape);
        if (!group) continue;
        for (InstanceId& member : group->instances) {
            if (!roots.contains(member.index)) continue;
            auto const [twin, fresh] = twins.emplace(member.index, int32_t(scene.instances.size()));
            if (fresh) {
                SourceLocation const where = location_of(scene, member);
                std::string const name(name_of(scene, member));
                scene.instances.push_back(Instance(scene.instances[size_t(member.index)]));
                scene.instance_locations.resize(scene.instances.size());
                scene.instance_locations.back() = where;
                scene.instance_names.resize(scene.instances.size());
                scene.instance_names.back() = name;
            }
            member.index = twin->second;
        }
    }
}

} // namespace

PlacedScene camera_relative(std::shared_ptr<Scene const> scene) {
    Vec3d const camera = camera_position(*scene);
    if (!(length(camera) >= kFarAway) || !is_around(*scene, camera)) return {std::move(scene)};
    Vec3d const origin = rounded(camera);
    auto moved = std::make_shared<Scene>(*scene);
    auto const move = [&](Affined& transform) { transform.origin -= origin; };
    match(moved->cameras[size_t(moved->contents.camera.index)],
          [&](auto& c) { move(c.view.transform); });
    std::set<int32_t> roots;
    for (InstanceId id : moved->contents.instances) roots.insert(id.index);
    for (LightId id : moved->contents.lights)
        match(moved->lights[size_t(id.index)], [&]<class L>(L& light) {
            if constexpr (std::is_same_v<L, AreaLight>) roots.insert(light.instance.index);
            if constexpr (requires { light.position; })
                light.position = Vec3(Vec3d(light.position) - origin);
        });
    part_from_groups(*moved, roots);
    for (int32_t root : roots) move(moved->instances[size_t(root)].transform);
    for (Portal& portal : moved->portals) move(portal.transform);
    return {std::move(moved), origin};
}

} // namespace weft::scene
