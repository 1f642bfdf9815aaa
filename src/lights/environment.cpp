#include "lights/environment.h"

#include <cassert>
#include <numbers>

namespace weft::lights {

EnvironmentSampler::EnvironmentSampler(std::span<float const> luminance, uint32_t width,
                                       uint32_t height)
    : haversine_(height + 1), band_(height), height_(height) {
    assert(luminance.size() == size_t(width) * height && !luminance.empty());
    double const half_row = std::numbers::pi / 2 / height;
    for (uint32_t y = 0; y <= height; ++y) {
        double const s = std::sin(half_row * y);
        haversine_[y] = float(s * s);
    }
    std::vector<float> weights(luminance.begin(), luminance.end());
    for (uint32_t y = 0; y < height; ++y) {
        band_[y] = float(2 * std::sin(half_row * (2 * y + 1)) * std::sin(half_row));
        float const cell = band_[y] * (2 * kPi / float(width)); // sr
        for (uint32_t x = 0; x < width; ++x) {
            float& w = weights[size_t(y) * width + x];
            w = w > 0 && std::isfinite(w) ? w * cell : 0;
        }
    }
    cells_ = Distribution2D(weights, width, height);
}

/// A density over the lat-long square as one over solid angle: its row of area 1 / height in the
/// square is 2 pi band on the sphere.
float EnvironmentSampler::density(float uv_density, uint32_t row) const {
    return uv_density / (2 * kPi * float(height_) * band_[row]);
}

EnvironmentSampler::Sample EnvironmentSampler::sample(Vec2 u) const {
    Distribution2D::Sample const s = cells_.sample(u);
    float const y = s.p.y * float(height_);
    uint32_t const row = std::min(uint32_t(y), height_ - 1);
    float const t = std::min(y - float(row), 1.f);
    bool const north = 2 * y < float(height_); // the middle row of an odd number has both
    float const h = north ? haversine_[row] + 0.5f * t * band_[row]
                          : haversine_[height_ - 1 - row] + 0.5f * (1 - t) * band_[row];
    float const from_pole = 2 * kInvPi * std::asin(std::sqrt(std::min(h, 1.f)));
    float const r = 2 * safe_sqrt(h * (1 - h)), phi = (0.5f - s.p.x) * (2 * kPi);
    return {{s.p.x, north ? from_pole : 1 - from_pole},
            {r * std::cos(phi), north ? 1 - 2 * h : 2 * h - 1, r * std::sin(phi)},
            density(s.pdf, row)};
}

float EnvironmentSampler::pdf(Vec3 const& d) const {
    Vec2 const uv = direction_to_uv(d);
    uint32_t const row = std::min(uint32_t(uv.y * float(height_)), height_ - 1);
    return density(cells_.pdf(uv), row);
}

} // namespace weft::lights
