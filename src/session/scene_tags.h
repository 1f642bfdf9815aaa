// What the things of a scene are called in the film: light groups, Cryptomatte ids.
#pragma once

#include "film/sample_record.h"
#include "lights/stage.h"

namespace weft::session {

/// Objects are called by the id of their instance, behind that of the outermost instance where it
/// is a member of a group ("robot/arm"); materials by theirs, or else by their type and place in
/// the file ("diffuse_3"); assets by the outermost instance's.
film::SceneTags scene_tags(lights::Stage const& stage);
std::string object_name(world::World const& world, uint32_t object);
/// "" where it has no material.
std::string material_name(world::World const& world, uint32_t object);

} // namespace weft::session
