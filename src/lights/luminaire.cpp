#include "lights/luminaire.h"

namespace weft::lights {

Luminaire make_luminaire(LuminaireSource source, float radius) {
    Luminaire lamp{std::move(source), 0, std::nullopt};
    if (!(radius >= kLeastLampRadius)) return lamp;
    lamp.radius = radius;
    lamp.ball.emplace(
        Affine({radius, 0, 0}, {0, radius, 0}, {0, 0, radius}, Vec3(lamp.position())));
    return lamp;
}

double distance_to_ball(Vec3 const& centre, float radius, Vec3 const& origin, Vec3 const& direction,
                        Vec3 const& from, Vec3& n) {
    // In double, and by the closest approach, which keeps the digits of far balls.
    Vec3d const to_centre = Vec3d(centre) - Vec3d(origin), d(direction);
    double const r2 = double(radius) * double(radius);
    double const middle = dot(to_centre, d) / length_squared(d);
    Vec3d const off = d * middle - to_centre;
    double const half2 = r2 - length_squared(off);
    if (half2 < 0) return -1;
    bool const inside = length_squared(Vec3d(from) - Vec3d(centre)) <= r2;
    double const half = std::sqrt(half2 / length_squared(d));
    double const step = inside ? half : -half;
    n = Vec3(normalize(off + d * step));
    return middle + step;
}

GoboProjection::GoboProjection(Vec3 const& axis, Vec3 const& up, float outer_angle)
    : scale(0.5f / std::tan(0.5f * outer_angle)) {
    Frame const upright = lamp_frame(axis, up);
    // To the right of who looks along the axis: axis x up.
    frame = Frame(cross(axis, upright.s), upright.s, axis);
}

Frame lamp_frame(Vec3 const& n, Vec3 const& towards) {
    bool const parallel = !(length_squared(cross(n, towards)) > 1e-10f * length_squared(towards));
    return Frame(n, parallel ? Vec3(0, 0, 1) : towards);
}

} // namespace weft::lights
