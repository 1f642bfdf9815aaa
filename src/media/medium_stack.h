// Which closed dielectrics and media a ray is inside of.
//
// Where closed objects overlap, the one of the highest rank is what is there (Schmidt and Budge
// 2002, "Simple nested dielectrics in ray traced images"): a boundary inside of an object of higher
// rank is not seen. Ranks are the world's (WorldBuilder::rank_boundaries): two closed objects never
// share one, so that what is there does not depend on the way in. Of equal ranks (open shapes, of
// which nobody can say what they contain) the one entered last is there.
#pragma once

#include <array>
#include <cstdint>

namespace weft::media {

/// What fills a closed object.
struct Interior {
    uint32_t object = UINT32_MAX; ///< which object; UINT32_MAX is the space around all
    int32_t rank = -1;            ///< at least 0 for objects
    float ior = 1;
    int32_t medium = -1; ///< index into the world's media; -1 is a vacuum
};

class MediumStack {
  public:
    MediumStack() = default;
    explicit MediumStack(Interior const& outside) { entries_[0] = outside; }

    /// What is there now.
    Interior const& current() const { return entries_[top()]; }

    /// What would be there outside of `object`.
    Interior const& current_without(uint32_t object) const { return entries_[top(object)]; }

    /// Whether the boundary of an object of this rank can be seen from here: from inside, where
    /// that object is what is there; from outside, where it will be.
    bool is_visible(uint32_t object, int32_t rank) const {
        Interior const& here = current();
        return here.object == object || (rank >= here.rank && !contains(object));
    }

    /// Goes in. A full stack (more than 7 nested objects) forgets the object.
    void enter(Interior const& interior) {
        leave(interior.object); // a second entry without a leave: not a closed shape, or rounding
        if (size_ < entries_.size()) entries_[size_++] = interior;
    }

    /// Goes out; an object that was never entered (an open shape, or a camera inside of it) is
    /// ignored.
    void leave(uint32_t object) {
        for (uint32_t i = 1; i < size_; ++i) {
            if (entries_[i].object != object) continue;
            for (uint32_t k = i + 1; k < size_; ++k) entries_[k - 1] = entries_[k];
            --size_;
            return;
        }
    }

    bool contains(uint32_t object) const {
        for (uint32_t i = 1; i < size_; ++i)
            if (entries_[i].object == object) return true;
        return false;
    }

  private:
    uint32_t top(uint32_t without = UINT32_MAX - 1) const {
        uint32_t best = 0;
        for (uint32_t i = 1; i < size_; ++i)
            if (entries_[i].object != without && entries_[i].rank >= entries_[best].rank) best = i;
        return best;
    }

    std::array<Interior, 8> entries_{}; ///< entry 0 is the space around all
    uint32_t size_ = 1;
};

} // namespace weft::media
