// Which light to sample, given the point to be lit: a tree over the lights that are somewhere.
//
// Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".
// A leaf is one light; a node holds the bounds of up to four children, and the walk down chooses
// one in proportion to its importance, a bound in all but the distance (which is the centre's):
//
//   I cos(theta') max(cos(theta_i'), 1/16) / max(d^2, r^2)
//
//   I          intensity: power / M_Omega (light_bounds.h), so that lamps of all kinds compare
//   r, d       radius of the sphere around the box, and distance of its centre; inside the
//              sphere the angles below are 0
//   theta'     how far the point is outside of the cone of normals. With x = max(0, theta -
//              theta_o) and sin b = r / d, cos(x - b) <= cos x + sin b (1 + max(0, -cos x)), which
//              saves two roots; 0 beyond theta_e, where none of the lights shines
//   theta_i'   between the point's normal and the light, likewise, on either side since surfaces
//              transmit; 0 without a normal. The 1/16: parts of a material may have normals of
//              their own, and hairs scatter along the cosine to another plane.
//
// Of children that may contribute each gets at least 1/1024 of a node's choices. Where none can,
// nothing is chosen: the probabilities sum to 1 less the chance of that.
//
// The lights at infinity are beside the root: half of the choices among them and the tree go by
// power, half evenly (by the user's weights), since power does not say what gets in: a sun outside
// of a room with a few candles would leave those one sample in a thousand.
//
// Built from the top: the costliest part of a node's lights is cut in two until there are four,
// whose importances are computed side by side. Cuts are those of least cost by the surface area
// orientation heuristic, power x M_Omega x area on either side, over 12 bins of the centres on each
// axis. The sphere's r^2 stands for the area, as that is what the importance divides by: it tells
// lights on a line apart, too.
//
// What the caller calls a light may be a part of one: meshes have a leaf for each triangle. A leaf
// takes about 110 bytes.
//
// Adaptive splitting: the numbers (i + u) / n, i < n, go down together. Each branch is taken by as
// many of them as its probability times n, rounded up or down at random (systematic sampling), so
// that a node is split where n choices tell its children apart, and lights of one choice's worth
// and more are there for certain. Those that two numbers arrive at are taken once: near one light
// that outshines all others, fewer are chosen than where many matter. The paper splits by bounds of
// the error of a cluster instead; choices in proportion to the importance are those of least
// variance per shadow ray where the importance is true, and need no second measure.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/distribution.h"
#include "lights/light_bounds.h"

namespace weft::lights {

class LightTree {
  public:
    struct Choice {
        uint32_t index = 0;    ///< into the lights
        float probability = 0; ///< 0: there is no light that reaches the point
        float u_rest = 0;      ///< the random number, stretched back to [0, 1)
    };

    LightTree() = default;
    /// A light of power 0 is never chosen. No positive power is negligible, as it may be a rough
    /// estimate: each counts as at least a thousandth of the mean of the positive ones. A single
    /// light at a finite place is chosen without looking at it.
    explicit LightTree(std::span<LightBounds const> lights);

    size_t memory_bytes() const {
        return nodes_.size() * sizeof(Node) + places_.size() * sizeof(Place);
    }
    /// Returns whether no light has a positive power.
    bool empty() const { return root_ == kNone && infinite_.empty(); }
    /// `ref`: the point to be lit; `normal`: its unit normal, or 0 in a medium; u in [0, 1). A
    /// float has too few digits to tell a million lights apart.
    Choice choose(Vec3 const& ref, Vec3 const& normal, double u) const;
    /// Returns the chance that `choose` gives the light `index`: the same to the last bit.
    float probability(Vec3 const& ref, Vec3 const& normal, uint32_t index) const;

    /// Splitting: up to `count` different lights, each handed to f(Choice) with the chance that it
    /// is among them as its probability. With a count of 1 that is `choose`.
    template <class F>
    void choose_each(Vec3 const& ref, Vec3 const& normal, double u, uint32_t count, F&& f) const {
        uint32_t last = kNone;
        for (uint32_t i = 0; i < count; ++i) {
            Choice c = choose(ref, normal, (double(i) + u) / double(count));
            if (!(c.probability > 0) || c.index == last) continue;
            last = c.index;
            c.probability = chance_of_several(c.probability, count);
            f(c);
        }
    }
    /// Returns the chance that `choose_each` gives the light `index`.
    float probability(Vec3 const& ref, Vec3 const& normal, uint32_t index, uint32_t count) const {
        return chance_of_several(probability(ref, normal, index), count);
    }

  private:
    static float chance_of_several(float probability, uint32_t count) {
        return std::min(float(count) * probability, 1.f);
    }

    static constexpr uint32_t kWidth = 4; ///< children of a node
    using Four = std::array<float, kWidth>;

    /// Of each child 48 bytes, in columns; empty slots have intensity 0.
    struct alignas(64) Node {
        Four x{}, y{}, z{}, radius{}; ///< the sphere around the box; radius > 0
        Four axis_x{}, axis_y{}, axis_z{};
        Four cos_o{}, sin_o{}, cos_e{}; ///< cos_e is less by the slack for rounding
        Four intensity{};               ///< over the greatest of all lights
        std::array<uint32_t, kWidth> child{};
    };
    /// The path to a light: two bits per level from the lowest, and which of `top_` it is in.
    struct Place {
        uint64_t trail = 0;
        uint32_t entry = kNone;
    };
    struct Builder;

    static constexpr uint32_t kLeaf = 0x80000000u; ///< set: the rest is a light, else a node
    static constexpr uint32_t kNone = 0xffffffffu;

    static Four importances(Node const& node, Vec3 const& ref, Vec3 const& normal, float& total);

    std::vector<Node> nodes_;
    std::vector<Place> places_;      ///< per light
    std::vector<uint32_t> infinite_; ///< lights
    Distribution1D top_;             ///< the tree, if there is one, and the infinite lights
    uint32_t root_ = kNone;
    uint32_t first_infinite_ = 0; ///< entry of `top_`: 1 where there is a tree
};

} // namespace weft::lights
