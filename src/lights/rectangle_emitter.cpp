// Spherical rectangle sampling after Urena et al. 2013, rearranged so that it keeps its digits
// for small, far, thin and grazing rectangles, with one arc tangent instead of four arc
// cosines.
//
// In the frame of the rectangle, ref at the origin, let it be [x0, x1] x [y0, y1] in the plane
// z > 0. The part with abscissa between 0 and x subtends the signed solid angle
//   G(x) = F(x, y1) - F(x, y0),   F(x, y) = atan(x y / (z r)),   r^2 = x^2 + y^2 + z^2,
// which is the argument of the complex number (z r1 + i x y1)(z r0 - i x y0). Sums of angles
// become products of complex numbers, in which nothing cancels before the double's last digits.
// With sin t_k = y_k / sqrt(y_k^2 + z^2), G(x) = phi is solved by
//   (x / z)^2 = sin^2 phi / ((cos phi - cos(t1 - t0)) (cos phi + cos(t1 + t0))).
#include "lights/emitter_geometry.h"
#include "lights/spherical_triangle.h"

namespace weft::lights {

namespace {

struct Complex {
    double re, im;
};

/// In [-pi, pi]. The parts may be too large for floats where their quotient is not.
float argument(Complex const& c) {
    float const angle = std::atan(float(c.im / c.re));
    return c.re < 0 ? angle + (c.im < 0 ? -kPi : kPi) : angle;
}

/// Four at once: as many as one instruction takes.
std::array<double, 4> roots(std::array<double, 4> const& a) {
    std::array<double, 4> r;
    for (size_t i = 0; i < 4; ++i) r[i] = std::sqrt(a[i]);
    return r;
}

} // namespace

/// What is within reach, in the frame of the rectangle with ref at the origin.
struct RectangleEmitter::Bounds {
    double corner_x, corner_y; ///< of uv (0, 0) of the whole rectangle
    double x0, x1, y0, y1, z;

    double area() const { return (x1 - x0) * (y1 - y0); }
};

struct RectangleEmitter::View : Bounds {
    Complex start;     ///< exp(i G(x0)) times a length, x0^2 + z^2 times l
    float solid_angle; ///< G(x1) - G(x0)

    /// The square of l = sqrt((y0^2 + z^2) (y1^2 + z^2)).
    double l2() const { return (y0 * y0 + z * z) * (y1 * y1 + z * z); }
    /// exp(i G(x)) times (x^2 + z^2) l; r0 and r1 are the distances to (x, y0) and (x, y1).
    Complex swept(double x, double r0, double r1) const {
        return {z * z * (r0 * r1) + x * x * (y0 * y1), x * z * (y1 * r0 - y0 * r1)};
    }

    /// Where G has grown by the share u of the solid angle.
    double abscissa(float u) const {
        float const angle = u * solid_angle;
        double const c = std::cos(angle), s = std::sin(angle), zz = z * z, yy = y0 * y1;
        double const q = 1 / std::sqrt(l2());
        // The float pair has a good angle but a length only near 1: one Newton step.
        double const k = (1.5 - 0.5 * (c * c + s * s)) * q / (x0 * x0 + zz);
        double const cos_phi = (start.re * c - start.im * s) * k;
        double const sin_phi = (start.im * c + start.re * s) * k;
        double const cos_delta = (zz + yy) * q, sin_delta = z * (y1 - y0) * q;
        double const outer = cos_phi + (zz - yy) * q;
        // cos phi - cos delta = (sin^2 delta - sin^2 phi) / (cos phi + cos delta)
        bool const small = cos_delta > 0;
        double const top = small ? cos_phi + cos_delta : 1;
        double const bottom = small ? (sin_delta - sin_phi) * (sin_delta + sin_phi) * outer
                                    : (cos_phi - cos_delta) * outer;
        if (!(bottom > 0)) return sin_phi > 0 ? x1 : x0;
        return std::clamp(z * sin_phi * std::sqrt(top / bottom), x0, x1);
    }

