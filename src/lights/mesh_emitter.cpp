#include <cassert>

#include "lights/emitter_geometry.h"
#include "lights/spherical_triangle.h"

namespace weft::lights {

namespace {} // namespace

MeshEmitter::MeshEmitter(std::vector<Vec3> positions, std::vector<Triangle> triangles,
                         std::vector<Vec2> uvs, bool flip, std::vector<bool> turned)
    : positions_(std::move(positions)), triangles_(std::move(triangles)), uvs_(std::move(uvs)),
      side_(flip ? -1.f : 1.f), turned_(std::move(turned)) {
    assert(turned_.empty() || turned_.size() == triangles_.size());
    assert(uvs_.empty() || uvs_.size() == positions_.size());
    if (triangles_.empty()) return;
    double sum = 0; // a million small areas must not round away
    box_ = box(0);
    for (uint32_t i = 0; i < triangles_.size(); ++i) {
        sum += double(area(i));
        Box const b = box(i);
        box_ = {min(box_.low, b.low), max(box_.high, b.high)};
    }
    area_ = float(sum);
}

Box MeshEmitter::box(uint32_t primitive) const {
    Triangle const& t = triangles_[primitive];
    Vec3 const &a = positions_[t[0]], &b = positions_[t[1]], &c = positions_[t[2]];
    return {min(min(a, b), c), max(max(a, b), c)};
}

Vec3 MeshEmitter::twice_area_normal(uint32_t primitive) const {
    Triangle const& t = triangles_[primitive];
    Vec3 const& a = positions_[t[0]];
    return cross(positions_[t[1]] - a, positions_[t[2]] - a);
}

Vec3 MeshEmitter::point(uint32_t primitive, Vec2 b) const {
    Triangle const& t = triangles_[primitive];
    Vec3 const& a = positions_[t[0]];
    return a + (positions_[t[1]] - a) * b.x + (positions_[t[2]] - a) * b.y;
}

Vec2 MeshEmitter::uv(uint32_t primitive, Vec2 b) const {
    if (uvs_.empty()) return b;
    Triangle const& t = triangles_[primitive];
    return uvs_[t[0]] * (1 - b.x - b.y) + uvs_[t[1]] * b.x + uvs_[t[2]] * b.y;
}

EmitterSample MeshEmitter::sample(Vec3 const& ref, Vec2 u, uint32_t primitive) const {
    EmitterSample s;
    assert(primitive < triangles_.size());
    Triangle const& t = triangles_[primitive];
    Vec3 const& a = positions_[t[0]];
    Vec3 const e1 = positions_[t[1]] - a, e2 = positions_[t[2]] - a, c = cross(e1, e2);
    float const twice_area = length(c);
    if (!(twice_area > 0)) return s;
    TriangleView const view(Vec3d(a) - Vec3d(ref), Vec3d(e1), Vec3d(e2));
    Vec2 const b = view.sample(u);
    s.p = point(primitive, b);
    s.n = c * (side(primitive) / twice_area);
    s.primitive = primitive;
    s.uv = uv(primitive, b);
    Vec3 const d = s.p - ref;
    s.distance = length(d);
    if (!(s.distance > 0)) return s;
    s.wi = d * (1 / s.distance);
    s.pdf = view.pdf(s.distance);
    return s;
}

float MeshEmitter::pdf(Vec3 const& ref, Vec3 const& p, Vec3 const&, uint32_t primitive) const {
    assert(primitive < triangles_.size());
    Triangle const& t = triangles_[primitive];
    Vec3 const& a = positions_[t[0]];
    Vec3 const e1 = positions_[t[1]] - a, e2 = positions_[t[2]] - a;
    if (!(length_squared(cross(e1, e2)) > 0)) return 0;
    return TriangleView(Vec3d(a) - Vec3d(ref), Vec3d(e1), Vec3d(e2)).pdf(length(p - ref));
}

} // namespace weft::lights
