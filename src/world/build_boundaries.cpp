// The half of WorldBuilder that says what is there where closed objects overlap.
#include <numbers>
#include <tuple>

#include "world/world_builder.h"

namespace weft::world {

namespace {

/// What a boundary encloses, in world space.
struct Enclosed {
    uint32_t object;
    Vec3d low{double(kInfinity)}, high{-double(kInfinity)};
    double volume = 0;
    bool closed = true;

    void grow(Vec3d const& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    bool overlaps(Enclosed const& o) const {
        return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
               low.z <= o.high.z && o.low.z <= high.z;
    }
};

void enclose_sphere(Affined const& m, Enclosed& e) {
    auto const reach = [](double x, double y, double z) {
        return std::sqrt(x * x + y * y + z * z);
    };
    Vec3d const extent(reach(m.x.x, m.y.x, m.z.x), reach(m.x.y, m.y.y, m.z.y),
                       reach(m.x.z, m.y.z, m.z.z));
    e.grow(m.origin - extent);
    e.grow(m.origin + extent);
    e.volume = 4 * std::numbers::pi / 3 * std::abs(m.determinant());
}

void enclose_disk(Affined const& m, Enclosed& e) {
    for (double x : {-1.0, 1.0})
        for (double y : {-1.0, 1.0}) e.grow(m.point({x, y, 0}));
    e.closed = false;
}

/// The divergence theorem: of a closed surface the sum of areas as vectors is 0, and that of
/// p . area / 3 is the volume.
void enclose_mesh(TriangleData const& data, Affined const& m, Enclosed& e) {
    Vec3d areas(0);
    double total = 0;
    if (data.vertices.empty()) return;
    Vec3d const reference = m.point(Vec3d(data.vertices[0].p));
    for (auto const& t : data.source->triangles) {
        Vec3d corner[3];
        for (int i = 0; i < 3; ++i) {
            Vec3d const p = m.point(Vec3d(data.vertices[t.v[i]].p));
            e.grow(p);
            corner[i] = p - reference;
        }
        Vec3d const area = cross(corner[1] - corner[0], corner[2] - corner[0]);
        areas = areas + area;
        total += length(area);
        e.volume += dot(corner[0], area) / 6;
    }
    e.volume = std::abs(e.volume);
    e.closed = length(areas) <= 1e-3 * total;
}

} // namespace

void WorldBuilder::rank_boundaries() {
    std::vector<Enclosed> all;
    for (uint32_t i = 0; i < world_.objects_.size(); ++i) {
        Object const& o = world_.objects_[i];
        if (!o.has_interior) continue;
        Enclosed& e = all.emplace_back();
        e.object = i;
        if (o.kind == ObjectKind::Sphere)
            enclose_sphere(Affined(o.to_world), e);
        else if (o.kind == ObjectKind::Disk)
            enclose_disk(Affined(o.to_world), e);
        else
            enclose_mesh(world_.triangles_[size_t(o.triangles)],
                         o.instanced ? Affined(o.to_world) : Affined(), e);
    }
    auto const key = [&](Enclosed const& e) {
        return std::tuple(world_.objects_[e.object].priority, e.closed, e.closed ? -e.volume : 0.0,
                          e.closed ? -int64_t(e.object) : 0);
    };
    std::sort(all.begin(), all.end(),
              [&](Enclosed const& a, Enclosed const& b) { return key(a) < key(b); });
    for (size_t i = 0; i < all.size(); ++i) {
        bool const same = i > 0 && key(all[i]) == key(all[i - 1]);
        world_.objects_[all[i].object].rank =
            same ? world_.objects_[all[i - 1].object].rank : int32_t(i);
    }
    // Which of them can lie inside of something that hides them? A sweep along x.
    std::sort(all.begin(), all.end(),
              [](Enclosed const& a, Enclosed const& b) { return a.low.x < b.low.x; });
    for (size_t i = 0; i < all.size(); ++i)
        for (size_t k = i + 1; k < all.size() && all[k].low.x <= all[i].high.x; ++k) {
            if (!all[i].overlaps(all[k])) continue;
            Object &a = world_.objects_[all[i].object], &b = world_.objects_[all[k].object];
            a.may_be_hidden |= a.rank <= b.rank;
            b.may_be_hidden |= b.rank <= a.rank;
        }
    for (Object const& o : world_.objects_) world_.has_media_ |= o.may_be_hidden;
}

} // namespace weft::world
