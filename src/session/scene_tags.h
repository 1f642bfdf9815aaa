// What the things of a scene are called in the film: light groups, Cryptomatte ids.
#pragma once

#include "film/sample_record.h"
#include "lights/stage.h"

namespace weft::session {

/// Returns the names of light groups and layers, and of objects what `aovs` need: their groups for
/// `light_groups`, their ids for Cryptomattes. An asset is called by the id of its outermost
/// instance.
film::SceneTags scene_tags(lights::Stage const& stage, std::span<film::Aov const> aovs = {});
/// Returns the id of an object's instance; of a member of a group, after that of the outermost
/// instance and a slash ("robot/arm").
std::string object_name(world::World const& world, uint32_t object);
/// Returns the id of an object's material, or else its type and place in the file ("diffuse_3"); ""
/// where the object has no material.
std::string material_name(world::World const& world, uint32_t object);

} // namespace weft::session
