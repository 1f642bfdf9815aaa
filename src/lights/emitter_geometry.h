// The shapes that emit light, as things to sample: a rectangle, a sphere, a disk and the triangles
// of a mesh, each under any affine transform. Geometry alone: emission (and whether the back emits
// too) is the caller's, who evaluates its texture at the sampled point, and chooses the triangle.
//
// Every kind has
//   primitives()                   how many parts are sampled each for itself: triangles, or 1
//   sample(ref, u, primitive)      a point on the surface with its solid-angle density at ref
//   pdf(ref, p, n, primitive)      that density for a point found otherwise (for MIS); p lies on
//                                  the surface, n is its unit front normal
//   area(), centre(), box()        world-space area; the box around it and its centre
// and all but meshes, for textures on them (emitter_texture.h),
//   at_uv(ref, uv)                 the point at uv, without a density; distance 0 where none is
//   area_by_uv(uv)                 world-space area per area of the uv square
// and `sample(...).pdf` is `pdf` at the sampled point, up to rounding. A point is sampled whether
// or not its front faces ref, since the caller may let both sides emit.
//
// Near emitters are sampled uniformly by solid angle, or within a quarter of that, at grazing
// angles too; far ones by area (area_sampling.h).
//
// Left out: sampling by projected solid angle (the BSDF's cosine is not used).
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "base/affine.h"

namespace weft::lights {

struct EmitterSample {
    Vec3 p{0, 0, 0};        ///< on the emitter, world space
    Vec3 n{0, 0, 1};        ///< unit normal on the front, the side that emits
    Vec2 uv{0, 0};          ///< surface coordinates for textures
    Vec3 wi{0, 0, 1};       ///< unit, from the reference point to p
    float distance = 0;     ///< from the reference point to p
    float pdf = 0;          ///< per solid angle at the reference point; 0: nothing was sampled
    uint32_t primitive = 0; ///< triangle of a mesh; 0 for the other kinds
};

struct Box {
    Vec3 low, high; ///< corners
};

/// The image of the square [-1, 1]^2 x {0} with normal +z and uv = (xy + 1) / 2.
///
/// The front is the side that the transformed normal A^-T z points to, also where A mirrors.
/// Sampled uniformly in solid angle where it is near: rectangles by Urena, Fajardo and King 2013,
/// "An area-preserving parametrization for spherical rectangles" (rectangle_emitter.cpp has the
/// form used), other parallelograms as two spherical triangles.
class RectangleEmitter {
  public:
    /// `reach`: tangent of the angle from the normal beyond which it is dark. Rectangles are not
    /// sampled there.
    explicit RectangleEmitter(Affine const& to_world, float reach = kInfinity);

    static constexpr uint32_t primitives() { return 1; }
    EmitterSample sample(Vec3 const& ref, Vec2 u, uint32_t primitive = 0) const;
    float pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t primitive = 0) const;
    float area() const { return area_; }
    Vec3 centre() const { return Vec3(corner_ + (edge_x_ + edge_y_) * 0.5); }
    Box box() const;
    Vec3 normal() const { return Vec3(normal_); }
    EmitterSample at_uv(Vec3 const& ref, Vec2 uv) const;
    float area_by_uv(Vec2) const { return area_; }
    /// Returns the solid angle at `ref`, on either side, of what is within reach.
    float solid_angle(Vec3 const& ref) const;

  private:
    struct Bounds;
    struct View;
    struct Halves;
    bool is_far(Vec3d const& to_corner) const;
    Bounds within_reach(Vec3d const& to_corner) const;
    View view(Vec3d const& to_corner) const;
    Halves halves(Vec3d const& to_corner) const;
    float area_pdf(Vec3d const& to_corner, Vec3 const& ref, Vec3 const& p) const;

    // In double, and rotated into the rectangle's frame: the solid angle is a difference.
    Vec3d corner_, edge_x_, edge_y_; ///< the point of uv (0, 0) and the full edges
    Vec3d axis_x_, axis_y_, normal_; ///< unit
    double length_x_, length_y_;
    double per_x_, per_y_; ///< 1 / length
    double radius2_;       ///< of the sphere around it, squared
    float area_;
    double reach_;
    bool is_rectangle_;
};

/// The image of the unit sphere: any ellipsoid. Front: outside. uv: `direction_to_uv` of the
/// point in the sphere's own space.
///
/// Sampled in the sphere's own space, where ref sees a cone of half angle asin(1 / distance)
/// (Shirley, Wang and Zimmerman 1996), and directions map with their Jacobian
///   d omega_local / d omega = |det B| / |B w|^3,  B = A^-1,
/// which is exact for every affine map and constant for similarities. From inside the cone is
/// the whole sphere of directions.
class SphereEmitter {
  public:
    explicit SphereEmitter(Affine const& to_world);

