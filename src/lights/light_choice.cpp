#include "lights/light_choice.h"

#include <cassert>

namespace weft::lights {

LightChoice::LightChoice(std::span<float const> weights) {
    double sum = 0;
    uint32_t positive = 0;
    for (float w : weights) {
        assert(w >= 0 && std::isfinite(w));
        sum += w;
        positive += w > 0;
    }
    if (positive == 0) return;
    float const least = float(1e-3 * sum / positive);
    std::vector<float> raised(weights.begin(), weights.end());
    for (float& w : raised)
        if (w > 0) w = std::max(w, least);
    by_weight_ = Distribution1D(raised);
    count_ = uint32_t(weights.size());
}

LightChoice::Choice LightChoice::choose(Vec3 const&, Vec3 const&, float u) const {
    if (empty()) return {};
    if (count_ == 1) return {0, 1, u};
    Distribution1D::Choice const c = by_weight_.choose(u);
    return {c.index, c.probability, c.u};
}

float LightChoice::probability(Vec3 const&, Vec3 const&, uint32_t index) const {
    return index < count_ ? by_weight_.probability(index) : 0;
}

} // namespace weft::lights
