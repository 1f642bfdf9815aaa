// Cameras and lamps of a glTF file, and those that a file without any is given.
#pragma once

#include "io/gltf_json.h"
#include "scene/scene.h"

namespace weft::io::gltf {

/// A camera at a node. glTF's looks along -z with y up, Weft's along +z with y down; scale is
/// left out. Throws InputError for one that sees nothing.
scene::Camera read_camera(Object& camera, Affined const& to_world);

/// A lamp of KHR_lights_punctual at a node, shining along its -z; its intensity, in candela or
/// lux, is divided by 683 lm/W. A spot's falloff is linear in the angle; `range` is left out.
scene::Light read_light(Object& light, Affined const& to_world);

/// A camera that sees all corners of the instances' bounding boxes from the front (+z), a little
/// from the right and from above, its fov 40 degrees. Throws InputError at `where` where there
/// is nothing to see.
scene::Camera frame_all(scene::Scene const& scene, std::vector<scene::InstanceId> const& instances,
                        SourceLocation const& where);

/// Whether the lamps together give the middle of what is there at least the light of a dim room
/// (0.1 W/m^2 or 68 lx, cones and shadows left aside). Many files say "2 lux" and mean nothing
/// by it.
bool light_a_room(scene::Scene const& scene, std::vector<scene::LightId> const& lamps,
                  std::vector<scene::InstanceId> const& instances);

/// A photographer's studio as light from all around: a soft gradient, a large lamp to the upper
/// left of `camera`, and a dim one to the right. A white wall facing the lamp has about radiance
/// 1. Its image and texture are added to the scene.
scene::EnvironmentLight make_studio(scene::Scene& scene, scene::Camera const& camera);

} // namespace weft::io::gltf
