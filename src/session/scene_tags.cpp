#include "session/scene_tags.h"

#include <algorithm>

#include "film/cryptomatte.h"

namespace weft::session {

namespace {

uint16_t group_index(std::vector<std::string>& groups, std::string const& name) {
    if (name.empty()) return 0;
    auto const at = std::find(groups.begin(), groups.end(), name);
    if (at != groups.end()) return uint16_t(at - groups.begin());
    groups.push_back(name);
    return uint16_t(groups.size() - 1);
}

void add_light_groups(lights::Stage const& stage, film::SceneTags& tags) {
    world::World const& world = stage.world();
    lights::LightTable const& lights = stage.lights();
    auto& groups = tags.light_groups;
    auto const of_object = [&](world::Object const& o) -> uint16_t {
        if (o.group_instance < 0) return 0;
        return group_index(groups, world.scene().instances[size_t(o.group_instance)].group);
    };
    for (size_t i = 0; i < lights.size(); ++i)
        tags.group_of_light.push_back(group_index(groups, lights[int32_t(i)].controls.group));
    for (uint32_t i = 0; i < world.statistics().objects; ++i) {
        world::Object const& o = world.object(i);
        tags.group_of_object.push_back(of_object(o));
        int32_t const light = lights.of_object(i);
        if (light >= 0 && lights[light].controls.group.empty())
            tags.group_of_light[size_t(light)] = tags.group_of_object.back();
    }
    if (groups.size() > UINT16_MAX) throw InputError("expected at most 65535 light groups");
}

std::string instance_name(scene::Scene const& scene, int32_t instance) {
    std::string const name(name_of(scene, scene::InstanceId{instance}));
    return name.empty() ? "instance_" + std::to_string(instance) : name;
}

} // namespace

std::string object_name(world::World const& world, uint32_t object) {
    scene::Scene const& scene = world.scene();
    world::Object const& o = world.object(object);
    if (o.source_instance == o.root_instance) return instance_name(scene, o.root_instance);
    return instance_name(scene, o.root_instance) + "/" + instance_name(scene, o.source_instance);
}

std::string material_name(world::World const& world, uint32_t object) {
    scene::Scene const& scene = world.scene();
    world::Object const& o = world.object(object);
    if (!o.material) return "";
    size_t const index = size_t(o.material.index);
    if (auto const name = name_of(scene, o.material); !name.empty()) return std::string(name);
    return std::string(match(scene.materials[index], [](auto const& m) { return m.info.type; })) +
           "_" + std::to_string(index);
}

film::SceneTags scene_tags(lights::Stage const& stage) {
    world::World const& world = stage.world();
    film::SceneTags tags;
    add_light_groups(stage, tags);
    tags.layers = world.layer_labels();
    scene::Scene const& scene = world.scene();
    for (uint32_t i = 0; i < world.statistics().objects; ++i) {
        world::Object const& o = world.object(i);
        std::pair<film::Aov, std::string> const names[]{
            {film::Aov::crypto_object, object_name(world, i)},
            {film::Aov::crypto_material, material_name(world, i)},
            {film::Aov::crypto_asset, instance_name(scene, o.root_instance)}};
        static_assert(std::size(names) == film::kCryptomattes);
        for (auto const& [aov, name] : names) {
            film::SceneTags::Cryptomatte& matte = tags.cryptomattes[film::cryptomatte_index(aov)];
            uint32_t const id = name.empty() ? 0 : film::cryptomatte_id(name);
            matte.id_of_object.push_back(id);
            if (id != 0) matte.manifest[name] = id;
        }
    }
    return tags;
}

} // namespace weft::session
