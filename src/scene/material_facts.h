// Facts about a material of a scene and all that it is made of.
#pragma once

#include "scene/scene.h"

namespace weft::scene {

/// The materials that it is made of; none for most.
std::vector<MaterialId> parts_of(Scene const& scene, MaterialId id);

/// The index of refraction behind the surface, if light is refracted there: of the first part that
/// does so.
std::optional<Input<float>> inner_ior(Scene const& scene, MaterialId id);

/// Returns whether light goes through into the object's inside.
bool is_transmissive(Scene const& scene, MaterialId id);

/// Returns whether what a bent normal loses has soft borders.
bool softens_bent_light(Scene const& scene, MaterialId id);

/// Whether light may go straight through the material or parts of it. The opacity of the whole is
/// left to the object.
bool passes_straight(Scene const& scene, MaterialId id);

} // namespace weft::scene
