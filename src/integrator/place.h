// What a straight line meets at one place.
//
// Solids that touch share surfaces: a liquid the inside of its glass, stacked blocks the plane
// between them. Rounding decides which of them the ray kernel finds first, and a ray that goes on
// behind that one, past its rounding errors, goes on behind the others as well. So a place is all
// surfaces that errors of position do not tell apart from the one that was found. A ray crosses all
// of their boundaries at once, as if the gap that rounding leaves were closed, and what is to be
// seen is the change from what the ray was in to what it will be in: where water touches glass, one
// boundary of the relative index.
//
// No shape can make light. Radiance grows with the square of the index that it is in, here
// everywhere by the indices of the medium stack: in what refracts, since that is told of the
// stack's indices; behind boundaries that are not seen, by `Place::radiance_through`; and where the
// surface shows that the stack is wrong (an open mesh has let the ray out, or in), by
// `Place::radiance_here`. So what a path has lost or won is always (index at the camera / index
// here)^2, whatever it has come across.
#pragma once

#include <array>
#include <optional>

#include "media/medium_stack.h"
#include "world/world.h"

namespace weft::integrator {

/// Closed objects that a ray comes into, or out of, as it crosses a place.
class Crossings {
  public:
    static constexpr uint32_t kMost = world::NearHits::kMost;

    struct Crossing {
        media::Interior inside;
        int turns; ///< how often the ray goes in; negative: out
    };

    Crossings() {}
    Crossings(Crossings const& other) { *this = other; }
    Crossings& operator=(Crossings const& other) {
        size_ = other.size_;
        std::copy_n(other.all_.begin(), size_, all_.begin());
        return *this;
    }

    void add(media::Interior const& inside, int turns);
    /// Returns how often the ray goes into an object.
    int turns(uint32_t object) const;
    /// Brings `stack` to the other side of the place.
    void cross(media::MediumStack& stack) const;

    Crossing const* begin() const { return all_.data(); }
    Crossing const* end() const { return all_.data() + size_; }

  private:
    union { // not initialised: the first size_ are written
        std::array<Crossing, kMost> all_;
    };
    uint32_t size_ = 0;
};

/// All that a ray meets at one place.
struct Place {
    /// What is seen there. Where nothing is, any of its surfaces.
    world::Hit hit;
    bool is_seen = true;
    /// How far each coordinate of any surface there may be off; none: the one of `hit` is alone.
    std::optional<Vec3> error;
    Crossings crossings;
    float ior_outside = 1;      ///< outside of the object that is seen
    float radiance_here = 1;    ///< factor of radiance, since the medium stack was wrong
    float radiance_through = 1; ///< of what goes through without refraction
};

/// Returns what `ray` meets around its closest `hit`, which the world has found for `query` and
/// `alpha_seed`. Where `stack`, of what the ray is in, contradicts that, the geometry is right:
/// what has an outside here is left, and what has an inside is entered.
Place place_at(world::World const& world, world::Ray const& ray, world::Hit const& hit,
               world::Query query, uint32_t alpha_seed, media::MediumStack& stack);

/// Returns the point of `place.hit`. A ray that starts at it, past its errors, is past all surfaces
/// at the place.
shading::SurfacePoint point_of(world::World const& world, world::Ray const& ray,
                               Place const& place);

/// Returns the closed objects that the point `p` lies in, found by a ray from it.
media::MediumStack media_at(world::World const& world, Vec3 const& p);

} // namespace weft::integrator
