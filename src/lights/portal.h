// Sampling an environment through windows.
//
// Bitterli, Novak and Jarosz 2015, "Portal-Masked Environment Map Sampling". In the frame of a
// rectangular portal, with the third axis towards the light, a direction w has the coordinates
//
//   alpha = atan(w_x / w_z), beta = atan(w_y / w_z),  dw = (1 - w_x^2)(1 - w_y^2) / w_z da db
//
// in which every point of the room sees the portal as a rectangle along the axes. So the map is
// tabulated once for each portal over (alpha, beta), as piecewise constant, and summed: what shines
// through is four look-ups of the sums, and a direction in proportion to it two binary searches.
//
// Of several portals one is chosen in proportion to what shines through each; the density is that
// of the mixture, so they may overlap. All are looked at: a few windows, not a facade.
//
// Left out: compensation for MIS (environment.h), and what stands in the way of a portal.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/vec.h"

namespace weft::lights {

/// A rectangle that light comes in by, seen from the side that `outward` points away from.
struct Portal {
    Vec3 centre{0, 0, 0};
    Vec3 s{1, 0, 0}, t{0, 1, 0}; ///< unit and orthogonal, along the sides
    Vec3 outward{0, 0, 1};       ///< unit, orthogonal to both, towards the light
    float half_width = 1, half_height = 1;
};

/// The map as one portal has it.
class PortalMap {
  public:
    struct Window { ///< in cells
        Vec2 low, high;
    };
    struct Sample {
        Vec3 direction{0, 0, 1}; ///< unit, in the world
        float density = 0;       ///< of the map, not yet over its integral
    };

    /// `brightness` of unit directions in the world, >= 0, looked up `lookups`^2 times in each of
    /// `resolution`^2 cells. `even`: a brightness added to all of it, so that nothing is missed
    /// between those look-ups.
    PortalMap(Portal const& portal, uint32_t resolution, uint32_t lookups, float even,
              std::function<float(Vec3 const&)> const& brightness);

    /// Where `ref` sees the portal; false from behind it.
    bool window(Vec3 const& ref, Window& w) const;
    /// Returns what shines in through the window.
    double integral(Window const& w) const;
    /// Samples in proportion to what shines in through the window, whose integral is > 0.
    Sample sample(Window const& w, Vec2 u) const;
    /// The map at a unit direction; 0 outside of the window.
    float density(Window const& w, Vec3 const& direction) const;

  private:
    double sum(double x, double y) const; ///< from 0 to (x, y)
    double cell(uint32_t x, uint32_t y) const;
    Vec2 place_of(Vec3 const& local) const; ///< in cells

    Portal portal_;
    uint32_t size_;
    std::vector<double> sums_; ///< (size + 1)^2: of all cells to the left and above
};

/// All portals of an environment.
class PortalSampler {
  public:
    struct Sample {
        Vec3 direction{0, 0, 1};
        float pdf = 0; ///< per solid angle
    };

    PortalSampler() = default;
    explicit PortalSampler(std::vector<PortalMap> maps) : maps_(std::move(maps)) {}

    bool empty() const { return maps_.empty(); }
    /// Returns what shines in at `ref` by all portals; 0 where it sees none.
    double light_at(Vec3 const& ref) const;
    /// `light`: light_at(ref), > 0.
    Sample sample(Vec3 const& ref, double light, Vec2 u) const;
    float pdf(Vec3 const& ref, double light, Vec3 const& direction) const;

  private:
    std::vector<PortalMap> maps_;
};

} // namespace weft::lights
