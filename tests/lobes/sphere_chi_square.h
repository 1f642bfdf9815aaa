// A chi-square test of directions against a density over the sphere that resolves lobes of any
// width: the sphere is cut where pilot samples lie, and the density integrated adaptively over
// each cell.
//
// Coordinates: t = y in [-1, 1] and phi, the angle about the y axis from x towards z. The map
// preserves area (d omega = dt dphi), is smooth around the normal, makes the horizon a line of
// constant phi, and lets sheets of light from brushed surfaces lie along an axis.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/hash.h"
#include "base/vec.h"
#include "tests/support/statistics.h"

namespace weft::lobes::testing {

struct SphereTest {
    double integral = 0;  ///< of the density over the sphere
    double success = 0;   ///< fraction of samples that did not fail
    long evaluations = 0; ///< of the density
    weft::testing::ChiSquare chi_square;
};

class SphereChiSquare {
  public:
    using Sample = std::function<Vec3(Vec3 const& u)>; ///< zero vector = failure
    using Density = std::function<float(Vec3 const& w)>;

    SphereChiSquare(Sample sample, Density density)
        : sample_(std::move(sample)), density_(std::move(density)) {}

    SphereTest run(uint64_t seed, int samples) {
        Rng pilot_rng(hash64(seed) ^ 1), rng(hash64(seed) ^ 2);
        std::array<std::vector<Point>, 2> pilot;
        for (int i = 0; i < kPilot; ++i) {
            // Some choose by a tiny u.z, so that what is rarely chosen is not overlooked.
            Vec3 u = pilot_rng.next3();
            if (i % 8 == 0) u.z *= 1e-7f;
            Vec3 const w = sample_(u);
            if (w != Vec3(0)) pilot[w.z < 0].push_back(point(w));
        }
        for (int side = 0; side < 2; ++side)
            roots_[size_t(side)] = build(side == 0 ? Box{-1, 1, 0, kPiD} : Box{-1, 1, -kPiD, 0},
                                         pilot[size_t(side)], kPilot / kBins);

        std::vector<double> observed(integrals_.size());
        double hits = 0;
        for (int i = 0; i < samples; ++i) {
            Vec3 const w = sample_(rng.next3());
            if (w == Vec3(0)) continue;
            ++observed[size_t(find(w.z < 0, point(w)))];
            ++hits;
        }
        SphereTest result;
        for (double x : integrals_) result.integral += x;
        result.success = hits / samples;
        result.evaluations = evaluations_;
        std::vector<double> expected;
        for (double x : integrals_) expected.push_back(x / result.integral * hits);
        if (hits > 0) result.chi_square = weft::testing::chi_square(observed, expected);
        return result;
    }

  private:
    static constexpr double kPiD = 3.14159265358979323846;
    static constexpr double kInside = 1 - 1e-9;
    static constexpr int kPilot = 1 << 14, kBins = 1 << 7;
    static constexpr double kTolerance = 3e-8;
    static constexpr int kDepth = 16;

    struct Point {
        double t, phi;
    };
    struct Box {
        double t0, t1, phi0, phi1;
        double area() const { return (t1 - t0) * (phi1 - phi0); }
    };
    struct Node {
        bool by_phi = false;
        double split = 0;
        int below = -1, above = -1; ///< nodes, or -1
        int bin = -1;
    };

    static Point point(Vec3 const& w) { return {w.y, std::atan2(double(w.z), double(w.x))}; }

    /// Cells below `bin_size` pilot samples become one bin, but are cut on (as cells of
    /// integration) so that each holds few samples.
    int build(Box const& box, std::vector<Point>& points, int bin_size) {
        int const index = int(nodes_.size());
        nodes_.emplace_back();
        Node node;
        std::vector<Point> lower, upper;
        Cut parts;
        if (int(points.size()) > bin_size) {
            parts = cut(box, points);
            node = parts.node;
            partition(node, points, lower, upper);
        }
        // Points that coincide (a sampler with an atom) cannot be cut apart.
        if (lower.empty() || upper.empty()) {
            node.bin = int(integrals_.size());
            integrals_.push_back(integrate_cell(box, points));
        } else {
            node.below = build(parts.below, lower, bin_size);
            node.above = build(parts.above, upper, bin_size);
        }
        nodes_[size_t(index)] = node;
        return index;
    }

    struct Cut {
        Node node;
        Box below, above;
    };
    /// At the median along the axis in which the points are most concentrated.
    static Cut cut(Box const& box, std::vector<Point>& points) {
        size_t const n = points.size();
        auto const quartiles = [&](auto key) {
            std::vector<double> keys;
            keys.reserve(n);
            for (Point const& p : points) keys.push_back(key(p));
            auto const from = keys.begin(), upper = from + long(n / 2);
            std::nth_element(from, upper, keys.end());
            std::nth_element(from, from + long(n / 4), upper);
            if (3 * n / 4 > n / 2) std::nth_element(upper + 1, from + long(3 * n / 4), keys.end());
            double const lower = n % 2 == 0 ? *std::max_element(from, upper) : *upper;
            return std::array{keys[n / 4], (lower + *upper) / 2, keys[3 * n / 4]};
        };
        auto const t = quartiles([](Point const& p) { return p.t; });
        auto const phi = quartiles([](Point const& p) { return p.phi; });
        Cut c{{}, box, box};
        c.node.by_phi =
            (phi[2] - phi[0]) * (box.t1 - box.t0) < (t[2] - t[0]) * (box.phi1 - box.phi0);
        c.node.split = c.node.by_phi ? phi[1] : t[1];
        (c.node.by_phi ? c.below.phi1 : c.below.t1) = c.node.split;
        (c.node.by_phi ? c.above.phi0 : c.above.t0) = c.node.split;
        return c;
    }
    static void partition(Node const& node, std::vector<Point> const& points,
                          std::vector<Point>& lower, std::vector<Point>& upper) {
        for (Point const& p : points)
            ((node.by_phi ? p.phi : p.t) < node.split ? lower : upper).push_back(p);
    }

