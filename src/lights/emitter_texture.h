// Sampling an emitter where it is bright: a screen, a window, a light with a pattern.
//
// Cells of the uv square are chosen in proportion to the light that leaves them, and a point
// uniformly in uv inside of one. That is right from afar, and bad nearby, where the solid angle
// decides: half of the samples are taken each way, and the density is the mean of both, so the
// variance is at most twice that of the better one, and all light has a chance whatever the cells
// say of it.
#pragma once

#include "base/distribution.h"
#include "lights/emitter_geometry.h"

namespace weft::lights {

class EmitterTexture {
  public:
    /// `flux`: the light that leaves each cell, row by row from v = 0.
    EmitterTexture(std::span<float const> flux, uint32_t width, uint32_t height)
        : cells_(flux, width, height) {}

    template <class E>
    EmitterSample sample(E const& emitter, Vec3 const& ref, Vec2 u) const {
        bool const by_cells = u.x < 0.5f;
        u.x = by_cells ? 2 * u.x : 2 * u.x - 1;
        EmitterSample s =
            by_cells ? emitter.at_uv(ref, cells_.sample(u).p) : emitter.sample(ref, u);
        if (s.distance > 0) s.pdf = pdf(emitter, ref, s.p, s.n, s.uv);
        return s;
    }
    /// p, n, uv: of a point on the emitter.
    template <class E>
    float pdf(E const& emitter, Vec3 const& ref, Vec3 const& p, Vec3 const& n, Vec2 uv) const {
        Vec3 const d = p - ref;
        float const d2 = length_squared(d);
        float const cosine_by = std::abs(dot(n, d)) * emitter.area_by_uv(uv); // times distance
        float const by_cells = cosine_by > 0 ? cells_.pdf(uv) * d2 * std::sqrt(d2) / cosine_by : 0;
        return 0.5f * (by_cells + emitter.pdf(ref, p, n));
    }

  private:
    Distribution2D cells_;
};

} // namespace weft::lights
