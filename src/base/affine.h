// Affine maps p -> A p + t, stored by columns as Embree wants them (column vectors, unlike
// Imath's matrices, so that a scene file's matrix reads as it is written).
#pragma once

#include "base/vec.h"

namespace weft {

template <class T>
struct AffineT {
    using V = Imath::Vec3<T>;
    V x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}; ///< the columns of the linear part
    V origin{0, 0, 0};                    ///< the translation

    constexpr AffineT() = default;
    constexpr AffineT(V const& cx, V const& cy, V const& cz, V const& t)
        : x(cx), y(cy), z(cz), origin(t) {}
    template <class S>
    explicit AffineT(AffineT<S> const& o) : x(o.x), y(o.y), z(o.z), origin(o.origin) {}

    V point(V const& p) const { return x * p.x + y * p.y + z * p.z + origin; }
    V vector(V const& v) const { return x * v.x + y * v.y + z * v.z; }
    /// A^T v. A normal maps by the *inverse* map's `transposed`: n' = M.inverse().transposed(n).
    V transposed(V const& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
    T determinant() const { return dot(cross(x, y), z); }
    /// The inverse map; all NaN or infinite where the determinant is 0.
    AffineT inverse() const {
        T const s = 1 / determinant();
        // The rows of the inverse are the cross products of the columns.
        V const r0 = cross(y, z) * s, r1 = cross(z, x) * s, r2 = cross(x, y) * s;
        AffineT inv{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, V(0)};
        inv.origin = -inv.vector(origin);
        return inv;
    }
    friend AffineT operator*(AffineT const& a, AffineT const& b) {
        return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.origin)};
    }
    friend bool operator==(AffineT const&, AffineT const&) = default;
};

using Affine = AffineT<float>;
using Affined = AffineT<double>; ///< for composing long chains without losing digits

/// The way between an object's own space and the world, in both directions.
struct ObjectSpace {
    Affine to_world, to_object;

    ObjectSpace() = default;
    /// Inverts before it rounds.
    explicit ObjectSpace(Affined const& m) : to_world(m), to_object(m.inverse()) {}
};

} // namespace weft
