// Which closed dielectrics and media a ray is inside of.
//
// Where closed objects overlap, the one of the highest rank is what is there (Schmidt and Budge
// 2002, "Simple nested dielectrics in ray traced images"): a boundary inside of an object of higher
// rank is not seen. Ranks are the world's (WorldBuilder::rank_boundaries): two closed objects never
// share one, so that what is there does not depend on the way in. Of equal ranks (open shapes, of
// which nobody can say what they contain) the one entered last is there.
//
// The parts of one object may overlap or lie inside of each other, too. So an entry has a count,
// the winding number: a ray is inside until it has left as often as it has entered.
#pragma once

#include <algorithm>
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
    /// Objects that a ray may be in at once. One more is forgotten, and `has_overflowed` says so.
    static constexpr uint32_t kMostObjects = 31;

    MediumStack() : MediumStack(Interior()) {}
    explicit MediumStack(Interior const& outside) { entries_[0] = {outside, 1}; }
    MediumStack(MediumStack const& other) { *this = other; }
    MediumStack& operator=(MediumStack const& other) {
        size_ = other.size_;
        has_overflowed_ = other.has_overflowed_;
        std::copy_n(other.entries_.begin(), size_, entries_.begin()); // the rest says nothing
        return *this;
    }

    /// What is there now.
    Interior const& current() const {
        uint32_t best = 0;
        for (uint32_t i = 1; i < size_; ++i)
            if (entries_[i].interior.rank >= entries_[best].interior.rank) best = i;
        return entries_[best].interior;
    }

    /// Whether the boundary of an object of this rank can be seen from here: from inside, where
    /// that object is what is there; from outside, where it will be.
    bool is_visible(uint32_t object, int32_t rank) const {
        Interior const& here = current();
        return here.object == object || (rank >= here.rank && !contains(object));
    }

    /// Goes in, `times` times.
    void enter(Interior const& interior, int times = 1) {
        if (Entry* const e = find(interior.object)) {
            e->count += times;
        } else if (size_ <= kMostObjects) {
            entries_[size_++] = {interior, times};
        } else {
            has_overflowed_ = true;
        }
    }

    /// Goes out, `times` times. Of an object that was not entered as often, it goes out altogether.
    void leave(uint32_t object, int times = 1) {
        Entry* const e = find(object);
        if (!e) return;
        e->count -= times;
        if (e->count > 0) return;
        std::copy(e + 1, entries_.data() + size_, e);
        --size_;
    }

    /// Returns how often the object was entered and not left.
    int count(uint32_t object) const {
        Entry const* const e = const_cast<MediumStack*>(this)->find(object);
        return e ? e->count : 0;
    }
    bool contains(uint32_t object) const { return count(object) > 0; }

    /// Returns whether some object was forgotten on the way here.
    bool has_overflowed() const { return has_overflowed_; }

  private:
    struct Entry {
        Interior interior;
        int count; ///< at least 1
    };

    Entry* find(uint32_t object) {
        for (uint32_t i = 1; i < size_; ++i)
            if (entries_[i].interior.object == object) return &entries_[i];
        return nullptr;
    }

    union { // not initialised: the first size_ are written
        std::array<Entry, kMostObjects + 1> entries_; ///< entry 0 is the space around all
    };
    uint32_t size_ = 1;
    bool has_overflowed_ = false;
};

} // namespace weft::media
