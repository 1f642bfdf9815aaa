// The kinds of lights of a stage, and what all have in common.
#pragma once

#include <variant>

#include "lights/area_light.h"
#include "lights/delta_lights.h"
#include "lights/environment_light.h"
#include "lights/lamp.h"
#include "lights/light_rules.h"
#include "lights/sun_disk.h"
#include "scene/light_controls.h"

namespace weft::lights {

using LightKind = std::variant<Lamp, DirectionalLight, AreaLight, EnvironmentLight, SunDisk>;

/// What rendering seldom asks of a light.
struct LightInfo {
    scene::LightControls controls;
    int32_t source = -1;             ///< of the scene's lights, for messages
    float power = 0;                 ///< luminance of all that it emits
    bool hidden_from_camera = false; ///< a lamp, seen by bounced rays alone
};

} // namespace weft::lights
