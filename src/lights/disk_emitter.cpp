#include <numbers>
#include <utility>

#include "base/warp.h"
#include "lights/area_sampling.h"
#include "lights/emitter_geometry.h"

namespace weft::lights {

namespace {

/// A symmetric 3 x 3 matrix, and the columns of the rotation that makes it diagonal.
struct Eigen {
    double m[3][3];
    Vec3d axes[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    /// Rotates axes p and q so that m[p][q] vanishes.
    void rotate(int p, int q) {
        double const off = m[p][q], theta = (m[q][q] - m[p][p]) / (2 * off);
        double const t = std::copysign(1 / (std::abs(theta) + std::sqrt(theta * theta + 1)), theta);
        double const c = 1 / std::sqrt(t * t + 1), s = t * c;
        int const r = 3 - p - q;
        m[p][p] -= t * off;
        m[q][q] += t * off;
        m[p][q] = m[q][p] = 0;
        double const rp = m[r][p], rq = m[r][q];
        m[r][p] = m[p][r] = c * rp - s * rq;
        m[r][q] = m[q][r] = s * rp + c * rq;
        Vec3d const axis = axes[p];
        axes[p] = axis * c - axes[q] * s;
        axes[q] = axis * s + axes[q] * c;
    }
    /// Jacobi's method: a sweep squares what is left beside the diagonal.
    void diagonalise() {
        double const all = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2] +
                           m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
        constexpr int most_sweeps = 8;
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            bool any = false;
            for (auto const& [p, q] : {std::pair(1, 2), std::pair(0, 2), std::pair(0, 1)}) {
                if (!(m[p][q] * m[p][q] > 1e-30 * all)) continue;
                rotate(p, q);
                any = true;
            }
            if (!any) return;
        }
    }
};

double squared(double x) { return x * x; }

/// 1 - cos for the square of the tangent.
double one_minus_cos(double tan2) { return tan2 / (1 + tan2 + std::sqrt(1 + tan2)); }

} // namespace

/// The cone of directions, in the frame of the ellipse whose z points from ref to its plane.
struct DiskEmitter::View {
    Vec3d to_centre;          ///< its z, the distance of the plane, is >= 0
    Vec3d major, minor, axis; ///< of the cone
    double a2, b2;            ///< squares of the tangents of the half angles
    double k;
    double turn_cos = 1, turn_sin = 0; ///< of this frame to the ellipse's, for circles
    double solid_angle = 0;            ///< about; 0: to be sampled by area

    double tan2(double cos2_phi) const { return a2 * b2 / (b2 * cos2_phi + a2 * (1 - cos2_phi)); }
    /// Per solid angle, towards a point of the plane.
    double density(double x, double y) const {
        Vec3d const w(x, y, to_centre.z);
        double const p = dot(w, major), q = dot(w, minor), r2 = p * p + q * q;
        double const c2 = r2 > 0 ? p * p / r2 : 1;
        return std::sqrt(k) /
               (2 * std::numbers::pi * (c2 + k * (1 - c2)) * one_minus_cos(tan2(c2)));
    }
    Vec3d direction(Vec2 u) const {
        double const t = 2 * std::numbers::pi * double(u.y);
        double const x = std::sqrt(k) * std::cos(t), y = std::sin(t), per_r = 1 / std::hypot(x, y);
        double const h = double(u.x) * one_minus_cos(tan2(x * x * per_r * per_r));
        double const sine = std::sqrt(h * (2 - h)) * per_r;
        return major * (x * sine) + minor * (y * sine) + axis * (1 - h);
    }
};

DiskEmitter::DiskEmitter(Affine const& to_world) {
    Affined const m(to_world);
    centre_ = m.origin;
    // The ellipse's axes are those of the symmetric matrix of scalar products.
    double const xx = dot(m.x, m.x), yy = dot(m.y, m.y), xy = dot(m.x, m.y);
    double const angle = 0.5 * std::atan2(2 * xy, xx - yy);
    turn_cos_ = std::cos(angle);
    turn_sin_ = std::sin(angle);
    Vec3d const x = m.x * turn_cos_ + m.y * turn_sin_, y = m.y * turn_cos_ - m.x * turn_sin_;
    radius_x_ = length(x);
    radius_y_ = length(y);
    Vec3d const c = cross(m.x, m.y);
    double const by = length(c);
    area_ = float(std::numbers::pi * by);
    normal_ = c * ((m.determinant() < 0 ? -1 : 1) / by);
    axis_x_ = x * (1 / radius_x_);
    axis_y_ = cross(normal_, axis_x_);
    if (dot(axis_y_, y) < 0) axis_y_ = -axis_y_;
}

Box DiskEmitter::box() const {
    auto const reach = [&](double x, double y) {
        return std::sqrt(squared(x * radius_x_) + squared(y * radius_y_));
    };
    Vec3 const r(Vec3d(reach(axis_x_.x, axis_y_.x), reach(axis_x_.y, axis_y_.y),
                       reach(axis_x_.z, axis_y_.z)));
    return {centre() - r, centre() + r};
}