    /// Uniform in solid angle on the line of abscissa x, where y / r is linear in u.
    double ordinate(double x, float u) const {
        double const d2 = x * x + z * z;
        double const r0 = d2 + y0 * y0, r1 = d2 + y1 * y1; // squared
        auto const root = roots({r0, r1, d2, 0});
        // Numerators over the common denominator sqrt(r0 r1).
        double const h0 = y0 * root[1], h1 = y1 * root[0];
        double const h = h0 + double(u) * (h1 - h0), rest = r0 * r1 - h * h;
        if (!(rest > 0)) return h > 0 ? y1 : y0;
        return std::clamp(h * root[2] / std::sqrt(rest), y0, y1);
    }
};

/// The parts of a parallelogram on either side of its diagonal from uv (0, 0) to (1, 1).
struct RectangleEmitter::Halves {
    SphericalTriangle lower, upper; ///< with (1, 0); with (0, 1)

    float solid_angle() const { return lower.solid_angle() + upper.solid_angle(); }
    Vec2 sample(Vec2 u) const {
        float const share = lower.solid_angle() / solid_angle();
        if (u.x < share) {
            Vec2 const b = lower.sample({u.x / share, u.y});
            return {std::min(b.x + b.y, 1.f), b.y};
        }
        Vec2 const b = upper.sample({std::min((u.x - share) / (1 - share), 1.f), u.y});
        return {b.x, std::min(b.x + b.y, 1.f)};
    }
};

RectangleEmitter::Halves RectangleEmitter::halves(Vec3d const& to_corner) const {
    Vec3d const diagonal = edge_x_ + edge_y_;
    return {{to_corner, edge_x_, diagonal}, {to_corner, diagonal, edge_y_}};
}

RectangleEmitter::RectangleEmitter(Affine const& to_world, float reach) : reach_(double(reach)) {
    Affined const m(to_world);
    corner_ = m.origin - m.x - m.y;
    edge_x_ = m.x * 2.0;
    edge_y_ = m.y * 2.0;
    length_x_ = length(edge_x_);
    length_y_ = length(edge_y_);
    radius2_ =
        0.25 * std::max(length_squared(edge_x_ + edge_y_), length_squared(edge_x_ - edge_y_));
    per_x_ = 1 / length_x_;
    per_y_ = 1 / length_y_;
    axis_x_ = edge_x_ * per_x_;
    axis_y_ = edge_y_ * per_y_;
    Vec3d const c = cross(edge_x_, edge_y_);
    double const twice = length(c);
    area_ = float(twice);
    // A^-T z = cross(x, y) / det. Where A flattens z the sign of +z is taken.
    normal_ = c * ((m.determinant() < 0 ? -1 : 1) / twice);
    // What rounding leaves of a right angle; a shear of this size moves the density as little.
    is_rectangle_ = std::abs(dot(axis_x_, axis_y_)) < 1e-5;
}

Box RectangleEmitter::box() const {
    Vec3 const centre = this->centre(), reach = (abs(Vec3(edge_x_)) + abs(Vec3(edge_y_))) * 0.5f;
    return {centre - reach, centre + reach};
}

bool RectangleEmitter::is_far(Vec3d const& to_corner) const {
    return lights::is_far(radius2_, length_squared(to_corner + (edge_x_ + edge_y_) * 0.5));
}

RectangleEmitter::Bounds RectangleEmitter::within_reach(Vec3d const& to_corner) const {
    Bounds v;
    v.x0 = v.corner_x = dot(to_corner, axis_x_);
    v.y0 = v.corner_y = dot(to_corner, axis_y_);
    v.z = std::abs(dot(to_corner, normal_));
    v.x1 = v.x0 + length_x_;
    v.y1 = v.y0 + length_y_;
    if (reach_ < std::numeric_limits<double>::infinity()) {
        double const reach = reach_ * v.z;
        v.x0 = std::max(v.x0, -reach);
        v.y0 = std::max(v.y0, -reach);
        v.x1 = std::min(v.x1, reach);
        v.y1 = std::min(v.y1, reach);
        if (!(v.x0 < v.x1 && v.y0 < v.y1)) {
            v.x1 = v.x0;
            v.y1 = v.y0;
        }
    }
    return v;
}

RectangleEmitter::View RectangleEmitter::view(Vec3d const& to_corner) const {
    View v{within_reach(to_corner), {}, 0};
    double const z2 = v.z * v.z, dx0 = v.x0 * v.x0 + z2, dx1 = v.x1 * v.x1 + z2, yy0 = v.y0 * v.y0,
                 yy1 = v.y1 * v.y1;
    auto const r = roots({dx0 + yy0, dx0 + yy1, dx1 + yy0, dx1 + yy1});
    v.start = v.swept(v.x0, r[0], r[1]);
    Complex const a = v.start, b = v.swept(v.x1, r[2], r[3]);
    v.solid_angle = argument({b.re * a.re + b.im * a.im, b.im * a.re - b.re * a.im});
    // Where either part is over pi / 2 so is the whole, which may exceed pi and have wrapped.
    bool const wide = v.x0 < 0 && v.x1 > 0 && (a.re < 0 || b.re < 0);
    if (wide && v.solid_angle < kPi / 2) v.solid_angle += 2 * kPi;
    return v;
}

float RectangleEmitter::solid_angle(Vec3 const& ref) const {
    Vec3d const to_corner = corner_ - Vec3d(ref);
    return is_rectangle_ ? view(to_corner).solid_angle : halves(to_corner).solid_angle();
}

EmitterSample RectangleEmitter::at_uv(Vec3 const& ref, Vec2 uv) const {
    EmitterSample s;
    s.p = Vec3(corner_ + edge_x_ * double(uv.x) + edge_y_ * double(uv.y));
    s.n = Vec3(normal_);
    s.uv = uv;
    Vec3 const d = s.p - ref;
    s.distance = length(d);
    if (s.distance > 0) s.wi = d * (1 / s.distance);
    return s;
}

/// Of a point chosen uniformly from what is within reach of ref.
float RectangleEmitter::area_pdf(Vec3d const& to_corner, Vec3 const& ref, Vec3 const& p) const {
    bool const whole = !is_rectangle_ || reach_ == std::numeric_limits<double>::infinity();
    double const area = whole ? double(area_) : within_reach(to_corner).area();
    return area_density(area * std::abs(dot(to_corner, normal_)), double(length_squared(p - ref)));
}

EmitterSample RectangleEmitter::sample(Vec3 const& ref, Vec2 u, uint32_t) const {
    Vec3d const to_corner = corner_ - Vec3d(ref);
    auto const uv_at = [&](Bounds const& b, double x, double y) {
        return Vec2(float((x - b.corner_x) * per_x_), float((y - b.corner_y) * per_y_));
    };
    auto const by_solid_angle = [&](Vec2 uv, float solid_angle) {
        EmitterSample s = at_uv(ref, uv);
        s.pdf = s.distance > 0 ? 1 / solid_angle : 0;
        return s;
    };
    if (!is_far(to_corner) && is_rectangle_) {
        View const v = view(to_corner);
        if (v.solid_angle >= kMinSolidAngle) {
            double const x = v.abscissa(u.x);
            return by_solid_angle(uv_at(v, x, v.ordinate(x, u.y)), v.solid_angle);
        }
    } else if (!is_far(to_corner)) {
        Halves const h = halves(to_corner);
        if (h.solid_angle() >= kMinSolidAngle) return by_solid_angle(h.sample(u), h.solid_angle());
    }
    Vec2 uv = u;
    if (is_rectangle_ && reach_ < std::numeric_limits<double>::infinity()) {
        Bounds const b = within_reach(to_corner);
        uv = uv_at(b, b.x0 + double(u.x) * (b.x1 - b.x0), b.y0 + double(u.y) * (b.y1 - b.y0));
    }
    EmitterSample s = at_uv(ref, uv);
    s.pdf = area_pdf(to_corner, ref, s.p);
    return s;
}

float RectangleEmitter::pdf(Vec3 const& ref, Vec3 const& p, Vec3 const&, uint32_t) const {
    Vec3d const to_corner = corner_ - Vec3d(ref);
    if (!is_far(to_corner)) {
        float const omega =
            is_rectangle_ ? view(to_corner).solid_angle : halves(to_corner).solid_angle();
        if (omega >= kMinSolidAngle) return 1 / omega;
    }
    return area_pdf(to_corner, ref, p);
}

} // namespace weft::lights
