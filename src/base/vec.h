// Vectors: Imath's storage with the operations spelled as words.
//
// `dot(a, b)` reads better than Imath's `a ^ b`, and these skip Imath's guards for denormal
// lengths: a direction of length 1e-20 is a bug that should show as NaN, not be hidden.
#pragma once

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace weft {

using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
using Vec2i = Imath::V2i;
using Vec3d = Imath::V3d;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// The largest float below 1; canonical random numbers lie in [0, kOneMinusEpsilon].
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

template <class T>
constexpr T dot(Imath::Vec3<T> const& a, Imath::Vec3<T> const& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

constexpr float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

template <class T>
constexpr Imath::Vec3<T> cross(Imath::Vec3<T> const& a, Imath::Vec3<T> const& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
constexpr T length_squared(Imath::Vec3<T> const& v) {
    return dot(v, v);
}

template <class T>
T length(Imath::Vec3<T> const& v) {
    return std::sqrt(dot(v, v));
}

/// `v` scaled to length 1. The zero vector gives NaN.
template <class T>
Imath::Vec3<T> normalize(Imath::Vec3<T> const& v) {
    return v * (T(1) / length(v));
}

inline Vec3 abs(Vec3 const& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }
/// The smaller and the larger of each component.
template <class T>
constexpr Imath::Vec3<T> min(Imath::Vec3<T> const& a, Imath::Vec3<T> const& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <class T>
constexpr Imath::Vec3<T> max(Imath::Vec3<T> const& a, Imath::Vec3<T> const& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
constexpr float max_component(Vec3 const& v) { return std::max(v.x, std::max(v.y, v.z)); }
constexpr float min_component(Vec3 const& v) { return std::min(v.x, std::min(v.y, v.z)); }
inline bool is_finite(Vec3 const& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

constexpr float square(float x) { return x * x; }
/// sqrt that maps the small negative results of rounding to 0 (and lets NaN through).
inline float safe_sqrt(float x) { return std::sqrt(x < 0 ? 0.f : x); }
constexpr float lerp(float a, float b, float t) { return a + (b - a) * t; }
constexpr float radians(float degrees) { return degrees * (kPi / 180); }
constexpr float degrees(float radians) { return radians * (180 / kPi); }

} // namespace weft
