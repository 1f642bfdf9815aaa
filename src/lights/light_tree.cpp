#include "lights/light_tree.h"

#include "base/feature.h"

namespace weft::lights {

namespace {

constexpr float kLeastCosine = 1.f / 16; ///< at the point to be lit
constexpr float kLeastEmission = 1e-3f;  ///< cos(theta') within the slack of the cone's edge
constexpr float kLeastShare = 1.f / 1024;

} // namespace

LightTree::Four LightTree::importances(Node const& node, Vec3 const& ref, Vec3 const& normal,
                                       float& total) {
    float const without_normal = length_squared(normal) > 0 ? 0.f : 1.f;
    Four result;
    for (uint32_t k = 0; k < kWidth; ++k) {
        float const dx = node.x[k] - ref.x, dy = node.y[k] - ref.y, dz = node.z[k] - ref.z;
        float const d2 = std::max(dx * dx + dy * dy + dz * dz, node.radius[k] * node.radius[k]);
        float const per_d = 1 / std::sqrt(d2);
        float const sin_b = node.radius[k] * per_d;
        float const cos_w =
            -(node.axis_x[k] * dx + node.axis_y[k] * dy + node.axis_z[k] * dz) * per_d;
        float const sin_w = std::sqrt(std::max(1 - cos_w * cos_w, 0.f));
        float const beyond = cos_w * node.cos_o[k] + sin_w * node.sin_o[k];
        float const cos_x = cos_w >= node.cos_o[k] ? 1.f : beyond;
        float const bound = cos_x + sin_b * (1 + std::max(-cos_x, 0.f));
        float const shines = bound >= node.cos_e[k] ? 1.f : 0.f;
        float const emitted = shines * std::min(std::max(bound, kLeastEmission), 1.f);
        float const cos_i = std::abs(normal.x * dx + normal.y * dy + normal.z * dz) * per_d + sin_b;
        float const received = std::min(std::max(cos_i, kLeastCosine) + without_normal, 1.f);
        result[k] = node.intensity[k] * emitted * received * (per_d * per_d);
    }
    float const least = kLeastShare * ((result[0] + result[1]) + (result[2] + result[3]));
    for (uint32_t k = 0; k < kWidth; ++k)
        result[k] = result[k] > 0 ? std::max(result[k], least) : 0.f;
    total = ((result[0] + result[1]) + result[2]) + result[3];
    return result;
}

LightTree::Choice LightTree::choose(Vec3 const& ref, Vec3 const& normal, double u) const {
    float probability = 1;
    if (!infinite_.empty()) {
        float const coarse = std::min(float(std::floor(u * 0x1p24) * 0x1p-24), kOneMinusEpsilon);
        Distribution1D::Choice const c = top_.choose(coarse);
        if (c.index >= first_infinite_)
            return {infinite_[c.index - first_infinite_], c.probability, c.u};
        probability = c.probability;
        u = double(c.u) + (u - double(coarse)) / double(probability);
    } else if (root_ == kNone) {
        return {};
    }
    // A single light is no choice.
    if (root_ & kLeaf) return {root_ & ~kLeaf, probability, std::min(float(u), kOneMinusEpsilon)};
    FeatureScope const scope(Feature::LightChoice);
    uint32_t at = root_;
    while (!(at & kLeaf)) {
        Node const& node = nodes_[at];
        float total;
        Four const share = importances(node, ref, normal, total);
        if (!(total > 0)) return {};
        // Children without a share are passed over: target < total, in the same order of adding.
        double const target = u * double(total);
        Four const before{0, share[0], share[0] + share[1], (share[0] + share[1]) + share[2]};
        uint32_t const chosen = uint32_t(target >= double(before[1])) +
                                uint32_t(target >= double(before[2])) +
                                uint32_t(target >= double(before[3]));
        u = (target - double(before[chosen])) / double(share[chosen]);
        u = std::min(std::max(u, 0.0), 0x1.fffffffffffffp-1);
        probability *= share[chosen] / total;
        at = node.child[chosen];
    }
    return {at & ~kLeaf, probability, std::min(float(u), kOneMinusEpsilon)};
}

float LightTree::probability(Vec3 const& ref, Vec3 const& normal, uint32_t index) const {
    if (index >= places_.size() || places_[index].entry == kNone) return 0;
    Place const& place = places_[index];
    float probability = infinite_.empty() ? 1.f : top_.probability(place.entry);
    if (place.entry >= first_infinite_) return probability;
    if (root_ & kLeaf) return probability;
    FeatureScope const scope(Feature::LightChoice);
    uint64_t trail = place.trail;
    for (uint32_t at = root_; !(at & kLeaf); trail >>= 2) {
        Node const& node = nodes_[at];
        float total;
        Four const share = importances(node, ref, normal, total);
        uint32_t const k = trail & 3;
        if (!(share[k] > 0)) return 0;
        probability *= share[k] / total;
        at = node.child[k];
    }
    return probability;
}

} // namespace weft::lights
