#include <numbers>

#include "base/frame.h"
#include "base/lat_long.h"
#include "base/warp.h"
#include "lights/emitter_geometry.h"

namespace weft::lights {

namespace {

/// The integral of |cof(A) n| over the unit sphere, by the midpoint rule: for the power of a
/// light, so good to about 1e-4 unless the semi-axes differ more than tenfold.
double ellipsoid_area(Affined const& m) {
    Vec3d const cx = cross(m.y, m.z), cy = cross(m.z, m.x), cz = cross(m.x, m.y);
    int const rows = 96, columns = 96;
    double const pi = std::numbers::pi;
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        double const z = (i + 0.5) * 2 / rows - 1, r = std::sqrt(1 - z * z);
        for (int j = 0; j < columns; ++j) {
            double const phi = (j + 0.5) * 2 * pi / columns;
            sum += length(cx * (r * std::cos(phi)) + cy * (r * std::sin(phi)) + cz * z);
        }
    }
    return sum * 4 * pi / (rows * columns);
}

} // namespace

/// The unit sphere as seen from ref, in its own space.
struct SphereEmitter::View {
    Vec3d ref;           ///< from the centre
    double beyond;       ///< |ref|^2 - 1: positive outside
    float one_minus_cos; ///< of the half angle of the cone of directions that hit
};

SphereEmitter::SphereEmitter(Affine const& to_world)
    : to_world_(to_world), to_local_exact_(Affined(to_world).inverse()) {
    to_local_ = Affine(to_local_exact_);
    double const det = std::abs(Affined(to_world).determinant());
    inverse_determinant_ = det > 0 ? float(1 / det) : 0;
    area_ = float(ellipsoid_area(Affined(to_world)));
}

Box SphereEmitter::box() const {
    Affine const& m = to_world_;
    // Along an axis the farthest image of a unit vector is the length of the matrix's row.
    Vec3 const reach(length(Vec3(m.x.x, m.y.x, m.z.x)), length(Vec3(m.x.y, m.y.y, m.z.y)),
                     length(Vec3(m.x.z, m.y.z, m.z.z)));
    return {m.origin - reach, m.origin + reach};
}

SphereEmitter::View SphereEmitter::view(Vec3 const& ref) const {
    View v;
    v.ref = to_local_exact_.vector(Vec3d(ref) - Vec3d(to_world_.origin));
    double const d2 = length_squared(v.ref);
    v.beyond = d2 - 1;
    // 1 - cos = sin^2 / (1 + cos) keeps its digits for far spheres.
    double const s = 1 / d2;
    v.one_minus_cos = v.beyond > 0 ? float(s / (1 + std::sqrt(v.beyond * s))) : 2.f;
    return v;
}

float SphereEmitter::direction_pdf(View const& v, Vec3 const& wi) const {
    Vec3 const w = to_local_.vector(wi);
    float const stretch = length_squared(w);
    float const pdf =
        cone_pdf(v.one_minus_cos) * (inverse_determinant_ / (stretch * std::sqrt(stretch)));
    return std::isfinite(pdf) ? pdf : 0;
}

namespace {

/// The point of the unit sphere seen from outside along a direction uniform in the cone.
///
/// With theta the angle at ref and alpha that at the centre, the angle of incidence is beta =
/// theta + alpha and sin beta = |ref| sin theta. All three follow from u without a difference of
/// near numbers, however far or near ref is.
Vec3 point_from_outside(Vec3d const& ref, double beyond, float one_minus_cos, Vec2 u) {
    float const m = one_minus_cos, h = u.x * m;
    float const cos_theta = 1 - h, sin2_theta = h * (2 - h);
    float const sin2_beta = u.x * (2 - h) / (2 - m);
    float const cos_beta = safe_sqrt((1 - u.x) * (2 - m * (1 + u.x)) / (2 - m));
    float const d = float(std::sqrt(beyond + 1));
    float const sin_beta = std::sqrt(sin2_beta);
    float const sin_alpha = sin_beta * (float(beyond) / d) / (d * cos_theta + cos_beta);
    float const cos_alpha = cos_beta * cos_theta + sin_beta * std::sqrt(sin2_theta);
    float const phi = 2 * kPi * u.y;
    Frame const frame(Vec3(ref * (1.0 / std::sqrt(beyond + 1))));
    return frame.to_world({sin_alpha * std::cos(phi), sin_alpha * std::sin(phi), cos_alpha});
}

/// The point of the unit sphere seen from inside along a uniform direction.
Vec3 point_from_inside(Vec3d const& ref, double beyond, Vec2 u) {
    Vec3d const w(square_to_sphere(u));
    double const b = dot(ref, w);
    double const t = std::sqrt(std::max(b * b - beyond, 0.0)) - b;
    return Vec3(normalize(ref + w * t));
}

} // namespace

/// The point of direction `local` from the centre; without a density.
EmitterSample SphereEmitter::at(Vec3 const& ref, Vec3 const& local) const {
    EmitterSample s;
    s.p = to_world_.point(local);
    s.n = normalize(to_local_.transposed(local));
    s.uv = direction_to_uv(local);
    Vec3 const d = s.p - ref;
    s.distance = length(d);
    if (s.distance > 0) s.wi = d * (1 / s.distance);
    return s;
}

EmitterSample SphereEmitter::at_uv(Vec3 const& ref, Vec2 uv) const {
    if (inverse_determinant_ == 0) return {};
    EmitterSample s = at(ref, uv_to_direction(uv));
    s.uv = uv;
    return s;
}

/// A unit of area with normal n becomes |det A| |A^-T n|; of the uv square it is 2 pi^2 sin theta.
float SphereEmitter::area_by_uv(Vec2 uv) const {
    if (inverse_determinant_ == 0) return 0;
    return length(to_local_.transposed(uv_to_direction(uv))) / inverse_determinant_ * 2 * kPi *
           kPi * std::sin(uv.y * kPi);
}

EmitterSample SphereEmitter::sample(Vec3 const& ref, Vec2 u, uint32_t) const {
    if (inverse_determinant_ == 0) return {};
    View const v = view(ref);
    EmitterSample s = at(ref, v.beyond > 0 ? point_from_outside(v.ref, v.beyond, v.one_minus_cos, u)
                                           : point_from_inside(v.ref, v.beyond, u));
    if (s.distance > 0) s.pdf = direction_pdf(v, s.wi);
    return s;
}

float SphereEmitter::pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t) const {
    if (inverse_determinant_ == 0) return 0;
    Vec3 const d = p - ref;
    float const distance = length(d);
    if (!(distance > 0)) return 0;
    View const v = view(ref);
    Vec3 const wi = d * (1 / distance);
    // The margin is for samples on the silhouette, whose cosine rounds to either side.
    if (v.beyond > 0 && dot(n, wi) > 1e-4f) return 0;
    return direction_pdf(v, wi);
}

} // namespace weft::lights
