// Pixel filters by filter importance sampling (Ernst, Stamminger and Greiner 2006): the film
// position of a sample is drawn from the filter, and the sample counts with weight 1 in its own
// pixel alone. Pixels thus stay independent: tiles need no borders and noise stays white, which
// denoisers expect. Filters with negative lobes cannot be densities and are left out.
//
// All filters are separable and even: density f(x) f(y). Quantiles rise with the random number,
// so stratification survives. Lengths are pixels.
#pragma once

#include <array>
#include <cmath>
#include <variant>

#include "base/match.h"
#include "base/vec.h"

namespace weft::film {

/// A constant within `radius`; 0.5 is the pixel itself.
struct BoxFilter {
    float radius = 0.5f;

    float quantile(float u) const { return radius * (2 * u - 1); }
    float density(float x) const { return std::abs(x) <= radius ? 0.5f / radius : 0.f; }
};

/// A triangle that falls to 0 at `radius`.
struct TentFilter {
    float radius = 1;

    float quantile(float u) const {
        float const t = 2 * u - 1;
        return std::copysign(radius * (1 - std::sqrt(1 - std::abs(t))), t);
    }
    float density(float x) const { return std::max(0.f, 1 - std::abs(x) / radius) / radius; }
};

/// One half, x in [0, 1], of an even density on [-1, 1] whose profile is linear between
/// equidistant knots; its inverse is exact and strictly monotone.
class EvenProfile {
  public:
    static constexpr int kIntervals = 256;

    /// `profile(x)` > 0 for x in [0, 1], on any scale.
    template <class F>
    explicit EvenProfile(F&& profile) {
        std::array<double, kIntervals + 1> f{}, tail{};
        for (int i = 0; i <= kIntervals; ++i) f[i] = profile(double(i) / kIntervals);
        for (int i = kIntervals; i-- > 0;) tail[i] = tail[i + 1] + (f[i] + f[i + 1]) / 2;
        for (int i = 0; i <= kIntervals; ++i) {
            tail_[i] = float(tail[i] / tail[0]);
            slope_[i] = float(f[i] / tail[0]);
        }
    }

    /// The x in [-1, 1] below which the density holds the fraction u in [0, 1).
    float quantile(float u) const {
        // Both 2 u and 2 (1 - u) are exact here: small tails keep all their digits.
        float const q = 2 * std::min(u, 1 - u);
        int low = 0; // the last knot with at least q beyond it
        for (int step = kIntervals / 2; step > 0; step /= 2)
            if (tail_[low + step] >= q) low += step;
        // Solves a s + (b - a) s^2 / 2 = tail - q for the place s in the interval.
        float const a = slope_[low], b = slope_[low + 1], rest = tail_[low] - q;
        float const s = 2 * rest / (a + safe_sqrt(a * a + 2 * (b - a) * rest));
        return std::copysign((float(low) + std::min(s, 1.f)) / kIntervals, u - 0.5f);
    }

    /// The density at x, which integrates to 1 over [-1, 1].
    float density(float x) const {
        float const k = std::abs(x) * kIntervals;
        if (!(k < kIntervals)) return 0;
        int const i = int(k);
        return lerp(slope_[i], slope_[i + 1], k - float(i)) * (kIntervals / 2.f);
    }

  private:
    std::array<float, kIntervals + 1> tail_{};  ///< the mass of the right half beyond each knot
    std::array<float, kIntervals + 1> slope_{}; ///< its loss per interval at each knot
};

/// A normal distribution of the given standard deviation, cut off at three of them.
class GaussianFilter {
  public:
    explicit GaussianFilter(float stddev = 0.5f)
        : radius_(3 * stddev), profile_([](double x) { return std::exp(-4.5 * x * x); }) {}

    float quantile(float u) const { return radius_ * profile_.quantile(u); }
    float density(float x) const { return profile_.density(x / radius_) / radius_; }

  private:
    float radius_;
    EvenProfile profile_;
};

/// The four-term window of Harris 1978 ("On the use of windows for harmonic analysis with the
/// discrete Fourier transform"), which falls to nearly 0 (6e-5 of the peak) at `radius`: sharp,
/// and free of visible ringing. With the default, 3 pixels wide, it is Cycles' default filter.
class BlackmanHarrisFilter {
  public:
    explicit BlackmanHarrisFilter(float radius = 1.5f) : radius_(radius), profile_(window) {}

    float quantile(float u) const { return radius_ * profile_.quantile(u); }
    float density(float x) const { return profile_.density(x / radius_) / radius_; }

    /// The window over x in [-1, 1], with peak 1.
    static double window(double x) {
        double const v = 3.14159265358979323846 * x;
        return 0.35875 + 0.48829 * std::cos(v) + 0.14128 * std::cos(2 * v) +
               0.01168 * std::cos(3 * v);
    }

  private:
    float radius_;
    EvenProfile profile_;
};

using Filter = std::variant<BoxFilter, TentFilter, GaussianFilter, BlackmanHarrisFilter>;

/// A film position relative to the pixel's centre, in pixels, drawn from `filter` by `u` in
/// [0, 1)^2.
inline Vec2 sample_filter(Filter const& filter, Vec2 u) {
    return match(filter, [&](auto const& f) { return Vec2(f.quantile(u.x), f.quantile(u.y)); });
}

/// The density of `sample_filter` at `offset`, per square pixel.
inline float filter_density(Filter const& filter, Vec2 offset) {
    return match(filter, [&](auto const& f) { return f.density(offset.x) * f.density(offset.y); });
}

} // namespace weft::film
