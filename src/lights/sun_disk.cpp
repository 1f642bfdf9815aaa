#include "lights/sun_disk.h"

namespace weft::lights {

namespace {

/// mu^alpha, where mu^2 = 1 - x.
float darkening(float one_minus_x, float alpha) {
    return alpha > 0 ? std::pow(one_minus_x, 0.5f * alpha) : 1;
}
Color darkening(float one_minus_x, Color const& alpha) {
    return {darkening(one_minus_x, alpha.r), darkening(one_minus_x, alpha.g),
            darkening(one_minus_x, alpha.b)};
}

/// The exponent of 1 - x that directions are sampled by.
float sampled_exponent(SunDisk const& sun) {
    return 0.5f * std::min({sun.limb.r, sun.limb.g, sun.limb.b});
}

float density(SunDisk const& sun, float one_minus_x) {
    float const a = sampled_exponent(sun);
    float const shape = a > 0 ? (a + 1) * std::pow(one_minus_x, a) : 1;
    return shape * cone_pdf(sun.one_minus_cos);
}

/// x of the unit direction `d`; above 1 off the disk. 1 - cos as half the square of the chord,
/// which has digits where the cosine of a small angle has none.
float cone_share(SunDisk const& sun, Vec3 const& d) {
    return 0.5f * length_squared(d - sun.direction) / sun.one_minus_cos;
}

} // namespace

LightSample SunDisk::sample(Vec2 u) const {
    Vec2 const p = square_to_disk(u);
    // The share of the light within the radius of p, then that of the cone.
    float const r2 = p.x * p.x + p.y * p.y;
    float const dark = std::max(1 - r2, 0x1p-24f);
    float const a = sampled_exponent(*this);
    float const one_minus_x = a > 0 ? std::pow(dark, 1 / (a + 1)) : dark;
    float const h = (1 - one_minus_x) * one_minus_cos; // 1 - cos theta
    float const scale = r2 > 0 ? safe_sqrt(h * (2 - h) / r2) : 0;
    Frame const frame(direction);
    return {.wi = normalize(frame.to_world({p.x * scale, p.y * scale, 1 - h})),
            .distance = kInfinity,
            .radiance = centre * darkening(one_minus_x, limb),
            .pdf = density(*this, one_minus_x)};
}

float SunDisk::pdf(Vec3 const& d) const {
    float const x = cone_share(*this, d);
    return x < 1 ? density(*this, 1 - x) : 0;
}

Color SunDisk::radiance(Vec3 const& d) const {
    float const x = cone_share(*this, d);
    return x < 1 ? centre * darkening(1 - x, limb) : Color(0);
}

// With a = alpha / 2 and h = 1 - cos(radius): 2 pi h times the integral of (1 - x)^a (1 - h x).
Color SunDisk::irradiance() const {
    auto const channel = [&](float alpha) {
        float const a = 0.5f * alpha;
        return 2 * kPi * one_minus_cos * (1 - one_minus_cos / (a + 2)) / (a + 1);
    };
    return centre * Color(channel(limb.r), channel(limb.g), channel(limb.b));
}

SunDisk make_sun_disk(Vec3 const& direction, float radius, Color const& irradiance,
                      Color const& limb) {
    float const h = 2 * square(std::sin(0.5f * radius));
    SunDisk sun{direction, h, Color(1), limb};
    sun.centre = irradiance / sun.irradiance();
    return sun;
}

} // namespace weft::lights
