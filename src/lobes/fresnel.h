// Fresnel reflectance for unpolarised light (Born and Wolf 1999, 1.5 and 14.2), Schlick's
// approximation of it, and the mirror and Snell directions.
//
// Left out: polarisation, and absorbing media on wo's side.
#pragma once

#include "base/color.h"
#include "base/vec.h"

namespace weft::lobes {

/// Reflectance of a dielectric from the cosines on both sides, which obey Snell's law and are not
/// both 0. Near total reflection this keeps the digits that computing cos_t from cos_o loses.
inline float fresnel_dielectric_cosines(float cos_o, float cos_t, float eta) {
    float const perpendicular = (cos_o - eta * cos_t) / (cos_o + eta * cos_t);
    float const parallel = (eta * cos_o - cos_t) / (eta * cos_o + cos_t);
    return 0.5f * (square(perpendicular) + square(parallel));
}

/// Reflectance of a dielectric; cos_o in [0, 1] on the near side, `eta` = far index / near
/// index > 0. `cos_t` gets the cosine of the refracted ray, 0 under total reflection.
inline float fresnel_dielectric(float cos_o, float eta, float& cos_t) {
    float const c = std::min(std::max(cos_o, 0.f), 1.f);
    // eta^2 cos_t^2, arranged so that eta near 1 keeps its digits at grazing angles.
    float const k = (eta - 1) * (eta + 1) + c * c;
    if (k <= 0) {
        cos_t = 0;
        return 1;
    }
    cos_t = std::min(std::sqrt(k) / eta, 1.f);
    return fresnel_dielectric_cosines(c, cos_t, eta);
}

inline float fresnel_dielectric(float cos_o, float eta) {
    float cos_t;
    return fresnel_dielectric(cos_o, eta, cos_t);
}

/// Reflectance at normal incidence of relative index `eta`.
constexpr float fresnel_f0(float eta) { return square((eta - 1) / (eta + 1)); }

/// Schlick 1994: from `f0` at normal incidence to 1 at grazing; cos_o in [0, 1].
inline Color fresnel_schlick(float cos_o, Color const& f0) {
    float const m = 1 - std::min(std::max(cos_o, 0.f), 1.f), m2 = m * m;
    return f0 + (Color(1) - f0) * (m2 * m2 * m);
}

/// Reflectance of a conductor of complex index eta + i k relative to the near side; cos_o in
/// [0, 1], eta > 0, k >= 0.
inline float fresnel_conductor(float cos_o, float eta, float k) {
    float const c = std::min(std::max(cos_o, 0.f), 1.f);
    float const c2 = c * c, s2 = 1 - c2;
    float const d = (eta - k) * (eta + k) - s2;
    float const a2_plus_b2 = std::sqrt(d * d + 4 * square(eta * k));
    float const a = safe_sqrt(0.5f * (a2_plus_b2 + d));
    float const t1 = a2_plus_b2 + c2, t2 = 2 * a * c;
    float const perpendicular = (t1 - t2) / (t1 + t2);
    float const t3 = c2 * a2_plus_b2 + s2 * s2, t4 = t2 * s2;
    // At grazing incidence on k = 0, eta = 1 both are 0; the limit does not matter there.
    float const parallel = t3 + t4 > 0 ? perpendicular * ((t3 - t4) / (t3 + t4)) : 1.f;
    return std::min(std::max(0.5f * (perpendicular + parallel), 0.f), 1.f);
}

inline Color fresnel_conductor(float cos_o, Color const& eta, Color const& k) {
    return {fresnel_conductor(cos_o, eta.r, k.r), fresnel_conductor(cos_o, eta.g, k.g),
            fresnel_conductor(cos_o, eta.b, k.b)};
}

/// `wo` mirrored at the unit normal `m`.
inline Vec3 reflect(Vec3 const& wo, Vec3 const& m) { return m * (2 * dot(wo, m)) - wo; }

/// `wo` refracted at the unit normal `m` on wo's side; `cos_o` = dot(wo, m) >= 0, `cos_t` from
/// `fresnel_dielectric`.
inline Vec3 refract(Vec3 const& wo, Vec3 const& m, float cos_o, float cos_t, float eta) {
    return normalize(m * (cos_o / eta - cos_t) - wo * (1 / eta));
}

} // namespace weft::lobes
