#include <cassert>

#include "base/warp.h"
#include "lights/emitter_geometry.h"

namespace weft::lights {

MeshEmitter::MeshEmitter(std::vector<Vec3> positions, std::vector<Triangle> triangles,
                         std::vector<Vec2> uvs, bool flip, std::vector<bool> turned)
    : positions_(std::move(positions)), triangles_(std::move(triangles)), uvs_(std::move(uvs)),
      side_(flip ? -1.f : 1.f), turned_(std::move(turned)) {
    assert(turned_.empty() || turned_.size() == triangles_.size());
    assert(uvs_.empty() || uvs_.size() == positions_.size());
    if (triangles_.empty()) return;
    std::vector<float> areas(triangles_.size());
    Vec3 low(kInfinity), high(-kInfinity);
    for (uint32_t i = 0; i < triangles_.size(); ++i) {
        areas[i] = 0.5f * length(twice_area_normal(i));
        for (uint32_t vertex : triangles_[i]) {
            Vec3 const& p = positions_[vertex];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    }
    by_area_ = Distribution1D(areas);
    area_ = by_area_.total();
    box_ = {low, high};
}

Vec3 MeshEmitter::twice_area_normal(uint32_t primitive) const {
    Triangle const& t = triangles_[primitive];
    Vec3 const& a = positions_[t[0]];
    return cross(positions_[t[1]] - a, positions_[t[2]] - a);
}

MeshEmitter::NormalCone MeshEmitter::normals() const {
    Vec3 sum(0);
    for (uint32_t i = 0; i < triangles_.size(); ++i) sum += twice_area_normal(i) * side(i);
    NormalCone cone;
    if (!(length(sum) > 1e-3f * area_)) return cone; // closed, or nearly so
    cone = {normalize(sum), 0};
    for (uint32_t i = 0; i < triangles_.size(); ++i) {
        Vec3 const n = twice_area_normal(i) * side(i);
        if (!(length_squared(n) > 0)) continue;
        cone.theta =
            std::max(cone.theta, std::atan2(length(cross(cone.axis, n)), dot(cone.axis, n)));
    }
    return cone;
}

EmitterSample MeshEmitter::sample(Vec3 const& ref, Vec2 u) const {
    EmitterSample s;
    if (!(area_ > 0)) return s;
    Distribution1D::Choice const choice = by_area_.choose(u.x);
    Triangle const& t = triangles_[choice.index];
    Vec3 const& a = positions_[t[0]];
    Vec3 const e1 = positions_[t[1]] - a, e2 = positions_[t[2]] - a, c = cross(e1, e2);
    Vec2 const b = square_to_triangle({choice.u, u.y});
    s.p = a + e1 * b.x + e2 * b.y;
    float const twice_area = length(c);
    s.n = c * (side(choice.index) / twice_area);
    s.primitive = choice.index;
    s.uv = uvs_.empty() ? b : uvs_[t[0]] * (1 - b.x - b.y) + uvs_[t[1]] * b.x + uvs_[t[2]] * b.y;
    Vec3 const d = s.p - ref;
    s.distance = length(d);
    if (!(s.distance > 0)) return s;
    s.wi = d * (1 / s.distance);
    float const cosine_by = std::abs(dot(s.n, s.wi)) * 0.5f * twice_area;
    s.pdf = cosine_by > 0 ? choice.probability * square(s.distance) / cosine_by : 0;
    return s;
}

float MeshEmitter::pdf(Vec3 const& ref, Vec3 const& p, Vec3 const& n, uint32_t primitive) const {
    if (!(area_ > 0)) return 0;
    assert(primitive < triangles_.size());
    Vec3 const d = p - ref;
    float const d2 = length_squared(d);
    float const cosine_by =
        std::abs(dot(n, d)) * 0.5f * length(twice_area_normal(primitive)); // times |d|
    return cosine_by > 0 ? by_area_.probability(primitive) * d2 * std::sqrt(d2) / cosine_by : 0;
}

} // namespace weft::lights
