// Maps from the unit square to the domains that light transport integrates over, with their
// densities. All keep stratification: equal areas go to equal measure.
#pragma once

#include "base/vec.h"

namespace weft {

/// (cos a, sin a) for |a| <= pi / 4, to the last bit but one: Moshier's polynomials (Cephes, sinf).
/// Without reduction to that range they cost a third of the library's.
inline Vec2 cos_sin_octant(float a) {
    float const a2 = a * a;
    float const s = ((-1.9515295891e-4f * a2 + 8.3321608736e-3f) * a2 - 1.6666654611e-1f) * a2;
    float const c =
        ((2.443315711809948e-5f * a2 - 1.388731625493765e-3f) * a2 + 4.166664568298827e-2f) * a2;
    return {1 + a2 * (c - 0.5f), a + a * s};
}

/// [0, 1) to a density in proportion to lerp(a, b, x), a and b >= 0 and not both 0: its integral
/// a x + (b - a) x^2 / 2 inverted, in the form that subtracts no near-equals.
inline float sample_linear(float u, float a, float b) {
    if (u == 0 && a == 0) return 0;
    return std::min(u * (a + b) / (a + std::sqrt(a * a + u * (b * b - a * a))), kOneMinusEpsilon);
}
/// A point of the unit square in proportion to the bilinear function with the values `corner` at
/// (0, 0), (1, 0), (0, 1) and (1, 1), >= 0 and not all 0. Density: the function over its mean.
inline Vec2 sample_bilinear(Vec2 u, float const (&corner)[4]) {
    float const y = sample_linear(u.y, corner[0] + corner[1], corner[2] + corner[3]);
    float const left = corner[0] + (corner[2] - corner[0]) * y,
                right = corner[1] + (corner[3] - corner[1]) * y;
    return {sample_linear(u.x, left, right), y};
}
inline float bilinear(Vec2 p, float const (&corner)[4]) {
    float const top = corner[0] + (corner[1] - corner[0]) * p.x,
                bottom = corner[2] + (corner[3] - corner[2]) * p.x;
    return top + (bottom - top) * p.y;
}

/// Unit square to unit disk: Shirley and Chiu 1997, concentric. Density 1 / pi.
inline Vec2 square_to_disk(Vec2 u) {
    float const x = 2 * u.x - 1, y = 2 * u.y - 1;
    if (x == 0 && y == 0) return {0, 0};
    bool const wide = std::abs(x) > std::abs(y);
    // The angle to the nearer axis.
    Vec2 const d = cos_sin_octant((kPi / 4) * (wide ? y / x : x / y));
    return wide ? Vec2(x * d.x, x * d.y) : Vec2(y * d.y, y * d.x);
}

/// Cosine-weighted hemisphere around +z. Density cos / pi.
inline Vec3 square_to_cosine_hemisphere(Vec2 u) {
    Vec2 const d = square_to_disk(u);
    return {d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)};
}
inline float cosine_hemisphere_pdf(float cos_theta) { return std::max(cos_theta, 0.f) * kInvPi; }

/// Whole unit sphere. Density 1 / (4 pi).
inline Vec3 square_to_sphere(Vec2 u) {
    float const z = 1 - 2 * u.x, r = safe_sqrt(1 - z * z), phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr float kSpherePdf = kInvPi / 4;

/// Cone around +z given as 1 - cos of its half angle (kept apart because 1 - cos vanishes
/// first for small cones). Density 1 / (2 pi one_minus_cos).
inline Vec3 square_to_cone(Vec2 u, float one_minus_cos) {
    float const h = u.x * one_minus_cos; // 1 - cos theta
    float const r = safe_sqrt(h * (2 - h)), phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), 1 - h};
}
inline float cone_pdf(float one_minus_cos) { return 1 / (2 * kPi * one_minus_cos); }

/// Barycentric (b1, b2) uniform over a triangle: Heitz 2019, "A low-distortion map between
/// triangle and square". Density 1 / area.
inline Vec2 square_to_triangle(Vec2 u) {
    if (u.y > u.x) {
        float const x = u.x * 0.5f;
        return {x, u.y - x};
    }
    float const y = u.y * 0.5f;
    return {u.x - y, y};
}

} // namespace weft