DiskEmitter::View DiskEmitter::view(Vec3 const& ref) const {
    View v;
    Vec3d const d = centre_ - Vec3d(ref);
    v.to_centre = {dot(d, axis_x_), dot(d, axis_y_), std::abs(dot(d, normal_))};
    Vec3d& c = v.to_centre;
    double const distance2 = length_squared(c), rx2 = radius_x_ * radius_x_,
                 ry2 = radius_y_ * radius_y_, largest2 = std::max(rx2, ry2);
    if (is_far(largest2, distance2) || !(c.z > 1e-9 * std::sqrt(largest2)) || !(area_ > 0))
        return v;
    if (std::abs(rx2 - ry2) < 1e-12 * rx2) {
        // A circle may be turned so that the centre lies in the plane x = 0: a third of the work.
        double const aside = std::hypot(c.x, c.y);
        if (aside > 0) {
            v.turn_cos = c.y / aside;
            v.turn_sin = c.x / aside;
        }
        c.x = 0;
        c.y = aside;
    }
    Eigen e{{{rx2 - c.x * c.x, -c.x * c.y, -c.x * c.z},
             {-c.x * c.y, ry2 - c.y * c.y, -c.y * c.z},
             {-c.x * c.z, -c.y * c.z, -c.z * c.z}}};
    e.diagonalise();
    int order[]{0, 1, 2};
    std::sort(order, order + 3, [&](int i, int k) { return e.m[i][i] > e.m[k][k]; });
    double m[]{std::abs(e.m[order[0]][order[0]]), std::abs(e.m[order[1]][order[1]]),
               std::abs(e.m[order[2]][order[2]])};
    // The least of them is a difference of large numbers, but their product is known.
    double const product = squared(radius_x_ * radius_y_ * c.z);
    (m[1] < m[2] ? m[1] : m[2]) = product / (m[0] * std::max(m[1], m[2]));
    v.a2 = m[0] / m[2];
    v.b2 = m[1] / m[2];
    v.major = e.axes[order[0]];
    v.minor = e.axes[order[1]];
    v.axis = e.axes[order[2]] * (dot(e.axes[order[2]], c) < 0 ? -1.0 : 1.0);
    double const at_major = one_minus_cos(v.a2), at_minor = one_minus_cos(v.b2);
    v.k = at_major / at_minor;
    double const solid_angle = 2 * std::numbers::pi * std::sqrt(at_major * at_minor);
    if (solid_angle >= double(kMinSolidAngle)) v.solid_angle = solid_angle;
    return v;
}

/// The point at (s, t) in the unit disk of the ellipse's own axes; without the density.
EmitterSample DiskEmitter::at(Vec3 const& ref, double s, double t) const {
    EmitterSample e;
    e.p = Vec3(centre_ + axis_x_ * (radius_x_ * s) + axis_y_ * (radius_y_ * t));
    e.n = Vec3(normal_);
    auto const to_unit = [](double x) { return std::clamp(float(0.5 * (x + 1)), 0.f, 1.f); };
    e.uv = {to_unit(turn_cos_ * s - turn_sin_ * t), to_unit(turn_sin_ * s + turn_cos_ * t)};
    Vec3 const d = e.p - ref;
    e.distance = length(d);
    if (e.distance > 0) e.wi = d * (1 / e.distance);
    return e;
}

EmitterSample DiskEmitter::at_uv(Vec3 const& ref, Vec2 uv) const {
    double const x = 2 * double(uv.x) - 1, y = 2 * double(uv.y) - 1;
    if (x * x + y * y > 1) return {};
    EmitterSample e = at(ref, turn_cos_ * x + turn_sin_ * y, turn_cos_ * y - turn_sin_ * x);
    e.uv = uv;
    return e;
}

float DiskEmitter::density(View const& v, Vec3 const& ref, Vec3 const& p) const {
    Vec3d const d = Vec3d(p) - Vec3d(ref);
    if (v.solid_angle > 0) {
        double const x = dot(d, axis_x_), y = dot(d, axis_y_);
        return float(v.density(v.turn_cos * x - v.turn_sin * y, v.turn_sin * x + v.turn_cos * y));
    }
    return area_density(double(area_) * v.to_centre.z, length_squared(d));
}

EmitterSample DiskEmitter::sample(Vec3 const& ref, Vec2 u, uint32_t) const {
    if (!(area_ > 0)) return {};
    View const v = view(ref);
    double s, t;
    if (v.solid_angle > 0) {
        Vec3d const w = v.direction(u);
        double const along = v.to_centre.z / std::max(w.z, 1e-300);
        double const x = along * w.x - v.to_centre.x, y = along * w.y - v.to_centre.y;
        s = (v.turn_cos * x + v.turn_sin * y) / radius_x_;
        t = (v.turn_cos * y - v.turn_sin * x) / radius_y_;
        // What rounding carried over the edge.
        double const beyond = std::max(1.0, std::hypot(s, t));
        s /= beyond;
        t /= beyond;
    } else {
        Vec2 const p = square_to_disk(u);
        s = double(p.x);
        t = double(p.y);
    }
    EmitterSample e = at(ref, s, t);
    e.pdf = e.distance > 0 ? density(v, ref, e.p) : 0;
    return e;
}

float DiskEmitter::pdf(Vec3 const& ref, Vec3 const& p, Vec3 const&, uint32_t) const {
    return area_ > 0 ? density(view(ref), ref, p) : 0;
}

} // namespace weft::lights
