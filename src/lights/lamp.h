// A point or a ball that shines, through an image or not.
#pragma once

#include <vector>

#include "lights/light_sample.h"
#include "lights/luminaire.h"
#include "shading/textures.h"

namespace weft::lights {

/// An image in front of a spot, black outside of its unit square.
struct Gobo {
    GoboProjection projection;
    scene::Input<Color> texture;
};

struct Lamp {
    static constexpr FoundAs found_as = FoundAs::Lamp;
    static constexpr bool at_infinity = false;

    Luminaire luminaire;
    std::optional<Gobo> gobo;

    bool has_size() const { return luminaire.ball.has_value(); }
    std::vector<Vec3> places() const { return {luminaire.position()}; }
    LightSample sample(LightContext const& context, Vec3 const& ref, Vec2 u, uint32_t part) const;
    /// Returns the radiance of its ball along `d`, of any length but 0, away from it.
    Color radiance(LightContext const& context, Vec3 const& d) const;
    /// Returns the density per solid angle with which `sample` gives `p`, a point of its ball with
    /// the unit outward normal `n`.
    float pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n) const {
        return luminaire.ball->pdf(ref, p, n);
    }

  private:
    /// Returns what the image lets through along `d`, away from the lamp.
    Color passed(LightContext const& context, Vec3 const& d) const;
};

} // namespace weft::lights
