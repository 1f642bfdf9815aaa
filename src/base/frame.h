// Orthonormal frames. Local z is the normal; `wo` and `wi` leave the surface.
#pragma once

#include "base/vec.h"

namespace weft {

struct Frame {
    Vec3 s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};

    constexpr Frame() = default;
    constexpr Frame(Vec3 const& tangent, Vec3 const& bitangent, Vec3 const& normal)
        : s(tangent), t(bitangent), n(normal) {}
    /// Any frame around unit `n`: Duff et al. 2017, "Building an orthonormal basis, revisited".
    explicit Frame(Vec3 const& normal) : n(normal) {
        float const sign = std::copysign(1.f, n.z);
        float const a = -1 / (sign + n.z);
        float const b = n.x * n.y * a;
        s = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        t = {b, sign + n.y * n.y * a, -n.y};
    }
    /// The frame around unit `n` whose s lies along the projection of `tangent`, or any frame
    /// where that vanishes.
    Frame(Vec3 const& normal, Vec3 const& tangent) {
        Vec3 const p = tangent - normal * dot(normal, tangent);
        float const l2 = length_squared(p);
        if (!(l2 > 1e-12f * length_squared(tangent))) {
            *this = Frame(normal);
            return;
        }
        n = normal;
        s = p * (1 / std::sqrt(l2));
        // Again: a tangent near the normal leaves little of itself but rounding along the normal.
        s = normalize(s - n * dot(n, s));
        t = cross(n, s);
    }

    /// Turned around n, from s towards t, by an angle in radians.
    Frame turned(float angle) const {
        float const c = std::cos(angle), sine = std::sin(angle);
        return {s * c + t * sine, t * c - s * sine, n};
    }
    friend constexpr bool operator==(Frame const&, Frame const&) = default;

    Vec3 to_local(Vec3 const& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
    Vec3 to_world(Vec3 const& v) const { return s * v.x + t * v.y + n * v.z; }
};

} // namespace weft
