// The list of a scene's vectors. It exists once, here: the hash of a scene, its checks and its
// readers walk it, and a vector that stands in no list does not compile.
#pragma once

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace weft::scene {

/// A vector of objects, and the kind of the indices into it.
template <class Kind, class T>
struct ObjectVector {
    std::vector<T> Scene::*member;
};
template <class Kind, class T>
constexpr ObjectVector<Kind, T> objects_of(std::vector<T> Scene::*member) {
    return {member};
}

/// What users describe: each object is of a described type, or a variant of such types.
inline constexpr std::tuple kObjectVectors{
    objects_of<CameraKind>(&Scene::cameras),     objects_of<schema::TextureKind>(&Scene::textures),
    objects_of<MaterialKind>(&Scene::materials), objects_of<LayerKind>(&Scene::layers),
    objects_of<EmissionKind>(&Scene::emissions), objects_of<VolumeKind>(&Scene::volumes),
    objects_of<MediumKind>(&Scene::media),       objects_of<ShapeKind>(&Scene::shapes),
    objects_of<InstanceKind>(&Scene::instances), objects_of<LightKind>(&Scene::lights),
    objects_of<PortalKind>(&Scene::portals),
};

/// What files hold. The objects refer to it by `FileName::resource`.
inline constexpr std::tuple kResourceVectors{&Scene::meshes, &Scene::images, &Scene::photometries,
                                             &Scene::udims};

/// What messages say of objects. It may be shorter than the objects' own vectors, and decides
/// nothing about the picture.
inline constexpr std::tuple kNoteVectors{&Scene::instance_locations, &Scene::light_locations,
                                         &Scene::material_locations, &Scene::texture_locations,
                                         &Scene::instance_names,     &Scene::material_names};

#if !defined(__clang__) || __clang_major__ >= 16
static_assert(schema::detail::member_count<Scene>() ==
                  1 + std::tuple_size_v<decltype(kObjectVectors)> +
                      std::tuple_size_v<decltype(kResourceVectors)> +
                      std::tuple_size_v<decltype(kNoteVectors)>,
              "a member of Scene other than `contents` stands in none of these lists");
#endif

/// Calls f(v) for each element of one of the lists.
template <class List, class F>
constexpr void for_each_vector(List const& list, F&& f) {
    std::apply([&](auto const&... v) { (f(v), ...); }, list);
}

namespace detail {

template <class Kind, class T>
constexpr bool is_of_kind(ObjectVector<Kind, T> const&, Kind const*) {
    return true;
}
template <class V>
constexpr bool is_of_kind(V const&, void const*) {
    return false;
}

/// The position in kObjectVectors of the vector that `Kind` indexes.
template <class Kind, size_t I = 0>
constexpr size_t position_of() {
    if constexpr (is_of_kind(std::get<I>(kObjectVectors), static_cast<Kind const*>(nullptr)))
        return I;
    else
        return position_of<Kind, I + 1>();
}

} // namespace detail

/// The vector that ids of `Kind` are indices into.
template <class Kind, class S>
auto& objects(S& scene) {
    return scene.*std::get<detail::position_of<Kind>()>(kObjectVectors).member;
}

/// Appends an object, where it was written and what it is called, and returns its id.
template <class Kind, class T>
schema::Id<Kind> add(Scene& scene, Kind, T&& object, SourceLocation where = {},
                     SharedText name = {}) {
    auto& list = objects<Kind>(scene);
    size_t const index = list.size();
    list.push_back(std::forward<T>(object));
    [[maybe_unused]] auto const note = [&](auto& notes, auto&& value) {
        notes.resize(index);
        notes.push_back(std::move(value));
    };
    if constexpr (std::is_same_v<Kind, schema::TextureKind>) note(scene.texture_locations, where);
    if constexpr (std::is_same_v<Kind, LightKind>) note(scene.light_locations, where);
    if constexpr (std::is_same_v<Kind, MaterialKind>) {
        note(scene.material_locations, where);
        if (!name.empty()) note(scene.material_names, name);
    }
    if constexpr (std::is_same_v<Kind, InstanceKind>) {
        note(scene.instance_locations, where);
        if (!name.empty()) note(scene.instance_names, name);
    }
    return {int32_t(index)};
}

} // namespace weft::scene
