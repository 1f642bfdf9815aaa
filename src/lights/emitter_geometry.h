// The shapes that emit light, as things to sample: a rectangle, a sphere and a triangle mesh,
// each under any affine transform. Geometry alone: emission (and whether the back emits too) is
// the caller's, who evaluates its texture at the sampled point.
//
// Every kind has
//   sample(ref, u)                 a point on the surface with its solid-angle density at ref
//   pdf(ref, p, n, primitive)      that density for a point found otherwise (for MIS); p lies on
//                                  the surface, n is its unit front normal
//   area(), centre(), box()        world-space area; the box around it and its centre
// and `sample(...).pdf` is `pdf` at the sampled point, up to rounding. A point is sampled whether
// or not its front faces ref, since the caller may let both sides emit.
//
// Left out: sampling by projected solid angle (the BSDF's cosine is not used), and spherical
// triangles (meshes are sampled by area: a mesh light near enough to matter has many triangles).
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "base/affine.h"
#include "base/distribution.h"

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
/// Rectangles are sampled uniformly in solid angle (Urena, Fajardo and King 2013, "An
/// area-preserving parametrization for spherical rectangles"; rectangle_emitter.cpp has the form
/// used). Parallelograms, and rectangles of less than 1e-6 sr, are sampled by area.
class RectangleEmitter {
  public:
    explicit RectangleEmitter(Affine const& to_world);

    EmitterSample sample(Vec3 const& ref, Vec2 u) const;
    float pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t primitive = 0) const;
    float area() const { return area_; }
    Vec3 centre() const { return Vec3(corner_ + (edge_x_ + edge_y_) * 0.5); }
    Box box() const;
    Vec3 normal() const { return Vec3(normal_); }
    /// Steradians at `ref`, either side. Of rectangles only: NaN for other parallelograms.
    float solid_angle(Vec3 const& ref) const;

  private:
    struct View;
    View view(Vec3d const& to_corner) const;
    EmitterSample at(Vec3 const& ref, Vec2 uv) const;
    float area_pdf(Vec3 const& ref, Vec3 const& p) const;

    // In double, and rotated into the rectangle's frame: the solid angle is a difference.
    Vec3d corner_, edge_x_, edge_y_; ///< the point of uv (0, 0) and the full edges
    Vec3d axis_x_, axis_y_, normal_; ///< unit
    double length_x_, length_y_;
    double per_x_, per_y_; ///< 1 / length
    float area_;
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

    EmitterSample sample(Vec3 const& ref, Vec2 u) const;
    /// 0 also for points on the far side as seen from outside: `sample` never gives them.
    float pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t primitive = 0) const;
    float area() const { return area_; }
    Vec3 centre() const { return to_world_.origin; }
    Box box() const;

  private:
    struct View;
    View view(Vec3 const& ref) const;
    float direction_pdf(View const& v, Vec3 const& wi) const;

    Affine to_world_, to_local_;
    Affined to_local_exact_;    ///< its origin is not used: ref - centre is taken first
    float inverse_determinant_; ///< |det B|; 0 where the map is singular
    float area_;
};

/// World-space triangles, chosen by area and then sampled uniformly. Front: the side on which
/// the vertices turn counter-clockwise, or the other with `flip` (to be set where the transform
/// that made the positions mirrors), or the other of that for the triangles that are `turned`.
///
/// Triangles whose share of the area is below about 1e-7 are never sampled, and have density 0.
class MeshEmitter {
  public:
    using Triangle = std::array<uint32_t, 3>;

    MeshEmitter(std::vector<Vec3> positions, std::vector<Triangle> triangles,
                std::vector<Vec2> uvs = {}, bool flip = false, std::vector<bool> turned = {});

    /// uv is interpolated, or the barycentric weights of vertices 1 and 2 where there are none.
    EmitterSample sample(Vec3 const& ref, Vec2 u) const;
    float pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t primitive) const;
    float area() const { return area_; }
    Vec3 centre() const { return (box_.low + box_.high) * 0.5f; }
    Box box() const { return box_; }
    struct NormalCone {
        Vec3 axis{0, 0, 1}; ///< unit
        float theta = kPi;  ///< radians in [0, pi]
    };
    /// Around the normals on the front of all triangles that are no lines.
    NormalCone normals() const;

  private:
    Vec3 twice_area_normal(uint32_t primitive) const;
    float side(uint32_t primitive) const {
        return !turned_.empty() && turned_[primitive] ? -side_ : side_;
    }

    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;
    std::vector<Vec2> uvs_; ///< per position, or empty
    Distribution1D by_area_;
    Box box_{Vec3(0), Vec3(0)};
    float area_ = 0;
    float side_;               ///< +1, or -1 where flipped
    std::vector<bool> turned_; ///< per triangle, or empty
};

using Emitter = std::variant<RectangleEmitter, SphereEmitter, MeshEmitter>;

} // namespace weft::lights
