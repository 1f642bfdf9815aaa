// The part of WorldBuilder that says what objects look like: from the traits of instances to
// models, and the networks of nodes that these show.
#include <algorithm>

#include "scene/material_facts.h"
#include "world/world_builder.h"

namespace weft::world {

Model WorldBuilder::make_model(Placed const& placed, scene::InstanceTraits const& traits,
                               int32_t instance) {
    Model model;
    model.geometry = placed.geometry;
    model.instanced = placed.instanced;
    model.in_world_space = placed.in_world_space;
    model.traits = traits;
    model.sets =
        world_.sets_.declare(traits.sets, location_of(scene_, scene::InstanceId{instance}));
    model.medium = medium_of(traits);
    if (traits.emission) {
        auto const& emission = scene_.emissions[size_t(traits.emission.index)];
        model.emission.color = emission.emission;
        model.emission.tint = scene::scale_of(emission.color, emission.unit);
    }
    model.opacity.instance = traits.alpha;
    if (traits.bsdf) {
        auto const& material = scene_.materials[size_t(traits.bsdf.index)];
        model.is_null = scene::is_null_boundary(material);
        model.has_interior = scene::is_transmissive(scene_, traits.bsdf);
        model.is_see_through = !model.has_interior && scene::passes_straight(scene_, traits.bsdf);
        model.softens_bent_light = scene::softens_bent_light(scene_, traits.bsdf);
        model.opacity.material = scene::opacity_of(material);
        if (auto const own = scene::emission_of(material); own && !traits.emission)
            model.emission = {own->color, own->strength};
    }
    model.has_alpha = model.opacity != shading::Opacity{};
    // A medium without a surface material is bounded by nothing, and nothing does not shine.
    if (!traits.bsdf && !traits.emission && model.medium >= 0)
        model.is_null = model.has_interior = true;
    if (model.is_null) model.emission = {};
    return model;
}

int32_t WorldBuilder::add_medium(media::Medium const& medium) {
    world_.media_.push_back(medium);
    world_.has_media_ = true;
    return int32_t(world_.media_.size()) - 1;
}

int32_t WorldBuilder::medium_of(scene::InstanceTraits const& given) {
    if (given.medium) {
        auto const& m = scene_.media[size_t(given.medium.index)];
        return add_medium({m.absorption, m.scatter, m.phase});
    }
    if (!given.bsdf) return -1;
    auto const* v = std::get_if<scene::VolumeBoundary>(&scene_.materials[size_t(given.bsdf.index)]);
    if (!v) return -1;
    float const density = given.volume ? scene_.volumes[size_t(given.volume.index)].value : 1;
    // What a scattering event takes away by its colour is absorbed.
    Color const scattering = density * v->scatter * v->base_color;
    return add_medium({density * (v->absorption + v->scatter) - scattering, scattering, v->phase});
}

/// Compiles programs for all that models show: what nothing uses is not compiled.
void WorldBuilder::compile_networks() {
    world_.textures_ = shading::Textures(scene_.textures.size());
    world_.materials_ = shading::Materials(scene_);
    for (size_t i = 0; i < world_.models_.size(); ++i) {
        Model& m = world_.models_[i];
        SourceLocation const where = location_of(scene_, scene::InstanceId{first_instance_[i]});
        auto look = [&](shading::Needs needs) {
            m.needs_object_space |= !within(needs, shading::Needs::uv | shading::Needs::view);
        };
        auto prepare = [&](scene::TextureId id) {
            world_.textures_.prepare(compiler_, id, where);
            look(world_.textures_.needs(id));
        };
        prepare(m.opacity.instance.texture);
        prepare(m.opacity.material.texture);
        prepare(m.traits.normal);
        prepare(m.emission.color.texture);
        prepare(m.emission.strength.texture);
        m.needs_tangents = m.needs_object_space || m.traits.normal;
        scene::MaterialId const bsdf = m.traits.bsdf;
        if (!bsdf) continue;
        m.ior = scene::inner_ior(scene_, bsdf).value_or(scene::Input<float>{1});
        prepare(m.ior.texture);
        world_.materials_.compile(scene_, bsdf, compiler_);
        look(world_.materials_.needs(bsdf));
        m.needs_tangents |= m.needs_object_space || world_.materials_.uses_tangents(bsdf);
    }
}

/// Finds the meshes' properties that programs read. One that no mesh has is a mistake.
void WorldBuilder::attach_attributes() {
    for (auto const& [name, node] : compiler_.attributes()) {
        bool found = false;
        std::vector<std::string> known;
        for (auto const& data : meshes_) {
            scene::Mesh const& mesh = *data->source;
            shading::VertexAttributes::Column column;
            if (!mesh.colors.empty()) {
                known.emplace_back("color");
                if (name == "color") column = {&mesh.colors[0].r, 3};
            }
            for (scene::VertexAttribute const& a : mesh.attributes) {
                known.push_back(a.name);
                if (a.name == name) column = {a.values.data(), a.components};
            }
            found |= column.values != nullptr;
            data->attributes.mesh = &mesh;
            data->attributes.columns.push_back(column);
        }
        if (found) continue;
        std::sort(known.begin(), known.end());
        known.erase(std::unique(known.begin(), known.end()), known.end());
        throw InputError(location_of(scene_, node),
                         "expected a vertex property of some mesh, found '" + name + "'" +
                             (known.empty() ? ": no mesh has any" : suggestion(name, known)));
    }
}

} // namespace weft::world
