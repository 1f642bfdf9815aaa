// What is known of a kind of material beside its parameters.
//
// Each material specialises MaterialTraits beside its struct. There is no default: what is left out
// does not compile. Facts that many materials share stand in the structs below, and a material
// inherits those that are true of it. All are about the material itself, not about its parts.
#pragma once

#include <climits>
#include <concepts>
#include <optional>
#include <string>
#include <vector>

#include "scene/handles.h"

namespace weft::scene {

struct Layer;

/// The light that a material sends out from its front: colour times strength, W/(m^2 sr).
struct MaterialEmission {
    Input<Color> color;
    Input<float> strength;
};

/// How many other materials one is made of.
struct PartCount {
    int least, most;
};

/// The facts about the material M; see `KnownMaterial` for which.
template <class M>
struct MaterialTraits;

/// Returns whether an input may be something else than `value`.
template <class T>
bool may_differ(Input<T> const& in, T const& value) {
    return in.texture || in.value != value;
}

/// A surface, which others can be made of.
struct IsSurface {
    static constexpr bool is_null_boundary = false; ///< rays pass it as if it were not there
    static constexpr bool can_be_part = true;       ///< of another material
};

/// No light gets through.
struct IsOpaque {
    /// The index of refraction behind the surface, if light is refracted there.
    static std::optional<Input<float>> inner_ior(auto const&) { return {}; }
    /// Returns whether light may go through without a bend.
    static bool passes_straight(auto const&) { return false; }
};

/// All of it is there, and it does not shine.
struct IsWholeAndDark {
    /// Returns how much of the material is there, 0 to 1.
    static Input<float> opacity(auto const&) { return {1}; }
    /// Nothing for a material that cannot emit.
    static std::optional<MaterialEmission> emission(auto const&) { return {}; }
};

/// It looks the same however its uvs are turned.
struct IsIsotropic {
    /// Returns whether lobes need to know the direction in which u grows.
    static bool needs_tangents(auto const&) { return false; }
};

/// Light that a bent normal sends to the wrong side is lost, and nothing else changes, as in
/// lightwave.
struct DropsBentLight {
    static constexpr bool softens_bent_light = false;
};
/// Light that a bent normal sends to the wrong side is lost, and the borders of that are soft.
struct SoftensBentLight {
    static constexpr bool softens_bent_light = true;
};

/// It is made of no other materials.
struct HasNoParts {
    static constexpr PartCount part_count{0, 0};
    /// The materials that it is made of, in the order of the file. `layers`: all of the scene's.
    static std::vector<MaterialId> parts(auto const&, std::vector<Layer> const&) { return {}; }
    /// Names for the AOV `layers`, in the order in which `LobeBuilder` asks for them; "": none.
    static std::vector<std::string> labels(auto const&, std::vector<Layer> const&) { return {}; }
};

/// A material whose facts are complete.
template <class M>
concept KnownMaterial = requires(M const& m, std::vector<Layer> const& layers) {
    {bool(MaterialTraits<M>::is_null_boundary)};
    {bool(MaterialTraits<M>::can_be_part)};
    {bool(MaterialTraits<M>::softens_bent_light)};
    { MaterialTraits<M>::inner_ior(m) } -> std::same_as<std::optional<Input<float>>>;
    { MaterialTraits<M>::passes_straight(m) } -> std::same_as<bool>;
    { MaterialTraits<M>::opacity(m) } -> std::same_as<Input<float>>;
    { MaterialTraits<M>::emission(m) } -> std::same_as<std::optional<MaterialEmission>>;
    { MaterialTraits<M>::needs_tangents(m) } -> std::same_as<bool>;
    {PartCount(MaterialTraits<M>::part_count)};
    { MaterialTraits<M>::parts(m, layers) } -> std::same_as<std::vector<MaterialId>>;
    { MaterialTraits<M>::labels(m, layers) } -> std::same_as<std::vector<std::string>>;
};

} // namespace weft::scene
