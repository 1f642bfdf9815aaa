// The half of the light tree that makes it.
#include <algorithm>
#include <cassert>
#include <numeric>

#include "lights/light_tree.h"

namespace weft::lights {

namespace {

constexpr uint32_t kBins = 12;
/// From this level on nodes are cut in equal numbers, so that every trail fits into its 64 bits.
constexpr uint32_t kBalancedLevel = 14;
/// Cosines computed from cosines have lost half of their digits near 1.
constexpr float kSlack = 1e-3f;

/// M_A M_Omega times power: what a part of the lights costs.
float cost(LightBounds const& b) { return b.power * orientation_measure(b) * b.diagonal_squared(); }

struct Split {
    float cost = kInfinity;
    int axis = -1;
    uint32_t bin = 0; ///< the first on the upper side
};

uint32_t bin_of(float x, float low, float high) {
    return std::min(uint32_t(float(kBins) * ((x - low) / (high - low))), kBins - 1);
}

/// Lights whose centres are in one part of an axis. A bound of their axes' cone takes a second
/// pass.
struct Bin {
    Vec3 low{kInfinity}, high{-kInfinity}, axes{0, 0, 0};
    float power = 0, theta_o = 0, theta_e = 0, least_cos = 1;
    uint32_t count = 0;

    void add(LightBounds const& b) {
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], b.low[k]);
            high[k] = std::max(high[k], b.high[k]);
        }
        axes += b.axis;
        power += b.power;
        theta_o = std::max(theta_o, b.theta_o);
        theta_e = std::max(theta_e, b.theta_e);
        ++count;
    }
    void find_axis() {
        float const l = length(axes);
        axes = l > 1e-3f * float(count) ? axes * (1 / l) : Vec3(0, 0, 1);
    }
    LightBounds bounds() const {
        float const theta = std::acos(std::clamp(least_cos, -1.f, 1.f)) + theta_o;
        return {low, high, axes, std::min(theta, kPi), theta_e, power};
    }
};
using Bins = std::array<Bin, kBins>;

} // namespace

/// Lights `begin` to `end` of an order that the build changes, and their bounds.
struct LightTree::Builder {
    struct Part {
        uint32_t begin, end;
        LightBounds bounds;
        uint32_t count() const { return end - begin; }
    };

    LightTree& tree;
    std::vector<LightBounds> lights; ///< in the order of `index`
    std::vector<uint32_t> index;     ///< of the caller
    float per_intensity = 1;         ///< 1 / the greatest
    float least_radius = 1;

    Part part(uint32_t begin, uint32_t end) const {
        return {begin, end, unite(std::span(lights).subspan(begin, end - begin))};
    }

    std::array<Bins, 3> fill_bins(Part const& p, Vec3 const& low, Vec3 const& high) const;
    Split best_split(Part const& p, Vec3 const& low, Vec3 const& high) const;
    std::array<Part, 2> cut(Part const& p, bool balanced);
    uint32_t partition(Part const& p, Split const& split, float low, float high);
    uint32_t build(Part const& p, uint32_t level, uint64_t trail);
    void set_child(Node& node, uint32_t k, LightBounds const& bounds) const;
};

/// Along each axis on which the centres differ, from `low` to `high`.
std::array<Bins, 3> LightTree::Builder::fill_bins(Part const& p, Vec3 const& low,
                                                  Vec3 const& high) const {
    std::array<Bins, 3> bins;
    auto for_all = [&](auto&& f) {
        for (uint32_t i = p.begin; i < p.end; ++i) {
            Vec3 const centre = lights[i].centre();
            for (int axis = 0; axis < 3; ++axis)
                if (high[axis] > low[axis])
                    f(bins[size_t(axis)][bin_of(centre[axis], low[axis], high[axis])], lights[i]);
        }
    };
    for_all([](Bin& bin, LightBounds const& light) { bin.add(light); });
    for (Bins& of_axis : bins)
        for (Bin& bin : of_axis) bin.find_axis();
    for_all([](Bin& bin, LightBounds const& light) {
        bin.least_cos = std::min(bin.least_cos, dot(bin.axes, light.axis));
    });
    return bins;
}

/// The best cut between bins of the centres.
Split LightTree::Builder::best_split(Part const& p, Vec3 const& low, Vec3 const& high) const {
    Split best;
    auto const all = fill_bins(p, low, high);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(high[axis] > low[axis])) continue;
        Bins const& bins = all[size_t(axis)];
        std::array<float, kBins> below{}; // cost of the bins before
        LightBounds sum;
        float sum_cost = 0;
        auto add = [&](uint32_t b) {
            if (bins[b].count == 0) return;
            sum = sum_cost > 0 ? unite(sum, bins[b].bounds()) : bins[b].bounds();
            sum_cost = std::max(cost(sum), std::numeric_limits<float>::min());
        };
        for (uint32_t b = 0; b + 1 < kBins; ++b) {
            add(b);
            below[b + 1] = sum_cost;
        }
        sum_cost = 0;
        float const regular = // long nodes are cut across
            max_component(high - low) / (high[axis] - low[axis]);
        for (uint32_t b = kBins - 1; b > 0; --b) {
            add(b);
            float const c = regular * (below[b] + sum_cost);
            if (bins[b].count > 0 && c < best.cost) best = {c, axis, b};
        }
    }
    return best;
}

