// Lamps: what shines from one place with an intensity that depends on the direction. With a radius
// the place is a ball, and every point of it sends the radiance
//
//   L(d) = I(d) / (pi r^2)
//
// along d: the ball shows the area pi r^2 to every side, so that from afar its intensity is I(d),
// and its power is the point's. A surface that sees the whole ball of an isotropic lamp receives
// exactly what the point at its centre would send.
//
// A ball is met by rays, but it is no object: it neither blocks nor scatters light, and the camera
// does not see it (as with the lights of Cycles). From outside its near side is seen, from inside
// its far side. Left out: balls turned into ellipsoids.
#pragma once

#include <optional>
#include <variant>

#include "base/match.h"
#include "lights/emitter_geometry.h"
#include "lights/photometric_light.h"

namespace weft::lights {

/// Each has position, intensity, attenuation(d), sample(ref) and power().
using LuminaireSource = std::variant<PointLight, SpotLight, PhotometricLight>;

/// Balls of a smaller radius are points: their densities would not fit into a float.
inline constexpr float kLeastLampRadius = 1e-9f;

struct Luminaire {
    LuminaireSource source;
    float radius = 0;                  ///< 0: a point
    std::optional<SphereEmitter> ball; ///< where there is a radius

    Vec3 position() const {
        return match(source, [](auto const& s) { return s.position; });
    }
    /// Returns the radiance of the ball along `d`, of any length but 0, away from it.
    Color radiance(Vec3 const& d) const {
        return match(source, [&](auto const& s) { return s.intensity * s.attenuation(d); }) *
               (kInvPi / square(radius));
    }
    Color power() const {
        return match(source, [](auto const& s) { return s.power(); });
    }
};

Luminaire make_luminaire(LuminaireSource source, float radius);

/// Returns the distance from `origin` along unit `direction` to where a ray meets the ball that
/// shines on `from`, a point of the ray's line that light sampling starts from: the near side, or
/// the far one where `from` is inside. `n`: the unit outward normal there. Negative: not met.
double distance_to_ball(Vec3 const& centre, float radius, Vec3 const& origin, Vec3 const& direction,
                        Vec3 const& from, Vec3& n);

/// What an image in front of a spot does with directions: the square around the outer cone, seen
/// from the lamp, is the unit square of uv; v grows towards `up`, u to the right of who looks along
/// the axis.
struct GoboProjection {
    Frame frame;     ///< n: the axis; t: up
    float scale = 1; ///< 1 / (2 tan) of the outer cone's half angle, which is below 90 degrees

    GoboProjection(Vec3 const& axis, Vec3 const& up, float outer_angle);
    /// Returns (u, v) of the direction `d`, at an acute angle to the axis.
    Vec2 uv(Vec3 const& d) const {
        Vec3 const local = frame.to_local(d);
        float const s = scale / local.z;
        return {0.5f + s * local.x, 0.5f + s * local.y};
    }
    /// Returns the direction at uv, of any length.
    Vec3 direction(Vec2 uv) const {
        return frame.to_world({(uv.x - 0.5f) / scale, (uv.y - 0.5f) / scale, 1});
    }
};

/// Returns the frame around unit `n` whose s lies along `towards` as far as can be; along z where
/// that is n's own direction.
Frame lamp_frame(Vec3 const& n, Vec3 const& towards);

} // namespace weft::lights
