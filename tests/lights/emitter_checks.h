// What the tests of the emitters share: the emitters with ray intersections written apart from
// them, and bins over the cone of directions in which an emitter lies.
#pragma once

#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "base/hash.h"
#include "lights/emitter_geometry.h"
#include "tests/support/statistics.h"

namespace weft::lights::testing {

inline constexpr double kTau = 2 * std::numbers::pi;

struct Hit {
    Vec3d p, n; ///< n: unit front normal
    uint32_t primitive;
};

/// All points of the emitter that its `sample` may give along the ray.
using Intersect = std::function<void(Vec3d const& o, Vec3d const& d, std::vector<Hit>&)>;

struct Case {
    std::string name;
    Emitter emitter;
    Intersect intersect;
    Vec3 ref;
    double radius; ///< of a sphere around centre() that holds the emitter
};

inline Intersect rectangle_hits(Affine const& a) {
    Affined const m(a), inv = m.inverse();
    Vec3d const n = normalize(inv.transposed({0, 0, 1}));
    return [=](Vec3d const& o, Vec3d const& d, std::vector<Hit>& hits) {
        Vec3d const lo = inv.point(o), ld = inv.vector(d);
        double const t = -lo.z / ld.z;
        Vec3d const p = lo + ld * t;
        if (t > 0 && std::abs(p.x) <= 1 && std::abs(p.y) <= 1)
            hits.push_back({m.point({p.x, p.y, 0}), n, 0});
    };
}

inline Intersect disk_hits(Affine const& a) {
    Affined const m(a), inv = m.inverse();
    Vec3d const n = normalize(inv.transposed({0, 0, 1}));
    return [=](Vec3d const& o, Vec3d const& d, std::vector<Hit>& hits) {
        Vec3d const lo = inv.point(o), ld = inv.vector(d);
        double const t = -lo.z / ld.z;
        Vec3d const p = lo + ld * t;
        if (t > 0 && p.x * p.x + p.y * p.y <= 1) hits.push_back({m.point({p.x, p.y, 0}), n, 0});
    };
}

inline Intersect sphere_hits(Affine const& a) {
    Affined const m(a), inv = m.inverse();
    return [=](Vec3d const& o, Vec3d const& d, std::vector<Hit>& hits) {
        Vec3d const lo = inv.point(o), ld = normalize(inv.vector(d));
        // The closest approach first, which keeps the digits of far spheres.
        double const b = dot(lo, ld);
        double const miss2 = length_squared(lo - ld * b);
        if (miss2 > 1) return;
        double const half = std::sqrt(1 - miss2);
        double const t = length_squared(lo) > 1 ? -b - half : -b + half;
        if (t <= 0) return;
        Vec3d const p = normalize(lo + ld * t);
        hits.push_back({m.point(p), normalize(inv.transposed(p)), 0});
    };
}

inline Intersect mesh_hits(std::vector<Vec3> const& positions,
                           std::vector<MeshEmitter::Triangle> const& triangles, bool flip) {
    return [=](Vec3d const& o, Vec3d const& d, std::vector<Hit>& hits) {
        for (uint32_t i = 0; i < triangles.size(); ++i) {
            Vec3d const a(positions[triangles[i][0]]);
            Vec3d const e1 = Vec3d(positions[triangles[i][1]]) - a;
            Vec3d const e2 = Vec3d(positions[triangles[i][2]]) - a;
            Vec3d const n = cross(e1, e2), q = cross(o - a, d);
            double const s = -1 / dot(n, d);
            double const b1 = dot(e2, q) * s, b2 = -dot(e1, q) * s, t = dot(n, o - a) * s;
            if (t > 0 && b1 >= 0 && b2 >= 0 && b1 + b2 <= 1)
                hits.push_back({o + d * t, normalize(n) * (flip ? -1.0 : 1.0), i});
        }
    };
}

/// Of all parts of an emitter, each with the same chance.
inline EmitterSample sample(Emitter const& e, Vec3 const& ref, Vec2 u) {
    return match(e, [&](auto const& x) {
        float const parts = float(x.primitives()), at = u.x * parts;
        float const part = std::min(std::floor(at), parts - 1);
        EmitterSample s =
            x.sample(ref, {std::min(at - part, kOneMinusEpsilon), u.y}, uint32_t(part));
        s.pdf /= parts;
        return s;
    });
}
inline float pdf(Emitter const& e, Vec3 const& ref, Hit const& h) {
    return match(e, [&](auto const& x) {
        return x.pdf(ref, Vec3(h.p), Vec3(h.n), h.primitive) / float(x.primitives());
    });
}
inline Vec3 centre(Emitter const& e) {
    return match(e, [](auto const& x) { return x.centre(); });
}

/// The cone around the direction to a case's emitter, cut into bins of equal solid angle.
class ConeBins {
  public:
    static constexpr int kRings = 12, kSectors = 24, kCount = kRings * kSectors;

    explicit ConeBins(Case const& c) {
        Vec3d const to = Vec3d(centre(c.emitter)) - Vec3d(c.ref);
        double const d = length(to), s = c.radius / d;
        n_ = d > 0 ? to / d : Vec3d(0, 0, 1);
        h_max_ = s < 0.95 ? s * s / (1 + std::sqrt(1 - s * s)) : 2;
        s_ = normalize(cross(n_, std::abs(n_.x) > 0.6 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0)));
        t_ = cross(n_, s_);
    }
    double solid_angle() const { return kTau * h_max_; }
    /// The direction at (a, b) in [0, 1]^2 of the whole cone.
    Vec3d direction(double a, double b) const {
        double const h = a * h_max_, r = std::sqrt(h * (2 - h));
        return s_ * (r * std::cos(kTau * b)) + t_ * (r * std::sin(kTau * b)) + n_ * (1 - h);
    }
    /// The bin that holds the direction `d` of any length, or -1 outside the cone.
    int find(Vec3d const& d) const {
        double const x = dot(d, s_), y = dot(d, t_), z = dot(d, n_), l = length(d);
        double const r2 = (x * x + y * y) / (l * l);
        double const h = z > 0 ? r2 / (1 + z / l) : 1 - z / l;
        if (h > h_max_ * (1 + 1e-9)) return -1;
        double const phi = std::atan2(y, x) / kTau;
        int const ring = std::min(int(h / h_max_ * kRings), kRings - 1);
        int const sector = std::min(int((phi < 0 ? phi + 1 : phi) * kSectors), kSectors - 1);
        return ring * kSectors + sector;
    }

  private:
    Vec3d n_, s_, t_;
    double h_max_;
};

} // namespace weft::lights::testing