uint32_t LightTree::Builder::partition(Part const& p, Split const& split, float low, float high) {
    // Stable, so that the tree depends on the order of the lights alone.
    std::vector<LightBounds> upper_lights;
    std::vector<uint32_t> upper;
    uint32_t middle = p.begin;
    for (uint32_t i = p.begin; i < p.end; ++i) {
        if (bin_of(lights[i].centre()[split.axis], low, high) >= split.bin) {
            upper_lights.push_back(lights[i]);
            upper.push_back(index[i]);
        } else {
            lights[middle] = lights[i];
            index[middle++] = index[i];
        }
    }
    std::copy(upper_lights.begin(), upper_lights.end(), lights.begin() + middle);
    std::copy(upper.begin(), upper.end(), index.begin() + middle);
    return middle;
}

std::array<LightTree::Builder::Part, 2> LightTree::Builder::cut(Part const& p, bool balanced) {
    Vec3 low(kInfinity), high(-kInfinity);
    for (uint32_t i = p.begin; i < p.end; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            float const centre = lights[i].centre()[axis];
            low[axis] = std::min(low[axis], centre);
            high[axis] = std::max(high[axis], centre);
        }
    Split best;
    if (!balanced && p.count() > 2) best = best_split(p, low, high);
    uint32_t middle = p.begin + p.count() / 2; // where all are in one place
    if (best.axis >= 0) middle = partition(p, best, low[best.axis], high[best.axis]);
    return {part(p.begin, middle), part(middle, p.end)};
}

void LightTree::Builder::set_child(Node& node, uint32_t k, LightBounds const& b) const {
    Vec3 const centre = b.centre();
    node.x[k] = centre.x;
    node.y[k] = centre.y;
    node.z[k] = centre.z;
    node.radius[k] = std::max(0.5f * std::sqrt(b.diagonal_squared()), least_radius);
    node.axis_x[k] = b.axis.x;
    node.axis_y[k] = b.axis.y;
    node.axis_z[k] = b.axis.z;
    node.cos_o[k] = std::cos(b.theta_o);
    node.sin_o[k] = std::sin(b.theta_o);
    node.cos_e[k] = std::cos(b.theta_e) - kSlack;
    node.intensity[k] = b.power / orientation_measure(b) * per_intensity;
}

/// Makes the node of `p`, or the leaf; returns its name as in `Node::child`.
uint32_t LightTree::Builder::build(Part const& p, uint32_t level, uint64_t trail) {
    if (p.count() == 1) {
        tree.places_[index[p.begin]] = {trail, 0};
        return index[p.begin] | kLeaf;
    }
    bool const balanced = level >= kBalancedLevel;
    std::vector<Part> children{p};
    while (children.size() < kWidth) {
        // The costliest first, or the largest.
        auto const worst =
            std::max_element(children.begin(), children.end(), [&](Part const& a, Part const& b) {
                if ((a.count() > 1) != (b.count() > 1)) return b.count() > 1;
                float const cost_a = balanced ? 0 : cost(a.bounds);
                float const cost_b = balanced ? 0 : cost(b.bounds);
                return cost_a != cost_b ? cost_a < cost_b : a.count() < b.count();
            });
        if (worst->count() == 1) break;
        auto const halves = cut(*worst, balanced);
        *worst = halves[0];
        children.insert(worst + 1, halves[1]);
    }
    uint32_t const node = uint32_t(tree.nodes_.size());
    tree.nodes_.emplace_back();
    for (uint32_t k = 0; k < children.size(); ++k) {
        uint32_t const child = build(children[k], level + 1, trail | uint64_t(k) << (2 * level));
        tree.nodes_[node].child[k] = child;
        set_child(tree.nodes_[node], k, children[k].bounds);
    }
    return node;
}

LightTree::LightTree(std::span<LightBounds const> lights) : places_(lights.size()) {
    double sum = 0;
    uint32_t positive = 0;
    for (LightBounds const& b : lights) {
        assert(b.power >= 0 && std::isfinite(b.power));
        sum += double(b.power);
        positive += b.power > 0;
    }
    if (positive == 0) return;
    float const least = float(1e-3 * sum / positive);
    Builder builder{*this, {}, {}};
    std::vector<float> top, weights;
    float greatest = 0;
    for (uint32_t i = 0; i < lights.size(); ++i) {
        LightBounds b = lights[i];
        if (!(b.power > 0)) continue;
        b.power = std::max(b.power, least);
        if (b.at_infinity) {
            infinite_.push_back(i);
            top.push_back(b.power);
            weights.push_back(b.weight);
            continue;
        }
        builder.lights.push_back(b);
        builder.index.push_back(i);
        greatest = std::max(greatest, b.power / orientation_measure(b));
    }
    if (!builder.lights.empty()) {
        Builder::Part const all = builder.part(0, uint32_t(builder.lights.size()));
        float const radius = 0.5f * std::sqrt(all.bounds.diagonal_squared());
        // Far below the distance of any two lights that matter, but squares of it are normal.
        builder.least_radius = std::max(1e-6f * radius, 1e-12f);
        builder.per_intensity = 1 / greatest;
        top.insert(top.begin(), all.bounds.power);
        float weight = 0;
        for (LightBounds const& b : builder.lights) weight = std::max(weight, b.weight);
        weights.insert(weights.begin(), weight);
        first_infinite_ = 1;
        root_ = builder.build(all, 0, 0);
    }
    for (uint32_t k = 0; k < infinite_.size(); ++k)
        places_[infinite_[k]].entry = first_infinite_ + k;
    float const power = std::accumulate(top.begin(), top.end(), 0.f),
                weight = std::accumulate(weights.begin(), weights.end(), 0.f);
    for (size_t k = 0; k < top.size(); ++k)
        top[k] = 0.5f * top[k] / power + 0.5f * weights[k] / weight;
    top_ = Distribution1D(top);
}

} // namespace weft::lights
