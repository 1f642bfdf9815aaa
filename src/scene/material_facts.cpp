#include "scene/material_facts.h"

namespace weft::scene {

namespace {

Material const& material_of(Scene const& scene, MaterialId id) {
    return scene.materials[size_t(id.index)];
}

} // namespace

std::vector<MaterialId> parts_of(Scene const& scene, MaterialId id) {
    return with_traits(material_of(scene, id),
                       [&]<class T>(auto const& m) { return T::parts(m, scene.layers); });
}

std::optional<Input<float>> inner_ior(Scene const& scene, MaterialId id) {
    auto const own =
        with_traits(material_of(scene, id), []<class T>(auto const& m) { return T::inner_ior(m); });
    if (own) return own;
    for (MaterialId part : parts_of(scene, id))
        if (auto const ior = inner_ior(scene, part)) return ior;
    return {};
}

bool is_transmissive(Scene const& scene, MaterialId id) {
    return is_null_boundary(material_of(scene, id)) || inner_ior(scene, id);
}

bool softens_bent_light(Scene const& scene, MaterialId id) {
    return with_traits(material_of(scene, id),
                       []<class T>(auto const&) -> bool { return T::softens_bent_light; });
}

bool passes_straight(Scene const& scene, MaterialId id) {
    if (with_traits(material_of(scene, id),
                    []<class T>(auto const& m) { return T::passes_straight(m); }))
        return true;
    for (MaterialId part : parts_of(scene, id))
        if (passes_straight(scene, part) || may_differ(opacity_of(material_of(scene, part)), 1.f))
            return true;
    return false;
}

} // namespace weft::scene
