#include "base/distribution.h"

#include <bit>
#include <cassert>

namespace weft {

Distribution1D::Distribution1D(std::span<float const> weights) : cdf_(weights.size() + 1) {
    assert(!weights.empty());
    double sum = 0; // double: a million small weights must not round away
    for (float w : weights) sum += w;
    total_ = float(sum);
    double running = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
        running += sum > 0 ? weights[i] / sum : 1.0 / double(weights.size());
        cdf_[i + 1] = float(running);
    }
    // The last bins may have weight 0: everything that rounding left at the top is exactly 1.
    float const top = cdf_.back();
    for (size_t i = cdf_.size(); i-- > 0 && cdf_[i] == top;) cdf_[i] = 1;

    constexpr size_t bins_per_part = 4;
    size_t const parts = std::bit_floor(std::max(weights.size() / bins_per_part, size_t(1)));
    guide_.resize(parts + 1);
    uint32_t bin = 0;
    for (size_t i = 0; i <= parts; ++i) {
        float const u = float(i) / float(parts); // exact, as is u * parts in `find`
        while (bin + 1 < size() && cdf_[bin + 1] <= u) ++bin;
        guide_[i] = bin;
    }
}

uint32_t Distribution1D::find(float u) const {
    // The last bin whose start is <= u and whose width is not 0.
    size_t const parts = guide_.size() - 1;
    size_t const part = std::min(size_t(std::max(u, 0.f) * float(parts)), parts - 1);
    auto const first = cdf_.begin() + guide_[part], last = cdf_.begin() + guide_[part + 1] + 1;
    auto const it = std::upper_bound(first + 1, last, u);
    return std::min(uint32_t(it - cdf_.begin()) - 1, size() - 1);
}

Distribution1D::Sample Distribution1D::sample(float u) const {
    Choice const c = choose(u);
    float const n = float(size());
    float x = std::min((float(c.index) + c.u) / n, kOneMinusEpsilon);
    // Rounding may carry x over the edge of its bin, where the density is another one, or 0.
    while (x * n >= float(c.index + 1)) x = std::nextafter(x, 0.f);
    while (x * n < float(c.index)) x = std::nextafter(x, 1.f);
    return {x, c.probability * n, c.index};
}

Distribution1D::Choice Distribution1D::choose(float u) const {
    uint32_t const i = find(u);
    float const width = probability(i);
    float const rest = width > 0 ? (u - cdf_[i]) / width : 0;
    return {i, width, std::clamp(rest, 0.f, kOneMinusEpsilon)};
}

Distribution2D::Distribution2D(std::span<float const> weights, uint32_t width, uint32_t height) {
    assert(weights.size() == size_t(width) * height);
    std::vector<float> rows(height);
    conditional_.reserve(height);
    for (uint32_t y = 0; y < height; ++y) {
        conditional_.emplace_back(weights.subspan(size_t(y) * width, width));
        rows[y] = conditional_.back().total();
    }
    marginal_ = Distribution1D(rows);
}

Distribution2D::Sample Distribution2D::sample(Vec2 u) const {
    auto const y = marginal_.sample(u.y);
    auto const x = conditional_[y.bin].sample(u.x);
    return {{x.x, y.x}, x.pdf * y.pdf};
}

Distribution2D::Choice Distribution2D::choose(Vec2 u) const {
    auto const y = marginal_.choose(u.y);
    auto const x = conditional_[y.index].choose(u.x);
    return {x.index, y.index, x.probability * y.probability, {x.u, y.u}};
}

float Distribution2D::pdf(Vec2 p) const {
    uint32_t const h = marginal_.size();
    uint32_t const y = std::min(uint32_t(std::max(p.y, 0.f) * float(h)), h - 1);
    Distribution1D const& row = conditional_[y];
    uint32_t const w = row.size();
    uint32_t const x = std::min(uint32_t(std::max(p.x, 0.f) * float(w)), w - 1);
    return marginal_.probability(y) * float(h) * row.probability(x) * float(w);
}

} // namespace weft
