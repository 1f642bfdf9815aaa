// The part of WorldBuilder that says what is there where closed objects overlap.
#include <algorithm>
#include <tuple>

#include "base/match.h"
#include "world/solidity.h"
#include "world/world_builder.h"

namespace weft::world {

namespace {

struct Boundary {
    uint32_t object;
    int priority;
    Enclosure enclosed;

    /// Orders boundaries from those that yield to those that are there.
    auto key() const {
        bool const closed = enclosed.closed;
        return std::tuple(priority, closed, closed ? -enclosed.volume : 0.0,
                          closed ? -int64_t(object) : 0);
    }
    bool overlaps(Boundary const& other) const {
        Enclosure const &a = enclosed, &b = other.enclosed;
        return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
               b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
    }
};

/// Returns an enclosure whose box has room for what rounding does: boxes that touch overlap.
Enclosure with_margin(Enclosure e) {
    auto const largest = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
    double const margin =
        kRounding * std::max({largest(e.low.x, e.high.x), largest(e.low.y, e.high.y),
                              largest(e.low.z, e.high.z)});
    e.low = e.low - Vec3d(margin);
    e.high = e.high + Vec3d(margin);
    return e;
}

} // namespace

void WorldBuilder::rank_boundaries() {
    std::vector<Boundary> all;
    for (uint32_t i = 0; i < world_.object_count(); ++i) {
        Model const& m = world_.model(i);
        if (!m.has_interior) continue;
        world_.has_interiors_ = true;
        Affined const to_world =
            m.in_world_space ? Affined() : Affined(world_.space_of(i).to_world);
        Enclosure const enclosed =
            match(m.geometry, [&](auto const& g) { return enclosure(g, to_world); });
        all.push_back({i, m.traits.priority, with_margin(enclosed)});
    }
    for (Model& m : world_.models_) {
        if (!m.has_interior) continue;
        Solidity const s = match(m.geometry, [](auto const& g) { return solidity(g); });
        m.has_parts = s.has_parts && s.open_edges == 0;
    }
    std::sort(all.begin(), all.end(),
              [](Boundary const& a, Boundary const& b) { return a.key() < b.key(); });
    for (size_t i = 0; i < all.size(); ++i) {
        bool const same = i > 0 && all[i].key() == all[i - 1].key();
        world_.objects_[all[i].object].rank =
            same ? world_.objects_[all[i - 1].object].rank : int32_t(i);
    }
    // Which of them can lie inside of something that hides them? A sweep along x.
    std::sort(all.begin(), all.end(), [](Boundary const& a, Boundary const& b) {
        return a.enclosed.low.x < b.enclosed.low.x;
    });
    for (size_t i = 0; i < all.size(); ++i)
        for (size_t k = i + 1; k < all.size() && all[k].enclosed.low.x <= all[i].enclosed.high.x;
             ++k) {
            if (!all[i].overlaps(all[k])) continue;
            Object &a = world_.objects_[all[i].object], &b = world_.objects_[all[k].object];
            if (a.rank <= b.rank) a.may_be_hidden = true;
            if (b.rank <= a.rank) b.may_be_hidden = true;
        }
    for (Object const& o : world_.objects_) world_.has_media_ |= bool(o.may_be_hidden);
}

} // namespace weft::world
