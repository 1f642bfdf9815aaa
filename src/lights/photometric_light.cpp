#include "lights/photometric_light.h"

#include <algorithm>
#include <span>

namespace weft::lights {

namespace {

struct Between {
    size_t low; ///< index of the angle below; the one above is the next
    float t;    ///< in [0, 1]
};

/// Where `x` lies among at least two ascending angles that hold it.
Between find(std::span<float const> angles, float x) {
    auto const above = std::upper_bound(angles.begin() + 1, angles.end() - 1, x);
    size_t const low = size_t(above - angles.begin()) - 1;
    return {low, std::clamp((x - angles[low]) / (angles[low + 1] - angles[low]), 0.f, 1.f)};
}

} // namespace

float candela(scene::Photometry const& lamp, float vertical, float horizontal) {
    if (vertical < lamp.vertical.front() || vertical > lamp.vertical.back()) return 0;
    Between const v = find(lamp.vertical, vertical);
    auto along = [&](size_t h) { return lerp(lamp.at(h, v.low), lamp.at(h, v.low + 1), v.t); };
    if (lamp.horizontal.size() == 1) return along(0);
    Between const h = find(lamp.horizontal, horizontal);
    return lerp(along(h.low), along(h.low + 1), h.t);
}

float PhotometricLight::attenuation(Vec3 const& d) const {
    // The frame's t points to 270 degrees: s, t, n are right-handed and n points down.
    Vec3 const local = frame.to_local(d);
    float const vertical = std::atan2(std::sqrt(square(local.x) + square(local.y)), local.z);
    float const horizontal = std::atan2(-local.y, local.x);
    float const turn = horizontal < 0 ? horizontal + 2 * kPi : horizontal;
    return candela(*lamp, std::min(degrees(vertical), 180.f), std::min(degrees(turn), 360.f));
}

double luminous_flux(scene::Photometry const& lamp) {
    size_t const planes = lamp.horizontal.size();
    // The weight of a plane: half the angles to its neighbours, in degrees.
    auto width = [&](size_t h) {
        if (planes == 1) return 360.0;
        double const before = double(lamp.horizontal[h > 0 ? h - 1 : h]);
        double const after = double(lamp.horizontal[h + 1 < planes ? h + 1 : h]);
        return 0.5 * (after - before);
    };
    double const to_radians = double(kPi) / 180;
    double sum = 0;
    for (size_t h = 0; h < planes; ++h)
        for (size_t v = 0; v + 1 < lamp.vertical.size(); ++v) {
            // The integral of (i0 + slope (x - a)) sin x from a to b.
            double const a = double(lamp.vertical[v]) * to_radians,
                         b = double(lamp.vertical[v + 1]) * to_radians;
            double const i0 = double(lamp.at(h, v)), i1 = double(lamp.at(h, v + 1));
            double const slope = (i1 - i0) / (b - a);
            double const ring = i0 * (std::cos(a) - std::cos(b)) +
                                slope * (std::sin(b) - std::sin(a) - (b - a) * std::cos(b));
            sum += ring * width(h) * to_radians;
        }
    return sum;
}

} // namespace weft::lights
