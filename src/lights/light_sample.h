// What lights are asked, and what they answer.
//
// Every kind of light states, with no default,
//   found_as        how rays find it
//   at_infinity     whether its light comes from a direction, not from a place
//   has_size()      whether rays can meet it at all
//   sample(context, ref, u, part)
//                   a LightSample at `ref` by u in [0, 1)^2: of its part `part`, where it has
//                   several; `pdf` is that of the light alone, 0 where nothing was sampled
// and, where its light comes from a place,
//   places()        a few points at or just off it
// and, where it is found in the background,
//   seen(context, ref, d)
//                   what a ray from `ref` along unit `d` sees of it
#pragma once

#include <cstdint>

#include "base/color.h"

namespace weft::world {
class World;
}
namespace weft::shading {
class Textures;
}

namespace weft::lights {

/// How rays find a kind of light.
enum class FoundAs : uint8_t {
    Nothing,    ///< no ray meets it
    Object,     ///< as an object of the world
    Lamp,       ///< as a ball that is no object, where it has a size
    Background, ///< by leaving the scene
};

/// What lights look things up in.
struct LightContext {
    world::World const& world;         ///< has the objects that are lights
    shading::Textures const& textures; ///< of gobos
};

/// A point to be lit, as far as the choice of lights goes.
struct LitPoint {
    Vec3 p{0, 0, 0};
    Vec3 n{0, 0, 0};      ///< unit normal; 0 in a medium
    uint32_t choices = 1; ///< up to so many lights at once
};

struct LightSample {
    Vec3 wi{0, 0, 1};   ///< unit, towards the light
    float distance = 0; ///< infinite for lights at infinity
    Color radiance;     ///< for delta lights: irradiance on a facing surface, unoccluded
    float pdf = 0;      ///< per solid angle, times the chance of the light; 0: nothing was sampled
    bool delta = false; ///< `pdf` is the chance of the light alone
    float p_error = 0;  ///< how near to the light a shadow ray may go
    int32_t light = -1;
    int32_t object = -1; ///< whose surface it is; -1: none
};

/// What a ray that leaves the scene sees of a light.
struct LightSeen {
    Color radiance;
    float pdf = 0; ///< per solid angle, with which `sample` gives the ray's direction
};

} // namespace weft::lights