    int find(bool below_horizon, Point const& p) const {
        int n = roots_[below_horizon];
        while (nodes_[size_t(n)].bin < 0) {
            Node const& node = nodes_[size_t(n)];
            n = (node.by_phi ? p.phi : p.t) < node.split ? node.below : node.above;
        }
        return nodes_[size_t(n)].bin;
    }

    /// Wraps the points first, so that what is integrated has the size of what is there; the
    /// space around them goes in strips.
    double integrate_cell(Box box, std::vector<Point>& points) {
        if (points.size() < 2) return integrate(box);
        double around = wrap(box, points);
        if (points.size() <= 8) return around + integrate(box);
        auto const [node, below, above] = cut(box, points);
        std::vector<Point> lower, upper;
        partition(node, points, lower, upper);
        if (lower.empty() || upper.empty()) return around + integrate(box);
        around += integrate_cell(below, lower);
        return around + integrate_cell(above, upper);
    }

    /// Shrinks `box` around the points with a margin; the integral over what is cut off.
    double wrap(Box& box, std::vector<Point> const& points) {
        auto [t_min, t_max] = std::minmax_element(points.begin(), points.end(),
                                                  [](Point a, Point b) { return a.t < b.t; });
        auto [phi_min, phi_max] = std::minmax_element(
            points.begin(), points.end(), [](Point a, Point b) { return a.phi < b.phi; });
        double const dt = (t_max->t - t_min->t) / 2, dphi = (phi_max->phi - phi_min->phi) / 2;
        Box const inner{std::max(box.t0, t_min->t - dt), std::min(box.t1, t_max->t + dt),
                        std::max(box.phi0, phi_min->phi - dphi),
                        std::min(box.phi1, phi_max->phi + dphi)};
        bool const t_first = (inner.t1 - inner.t0) * (box.phi1 - box.phi0) <
                             (inner.phi1 - inner.phi0) * (box.t1 - box.t0);
        double sum = 0;
        for (int pass = 0; pass < 2; ++pass) {
            Box low = box, high = box;
            if ((pass == 0) == t_first) {
                low.t1 = box.t0 = inner.t0;
                high.t0 = box.t1 = inner.t1;
            } else {
                low.phi1 = box.phi0 = inner.phi0;
                high.phi0 = box.phi1 = inner.phi1;
            }
            for (Box const& strip : {low, high})
                if (strip.area() > 0) sum += integrate(strip);
        }
        return sum;
    }

    /// Gauss-Lobatto, 5 x 5: its nodes on the border see a peak that lies against it.
    double rule(Box const& b) {
        static constexpr std::array x{-1.0, -0.65465367070797714, 0.0, 0.65465367070797714, 1.0};
        static constexpr std::array w{0.05, 49 / 180.0, 16 / 45.0, 49 / 180.0, 0.05};
        std::array<Azimuth, 5> across;
        for (size_t j = 0; j < 5; ++j)
            across[j] = azimuth(b, (b.phi0 + b.phi1 + x[j] * (b.phi1 - b.phi0)) / 2);
        double sum = 0;
        for (size_t i = 0; i < 5; ++i) {
            double const t = (b.t0 + b.t1 + x[i] * (b.t1 - b.t0)) / 2 * kInside;
            double const r = std::sqrt(1 - t * t);
            for (size_t j = 0; j < 5; ++j) {
                double const f =
                    density_({float(r * across[j].cos), float(t), float(r * across[j].sin)});
                sum += w[i] * w[j] * f;
            }
        }
        evaluations_ += 25;
        return sum * b.area();
    }

    struct Azimuth {
        double cos = 1, sin = 0;
    };
    /// Of phi, on the box's side of the horizon, which itself belongs to neither.
    static Azimuth azimuth(Box const& b, double phi) {
        double const inside = std::min(std::max(std::abs(phi), 1 - kInside), kPiD * kInside);
        double const sign = b.phi1 > 0 ? 1 : -1;
        return {std::cos(inside), sign * std::sin(inside)};
    }

    /// The sum of f over the quarters of a box.
    template <class F>
    static double split(Box const& b, F&& f) {
        double const t = (b.t0 + b.t1) / 2, phi = (b.phi0 + b.phi1) / 2;
        double sum = 0;
        for (Box const& part : {Box{b.t0, t, b.phi0, phi}, Box{t, b.t1, b.phi0, phi},
                                Box{b.t0, t, phi, b.phi1}, Box{t, b.t1, phi, b.phi1}})
            sum += f(part);
        return sum;
    }

    double integrate(Box const& b) { return integrate(b, rule(b), 0); }
    /// By halving until a box agrees with its quarters.
    double integrate(Box const& b, double whole, int depth) {
        std::array<double, 4> quarters{};
        size_t i = 0;
        double const sum = split(b, [&](Box const& part) { return quarters[i++] = rule(part); });
        // Rounding of the directions makes narrow densities rough, hence the end to depth.
        if (std::abs(sum - whole) < kTolerance || depth == kDepth) return sum;
        i = 0;
        return split(b, [&](Box const& part) { return integrate(part, quarters[i++], depth + 1); });
    }

    Sample sample_;
    Density density_;
    std::vector<Node> nodes_;
    std::array<int, 2> roots_{};
    std::vector<double> integrals_; ///< per bin
    long evaluations_ = 0;
};

} // namespace weft::lobes::testing
