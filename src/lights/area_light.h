// Emissive objects as lights.
#pragma once

#include <optional>
#include <vector>

#include "base/match.h"
#include "lights/emitter_geometry.h"
#include "lights/emitter_texture.h"
#include "lights/light_sample.h"
#include "shading/spread.h"
#include "shading/textures.h"

namespace weft::lights {

/// An emissive object, sampled over its surface. One of a mirrored or flat shape emits from the
/// front alone.
struct AreaLight {
    static constexpr FoundAs found_as = FoundAs::Object;
    static constexpr bool at_infinity = false;

    Emitter emitter;
    shading::Emission emission;
    shading::Opacity opacity; ///< rays that look for it miss it where it is not there
    shading::Spread spread;
    std::optional<EmitterTexture> texture; ///< where the emission varies much
    float extent = 0;                      ///< about its size: the root of its area
    uint32_t object = 0;                   ///< of the world
    bool uv_alone = true;                  ///< emission and alpha depend on uv alone

    static constexpr bool has_size() { return true; }
    /// Returns how many parts are sampled each for itself: triangles, or 1.
    uint32_t parts() const {
        return match(emitter, [](auto const& e) { return e.primitives(); });
    }
    /// Returns a few points just off its surface.
    std::vector<Vec3> places() const;
    LightSample sample(LightContext const& context, Vec3 const& ref, Vec2 u, uint32_t part) const;
    /// Returns the density per solid angle with which `sample` gives `point` of the part `part`.
    float pdf(Vec3 const& ref, shading::SurfacePoint const& point, uint32_t part) const;
};

} // namespace weft::lights
