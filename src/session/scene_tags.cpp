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

/// Names the groups of lights, and of objects that emit without being lights.
void add_light_groups(lights::Stage const& stage, film::SceneTags& tags) {
    world::World const& world = stage.world();
    lights::LightTable const& lights = stage.lights();
    for (size_t i = 0; i < lights.size(); ++i)
        tags.group_of_light.push_back(
            group_index(tags.light_groups, lights.info(int32_t(i)).controls.group));
    for (world::Model const& model : world.models())
        group_index(tags.light_groups, model.traits.group);
    for (world::AreaObject const& area : world.area_objects()) {
        int32_t const light = lights.of_object(area.object);
        if (lights.info(light).controls.group.empty())
            tags.group_of_light[size_t(light)] =
                group_index(tags.light_groups, world.model(area.object).traits.group);
    }
    if (tags.light_groups.size() > UINT16_MAX)
        throw InputError("expected at most 65535 light groups");
}

std::string instance_name(scene::Scene const& scene, int32_t instance) {
    std::string const name(name_of(scene, scene::InstanceId{instance}));
    return name.empty() ? "instance_" + std::to_string(instance) : name;
}

} // namespace

std::string object_name(world::World const& world, uint32_t object) {
    scene::Scene const& scene = world.scene();
    int32_t const own = world.object(object).source_instance, root = world.root_instance(object);
    if (own == root) return instance_name(scene, root);
    return instance_name(scene, root) + "/" + instance_name(scene, own);
}

std::string material_name(world::World const& world, uint32_t object) {
    scene::Scene const& scene = world.scene();
    scene::MaterialId const bsdf = world.model(object).traits.bsdf;
    if (!bsdf) return "";
    size_t const index = size_t(bsdf.index);
    if (auto const name = name_of(scene, bsdf); !name.empty()) return std::string(name);
    return std::string(match(scene.materials[index], [](auto const& m) { return m.info.type; })) +
           "_" + std::to_string(index);
}

film::SceneTags scene_tags(lights::Stage const& stage, std::span<film::Aov const> aovs) {
    world::World const& world = stage.world();
    auto const wanted = [&](film::Aov aov) {
        return std::find(aovs.begin(), aovs.end(), aov) != aovs.end();
    };
    film::SceneTags tags;
    add_light_groups(stage, tags);
    tags.layers = world.layer_labels();
    uint32_t const objects = uint32_t(world.object_count());
    if (wanted(film::Aov::light_groups))
        for (uint32_t i = 0; i < objects; ++i)
            tags.group_of_object.push_back(
                group_index(tags.light_groups, world.model(i).traits.group));
    auto const add_ids = [&](film::Aov aov, auto const& name_of_object) {
        if (!wanted(aov)) return;
        film::SceneTags::Cryptomatte& matte = tags.cryptomattes[film::cryptomatte_index(aov)];
        for (uint32_t i = 0; i < objects; ++i) {
            std::string const name = name_of_object(i);
            uint32_t const id = name.empty() ? 0 : film::cryptomatte_id(name);
            matte.id_of_object.push_back(id);
            if (id != 0) matte.manifest[name] = id;
        }
    };
    add_ids(film::Aov::crypto_object, [&](uint32_t i) { return object_name(world, i); });
    add_ids(film::Aov::crypto_material, [&](uint32_t i) { return material_name(world, i); });
    add_ids(film::Aov::crypto_asset,
            [&](uint32_t i) { return instance_name(world.scene(), world.root_instance(i)); });
    return tags;
}

} // namespace weft::session