    static constexpr uint32_t primitives() { return 1; }
    EmitterSample sample(Vec3 const& ref, Vec2 u, uint32_t primitive = 0) const;
    /// 0 also for points on the far side as seen from outside: `sample` never gives them.
    float pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t primitive = 0) const;
    float area() const { return area_; }
    Vec3 centre() const { return to_world_.origin; }
    Box box() const;
    EmitterSample at_uv(Vec3 const& ref, Vec2 uv) const;
    float area_by_uv(Vec2 uv) const;

  private:
    struct View;
    View view(Vec3 const& ref) const;
    float direction_pdf(View const& v, Vec3 const& wi) const;
    EmitterSample at(Vec3 const& ref, Vec3 const& local) const;

    Affine to_world_, to_local_;
    Affined to_local_exact_;    ///< its origin is not used: ref - centre is taken first
    float inverse_determinant_; ///< |det B|; 0 where the map is singular
    float area_;
};

/// The image of the disk of radius 1 in z = 0 with normal +z and uv = (xy + 1) / 2: any ellipse.
/// The front is that of a rectangle.
///
/// The directions to an ellipse fill an elliptic cone (Guillen et al. 2017, "Area-preserving
/// parameterizations for spherical ellipses"). With the vector D to the centre and the semi-axes
/// X, Y, the eigenvectors of X X^T + Y Y^T - D D^T are the cone's axes, and for the eigenvalues
/// m1 >= m2 > 0 > m3 its half angles have the tangents a = sqrt(-m1 / m3) and b = sqrt(-m2 / m3).
/// Around its axis, from the major one on, the cone ends at tan^2 theta(phi) = (a b)^2 /
/// (b^2 cos^2 phi + a^2 sin^2 phi). Uniform sampling would need the inverse of an elliptic
/// integral, tabulated there and by Urena et al.; here theta is uniform in solid angle and phi has
/// the density
///   sqrt(k) / (2 pi (cos^2 phi + k sin^2 phi)),   k = (1 - cos theta(0)) / (1 - cos theta(pi /
///   2)),
/// exactly right on both axes, for small ellipses and for circular cones. Per solid angle it varies
/// by at most (1 + sqrt 2) / 2 for any ellipse from anywhere, in closed form, and no sample is
/// rejected as when a rectangle around the ellipse is sampled (Gamito 2016).
class DiskEmitter {
  public:
    explicit DiskEmitter(Affine const& to_world);

    static constexpr uint32_t primitives() { return 1; }
    EmitterSample sample(Vec3 const& ref, Vec2 u, uint32_t primitive = 0) const;
    float pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t primitive = 0) const;
    float area() const { return area_; }
    Vec3 centre() const { return Vec3(centre_); }
    Box box() const;
    Vec3 normal() const { return Vec3(normal_); }
    EmitterSample at_uv(Vec3 const& ref, Vec2 uv) const;
    float area_by_uv(Vec2) const { return area_ * (4 / kPi); }

  private:
    struct View;
    View view(Vec3 const& ref) const;
    EmitterSample at(Vec3 const& ref, double s, double t) const;
    float density(View const& v, Vec3 const& ref, Vec3 const& p) const;

    Vec3d centre_, axis_x_, axis_y_, normal_; ///< unit and orthogonal: the ellipse's own axes
    double radius_x_, radius_y_;              ///< semi-axes, in any order
    double turn_cos_, turn_sin_;              ///< from the ellipse's axes to the disk's x and y
    float area_;
};

/// World-space triangles, each sampled for itself: uniformly in solid angle, or by area from afar
/// (spherical_triangle.h). Front: the side on which the vertices turn counter-clockwise, or the
/// other with `flip` (to be set where the transform that made the positions mirrors), or the other
/// of that for the triangles that are `turned`.
class MeshEmitter {
  public:
    using Triangle = std::array<uint32_t, 3>;

    MeshEmitter(std::vector<Vec3> positions, std::vector<Triangle> triangles,
                std::vector<Vec2> uvs = {}, bool flip = false, std::vector<bool> turned = {});

    uint32_t primitives() const { return uint32_t(triangles_.size()); }
    /// uv is interpolated, or the barycentric weights of vertices 1 and 2 where there are none.
    /// Triangles without area are never sampled.
    EmitterSample sample(Vec3 const& ref, Vec2 u, uint32_t primitive) const;
    float pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t primitive) const;
    float area() const { return area_; }
    float area(uint32_t primitive) const { return 0.5f * length(twice_area_normal(primitive)); }
    Vec3 centre() const { return (box_.low + box_.high) * 0.5f; }
    Box box() const { return box_; }
    Box box(uint32_t primitive) const;
    /// Returns the point by the barycentric weights of vertices 1 and 2.
    Vec3 point(uint32_t primitive, Vec2 b) const;
    Vec2 uv(uint32_t primitive, Vec2 b) const;
    /// Unit, on the front; NaN where there is no area.
    Vec3 normal(uint32_t primitive) const {
        return normalize(twice_area_normal(primitive) * side(primitive));
    }

  private:
    Vec3 twice_area_normal(uint32_t primitive) const;
    float side(uint32_t primitive) const {
        return !turned_.empty() && turned_[primitive] ? -side_ : side_;
    }

    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;
    std::vector<Vec2> uvs_; ///< per position, or empty
    Box box_{Vec3(0), Vec3(0)};
    float area_ = 0;
    float side_;               ///< +1, or -1 where flipped
    std::vector<bool> turned_; ///< per triangle, or empty
};

using Emitter = std::variant<RectangleEmitter, SphereEmitter, DiskEmitter, MeshEmitter>;

} // namespace weft::lights
