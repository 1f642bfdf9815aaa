// Light from all around: a map or a sky, sampled as a whole or through its portals.
//
// Where light sampling stands alone, a part of the samples is taken of the whole map even where
// portals are seen, so that light which comes another way is not lost.
//
// Maps are read without a footprint, by rays and by light sampling alike, so both see the same
// light.
#pragma once

#include <variant>

#include "base/affine.h"
#include "lights/environment.h"
#include "lights/light_sample.h"
#include "lights/portal.h"
#include "lights/sky_model.h"
#include "scene/scene.h"
#include "shading/graph.h"

namespace weft::lights {

/// An image or a network of nodes as a map: compiled for directions, a constant included.
struct NetworkMap {
    shading::Program program; ///< needs nothing but uv
    Color tint{1};            ///< a factor on it

    /// Returns the radiance at lat-long coordinates, at least 0.
    Color at(Vec2 uv) const;
};

struct EnvironmentLight {
    static constexpr FoundAs found_as = FoundAs::Background;
    static constexpr bool at_infinity = true;

    std::variant<NetworkMap, SkyTable> map;
    /// Between directions, linear, of determinant 1 or -1: most often rotations. A solid angle in
    /// the map is one in the world times 1 / |to_map(d)|^3, d a unit direction in the world.
    Affine to_world, to_map;
    EnvironmentSampler sampler;
    PortalSampler portals;
    float whole = 0; ///< the part of samples that is not sent through portals where they are seen

    /// Returns the radiance at lat-long coordinates.
    Color radiance(Vec2 uv) const;
    /// Returns the radiance from unit direction `d` in the world.
    Color radiance(Vec3 const& d) const;
    static constexpr bool has_size() { return true; }
    LightSample sample(LightContext const& context, Vec3 const& ref, Vec2 u, uint32_t) const;
    LightSeen seen(LightContext const& context, Vec3 const& ref, Vec3 const& d) const;

  private:
    LightSample sample_whole(Vec2 u) const;
};

} // namespace weft::lights
