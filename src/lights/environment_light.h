// Light from all around: a map or a sky, sampled as a whole or through its portals.
//
// Where light sampling stands alone, a part of the samples is taken of the whole map even where
// portals are seen, so that light which comes another way is not lost.
#pragma once

#include <variant>

#include "base/affine.h"
#include "lights/environment.h"
#include "lights/portal.h"
#include "lights/sky_model.h"
#include "scene/scene.h"
#include "shading/textures.h"

namespace weft::lights {

struct EnvironmentLight {
    struct Sample {
        Vec3 direction{0, 0, 1}; ///< unit, in the world
        Color radiance;
        float pdf = 0; ///< per solid angle
    };

    std::variant<scene::Input<Color>, SkyTable> map;
    /// Between directions, linear, of determinant 1 or -1: most often rotations. A solid angle in
    /// the map is one in the world times 1 / |to_map(d)|^3, d a unit direction in the world.
    Affine to_world, to_map;
    EnvironmentSampler sampler;
    PortalSampler portals;
    float whole = 0; ///< the part of samples that is not sent through portals where they are seen
    Color tint{1};   ///< a factor on an input

    /// At lat-long coordinates.
    Color radiance(shading::Textures const& textures, Vec2 uv) const;
    /// From unit direction `d` in the world.
    Color radiance(shading::Textures const& textures, Vec3 const& d) const;
    /// To illuminate `ref`.
    Sample sample(shading::Textures const& textures, Vec3 const& ref, Vec2 u) const;
    /// What a ray from `ref` along unit `d` finds, and the density with which `sample` does.
    Sample found(shading::Textures const& textures, Vec3 const& ref, Vec3 const& d) const;

  private:
    Sample sample_whole(shading::Textures const& textures, Vec2 u) const;
};

} // namespace weft::lights
