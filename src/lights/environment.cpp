#include "lights/environment.h"

#include <cassert>
#include <numbers>

#include "base/warp.h"

namespace weft::lights {

namespace {

/// A map of which less than this part is brighter than its mean is as good as even.
constexpr double kEven = 1e-3;

float usable(float value) { return value > 0 && std::isfinite(value) ? value : 0; }

} // namespace

Vec2 EnvironmentGrid::uv(uint32_t x, uint32_t y) const {
    float const shift = filter == Filter::bilinear ? -0.5f : 0.5f;
    return {(float(x) + 0.5f) / float(width),
            std::clamp((float(y) + shift) / float(height), 0.f, 1.f)};
}

EnvironmentSampler::EnvironmentSampler(EnvironmentGrid grid, bool compensated)
    : grid_(std::move(grid)) {
    bool const smooth = grid_.filter == EnvironmentGrid::Filter::bilinear;
    assert(grid_.values.size() == size_t(grid_.width) * grid_.rows() && !grid_.values.empty());
    for (float& v : grid_.values) v = usable(v);

    rows_ = smooth ? grid_.height + 1 : grid_.height;
    haversine_.resize(rows_ + 1);
    band_.resize(rows_);
    auto const edge = [&](uint32_t y) { // theta
        double const v = y == 0 ? 0 : y == rows_ ? grid_.height : smooth ? y - 0.5 : double(y);
        return std::numbers::pi * v / grid_.height;
    };
    for (uint32_t y = 0; y <= rows_; ++y) {
        double const s = std::sin(0.5 * edge(y));
        haversine_[y] = float(s * s);
    }
    for (uint32_t y = 0; y < rows_; ++y)
        band_[y] = float(2 * std::sin(0.5 * (edge(y) + edge(y + 1))) *
                         std::sin(0.5 * (edge(y + 1) - edge(y))));

    double const total = weigh();
    total_ = float(total);
    if (total == 0) {
        std::fill(grid_.values.begin(), grid_.values.end(), 1.f);
        weigh();
    } else if (compensated) {
        std::vector<float> const all = grid_.values;
        float const mean = float(total / (4 * std::numbers::pi));
        for (float& v : grid_.values) v = std::max(v - mean, 0.f);
        if (weigh() > kEven * total) return;
        grid_.values = all;
        weigh();
    }
}

double EnvironmentSampler::weigh() {
    std::vector<float> weights(size_t(grid_.width) * rows_);
    double total = 0;
    for (uint32_t y = 0; y < rows_; ++y)
        for (uint32_t x = 0; x < grid_.width; ++x) {
            Corners c;
            corners(x, y, c);
            float const weight = 0.25f * (c[0] + c[1] + c[2] + c[3]) * solid_angle(y);
            weights[size_t(y) * grid_.width + x] = weight;
            total += double(weight);
        }
    cells_ = Distribution2D(weights, grid_.width, rows_);
    return total;
}

void EnvironmentSampler::corners(uint32_t x, uint32_t y, Corners& c) const {
    float const* const row = &grid_.values[size_t(y) * grid_.width];
    if (grid_.filter == EnvironmentGrid::Filter::nearest) {
        c[0] = c[1] = c[2] = c[3] = row[x];
        return;
    }
    uint32_t const left = x == 0 ? grid_.width - 1 : x - 1;
    c[0] = row[left];
    c[1] = row[x];
    c[2] = row[grid_.width + left];
    c[3] = row[grid_.width + x];
}

float EnvironmentSampler::solid_angle(uint32_t row) const {
    return band_[row] * (2 * kPi / float(grid_.width));
}

/// At `place` in a cell of the row with those corners.
float EnvironmentSampler::density(float probability, uint32_t row, Corners const& c,
                                  Vec2 place) const {
    float const mean = 0.25f * (c[0] + c[1] + c[2] + c[3]);
    return mean > 0 ? probability / solid_angle(row) * (bilinear(place, c) / mean) : 0;
}

EnvironmentSampler::Sample EnvironmentSampler::sample(Vec2 u) const {
    auto const cell = cells_.choose(u);
    uint32_t const row = cell.y;
    Corners c;
    corners(cell.x, row, c);
    Vec2 const place = sample_bilinear(cell.u, c);

    // The middle row of an odd number has both halves of the sphere.
    float const from_north = haversine_[row] + 0.5f * place.y * band_[row];
    bool const north = from_north < 0.5f;
    float const h =
        north ? from_north : haversine_[rows_ - 1 - row] + 0.5f * (1 - place.y) * band_[row];
    float const from_pole = 2 * kInvPi * std::asin(std::sqrt(std::min(h, 1.f)));
    float const shift = grid_.filter == EnvironmentGrid::Filter::bilinear ? -0.5f : 0.f;
    float x = (float(cell.x) + place.x + shift) / float(grid_.width);
    if (x < 0) x += 1;
    float const r = 2 * safe_sqrt(h * (1 - h)), phi = (0.5f - x) * (2 * kPi);
    return {{x, north ? from_pole : 1 - from_pole},
            {r * std::cos(phi), north ? 1 - 2 * h : 2 * h - 1, r * std::sin(phi)},
            density(cell.probability, row, c, place)};
}

float EnvironmentSampler::pdf(Vec3 const& d) const {
    bool const smooth = grid_.filter == EnvironmentGrid::Filter::bilinear;
    Vec2 const uv = direction_to_uv(d);
    float const x = uv.x * float(grid_.width) + (smooth ? 0.5f : 0.f);
    float const y = uv.y * float(grid_.height) + (smooth ? 0.5f : 0.f);
    uint32_t const column = uint32_t(x), row = std::min(uint32_t(y), rows_ - 1);
    uint32_t const cell = column < grid_.width ? column : column - grid_.width;
    Corners c;
    corners(cell, row, c);
    float const h = (d.x * d.x + d.z * d.z) / (2 * (1 + std::abs(d.y)));
    float const t =
        d.y > 0 ? h - haversine_[row] : 0.5f * band_[row] + haversine_[rows_ - 1 - row] - h;
    Vec2 const place{x - float(column), std::clamp(2 * t / band_[row], 0.f, 1.f)};
    return density(cells_.probability(cell, row), row, c, place);
}

} // namespace weft::lights
