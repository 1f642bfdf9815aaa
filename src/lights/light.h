// The lights of a stage: what each kind knows of itself, and what all have in common.
#pragma once

#include <optional>
#include <variant>

#include "lights/delta_lights.h"
#include "lights/emitter_geometry.h"
#include "lights/emitter_texture.h"
#include "lights/environment_light.h"
#include "lights/light_rules.h"
#include "lights/luminaire.h"
#include "lights/sun_disk.h"
#include "scene/light_controls.h"
#include "shading/spread.h"
#include "shading/textures.h"

namespace weft::lights {

/// An emissive object, sampled over its surface. One of a mirrored or flat shape emits from the
/// front alone.
struct AreaLight {
    Emitter emitter;
    shading::Emission emission;
    shading::Opacity opacity; ///< rays that look for it miss it where it is not there
    shading::Spread spread;
    std::optional<EmitterTexture> texture; ///< where the emission varies much
    float extent = 0;                      ///< about its size: the root of its area
    uint32_t object = 0;                   ///< of the world
    bool uv_alone = true;                  ///< emission and alpha depend on uv alone
};

/// An image in front of a spot, black outside of its unit square.
struct Gobo {
    GoboProjection projection;
    scene::Input<Color> texture;
};

/// A point or a ball that shines.
struct Lamp {
    Luminaire luminaire;
    std::optional<Gobo> gobo;
};

using LightKind = std::variant<Lamp, DirectionalLight, AreaLight, EnvironmentLight, SunDisk>;

struct Light {
    LightKind kind;
    scene::LightControls controls;
    LightRules rules;
    int32_t source = -1;             ///< of the scene's lights, for messages
    float power = 0;                 ///< luminance of all that it emits
    bool hidden_from_camera = false; ///< a lamp, seen by bounced rays alone
};

/// A point to be lit, as far as the choice of lights goes.
struct LitPoint {
    Vec3 p{0, 0, 0};
    Vec3 n{0, 0, 0};      ///< unit normal; 0 in a medium
    uint32_t choices = 1; ///< up to so many lights at once
};

struct LightSample {
    Vec3 wi{0, 0, 1};
    float distance = 0; ///< infinite for lights at infinity
    Color radiance;     ///< for delta lights: irradiance on a facing surface
    float pdf = 0;      ///< per solid angle, times the chance of the light
    bool delta = false; ///< `pdf` is the chance of the light alone
    float p_error = 0;  ///< how near to the light a shadow ray may go
    int32_t light = -1;
    int32_t object = -1; ///< whose surface it is; -1: none
};

} // namespace weft::lights
