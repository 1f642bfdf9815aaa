#include "lights/portal.h"

#include <algorithm>

namespace weft::lights {

namespace {

/// The direction, in the portal's frame, at angles alpha and beta.
Vec3 rectified(float alpha, float beta) {
    float const ca = std::cos(alpha), cb = std::cos(beta);
    return normalize(Vec3(std::sin(alpha) * cb, std::sin(beta) * ca, ca * cb));
}

/// dw / (d alpha d beta).
float stretch(Vec3 const& w) { return (1 - w.x * w.x) * (1 - w.y * w.y) / std::max(w.z, 1e-6f); }

/// The place in [low, high] up to which the growing function `f` reaches `target`, between
/// integers linear. f(low) <= target <= f(high).
template <class F>
double invert(F const& f, double low, double high, double target) {
    int64_t first = int64_t(low), last = std::max(int64_t(std::ceil(high)), first + 1);
    while (last - first > 1) {
        int64_t const middle = (first + last) / 2;
        (f(double(middle)) <= target ? first : last) = middle;
    }
    double const from = std::max(double(first), low), to = std::min(double(last), high);
    double const f0 = f(from), f1 = f(to);
    double const t = f1 > f0 ? std::clamp((target - f0) / (f1 - f0), 0.0, 1.0) : 0.5;
    return from + t * (to - from);
}

} // namespace

PortalMap::PortalMap(Portal const& portal, uint32_t resolution, uint32_t lookups, float even,
                     std::function<float(Vec3 const&)> const& brightness)
    : portal_(portal), size_(resolution), sums_(size_t(resolution + 1) * (resolution + 1)) {
    float const step = kPi / float(size_ * lookups);
    for (uint32_t y = 0; y < size_; ++y) {
        double row = 0;
        for (uint32_t x = 0; x < size_; ++x) {
            for (uint32_t k = 0; k < lookups * lookups; ++k) {
                float const alpha = (float(x * lookups + k % lookups) + 0.5f) * step - kPi / 2;
                float const beta = (float(y * lookups + k / lookups) + 0.5f) * step - kPi / 2;
                Vec3 const w = rectified(alpha, beta);
                Vec3 const d = portal_.s * w.x + portal_.t * w.y + portal_.outward * w.z;
                row += double((brightness(d) + even) * stretch(w) * square(step));
            }
            size_t const i = size_t(y + 1) * (size_ + 1) + x + 1;
            sums_[i] = sums_[i - size_ - 1] + row;
        }
    }
}

bool PortalMap::window(Vec3 const& ref, Window& w) const {
    Vec3 const d = portal_.centre - ref;
    float const z = dot(d, portal_.outward), x = dot(d, portal_.s), y = dot(d, portal_.t);
    if (!(z > 0)) return false;
    auto const place = [&](float along) {
        return std::clamp((std::atan2(along, z) * kInvPi + 0.5f) * float(size_), 0.f, float(size_));
    };
    w = {{place(x - portal_.half_width), place(y - portal_.half_height)},
         {place(x + portal_.half_width), place(y + portal_.half_height)}};
    return w.low.x < w.high.x && w.low.y < w.high.y;
}

double PortalMap::sum(double x, double y) const {
    uint32_t const i = std::min(uint32_t(x), size_ - 1), j = std::min(uint32_t(y), size_ - 1);
    double const s = x - i, t = y - j;
    double const* const p = &sums_[size_t(j) * (size_ + 1) + i];
    double const top = p[0] + (p[1] - p[0]) * s,
                 bottom = p[size_ + 1] + (p[size_ + 2] - p[size_ + 1]) * s;
    return top + (bottom - top) * t;
}

double PortalMap::cell(uint32_t x, uint32_t y) const {
    double const* const p = &sums_[size_t(y) * (size_ + 1) + x];
    return (p[size_ + 2] - p[size_ + 1]) - (p[1] - p[0]);
}

double PortalMap::integral(Window const& w) const {
    double const x0 = double(w.low.x), y0 = double(w.low.y), x1 = double(w.high.x),
                 y1 = double(w.high.y);
    return std::max((sum(x1, y1) - sum(x1, y0)) - (sum(x0, y1) - sum(x0, y0)), 0.0);
}

Vec2 PortalMap::place_of(Vec3 const& local) const {
    return {(std::atan2(local.x, local.z) * kInvPi + 0.5f) * float(size_),
            (std::atan2(local.y, local.z) * kInvPi + 0.5f) * float(size_)};
}

PortalMap::Sample PortalMap::sample(Window const& w, Vec2 u) const {
    double const x0 = double(w.low.x), y0 = double(w.low.y), x1 = double(w.high.x),
                 y1 = double(w.high.y);
    auto const across = [&](double x) { return sum(x, y1) - sum(x, y0); };
    double const left = across(x0);
    double const x = invert(across, x0, x1, left + double(u.x) * (across(x1) - left));
    uint32_t const i = std::min(uint32_t(x), size_ - 1);
    auto const down = [&](double y) { return sum(i + 1, y) - sum(i, y); };
    double const top = down(y0);
    double const y = invert(down, y0, y1, top + double(u.y) * (down(y1) - top));
    uint32_t const j = std::min(uint32_t(y), size_ - 1);

    float const step = kPi / float(size_);
    Vec3 const local = rectified(float(x) * step - kPi / 2, float(y) * step - kPi / 2);
    Vec3 const d = portal_.s * local.x + portal_.t * local.y + portal_.outward * local.z;
    return {d, float(cell(i, j)) / (square(step) * stretch(local))};
}

float PortalMap::density(Window const& w, Vec3 const& direction) const {
    Vec3 const local(dot(direction, portal_.s), dot(direction, portal_.t),
                     dot(direction, portal_.outward));
    if (!(local.z > 0)) return 0;
    Vec2 const p = place_of(local);
    if (p.x < w.low.x || p.x > w.high.x || p.y < w.low.y || p.y > w.high.y) return 0;
    uint32_t const i = std::min(uint32_t(p.x), size_ - 1), j = std::min(uint32_t(p.y), size_ - 1);
    return float(cell(i, j)) / (square(kPi / float(size_)) * stretch(local));
}

double PortalSampler::light_at(Vec3 const& ref) const {
    double total = 0;
    PortalMap::Window w;
    for (PortalMap const& map : maps_)
        if (map.window(ref, w)) total += map.integral(w);
    return total;
}

PortalSampler::Sample PortalSampler::sample(Vec3 const& ref, double light, Vec2 u) const {
    double target = double(u.x) * light;
    PortalMap::Window w;
    PortalMap const* chosen = nullptr;
    double part = 0;
    for (PortalMap const& map : maps_) {
        if (chosen && target < part) break;
        if (!map.window(ref, w)) continue;
        double const next = map.integral(w);
        if (next == 0) continue;
        if (chosen) target -= part;
        chosen = &map;
        part = next;
    }
    if (!chosen || !chosen->window(ref, w)) return {};
    float const rest = std::min(float(target / part), kOneMinusEpsilon);
    PortalMap::Sample const s = chosen->sample(w, {rest, u.y});
    if (maps_.size() == 1) return {s.direction, s.density / float(light)};
    return {s.direction, pdf(ref, light, s.direction)};
}

float PortalSampler::pdf(Vec3 const& ref, double light, Vec3 const& direction) const {
    float total = 0;
    PortalMap::Window w;
    for (PortalMap const& map : maps_)
        if (map.window(ref, w)) total += map.density(w, direction);
    return total / float(light);
}

} // namespace weft::lights
