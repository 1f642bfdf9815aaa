// What happened along one path, event by event, for whoever wants to know why a sample is what it
// is. Only `weft replay` keeps one.
#pragma once

#include <vector>

#include "base/color.h"
#include "base/vec.h"
#include "film/path_signature.h"

namespace weft::film {

struct PathEvent {
    enum class Kind : uint8_t { Camera, Surface, Medium, Bounce, Straight, Background, Light };
    Kind kind = Kind::Camera;
    Vec3 p{0, 0, 0};         ///< Camera, Surface, Medium: where
    Vec3 direction{0, 0, 0}; ///< Camera, Bounce, Straight, Background: of the ray; Surface: normal
    Color value; ///< Bounce, Straight: factor of the throughput; Light: what the sample gains; all
                 ///< else: the throughput on arrival
    float pdf = 0; ///< Bounce: per solid angle, or a probability where `is_delta(scattering.kind)`
    bool sampled = false;  ///< Light: found by sampling lights, rather than by a ray
    Scattering scattering; ///< Bounce
    int32_t object = -1;   ///< Surface, and Light of an object
    int32_t light = -1;    ///< Light
    uint32_t bounces = 0;  ///< Light: between the light and the camera
};

using PathLog = std::vector<PathEvent>;

} // namespace weft::film
