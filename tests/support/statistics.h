// Statistics for tests: regularised incomplete gamma, chi-square and normal tail probabilities,
// the Sidak correction, and a chi-square comparison that pools sparse bins.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace weft::testing {

/// Q(a, x), the upper regularised incomplete gamma function (series or continued fraction,
/// Press et al., Numerical Recipes, 6.2).
inline double gamma_q(double a, double x) {
    if (x <= 0) return 1;
    double const scale = std::exp(-x + a * std::log(x) - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (int n = 1; n < 10000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
        return 1 - sum * scale;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
    for (int i = 1; i < 10000; ++i) {
        double const an = -i * (i - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        double const delta = d * c;
        h *= delta;
        if (std::abs(delta - 1) < 1e-15) break;
    }
    return h * scale;
}

/// The probability that a chi-square variable of `dof` degrees of freedom exceeds `x`.
inline double chi_square_tail(double x, int dof) { return gamma_q(dof / 2.0, x / 2); }

/// The two-sided tail probability of a standard normal variable beyond |z|.
inline double normal_tail(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// The per-test level that gives `alpha` over `tests` independent tests (Sidak).
inline double sidak(double alpha, int tests) { return 1 - std::pow(1 - alpha, 1.0 / tests); }

struct ChiSquare {
    double statistic = 0;
    int dof = 0;
    double p_value = 1;
    std::string problem; ///< set where a bin of expectation 0 was hit
};

/// Pearson's test of `observed` counts against `expected` ones (same length, same total up to
/// integration error). Bins are pooled in order of expectation until each pool expects >= 5.
inline ChiSquare chi_square(std::span<double const> observed, std::span<double const> expected) {
    std::vector<size_t> order(expected.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return expected[a] < expected[b]; });
    ChiSquare result;
    double pooled_observed = 0, pooled_expected = 0;
    int pools = 0;
    for (size_t k = 0; k < order.size(); ++k) {
        size_t const i = order[k];
        if (expected[i] == 0 && observed[i] > 0) {
            result.problem = "samples where the density is 0";
            result.p_value = 0;
            return result;
        }
        pooled_observed += observed[i];
        pooled_expected += expected[i];
        bool const last = k + 1 == order.size();
        if (pooled_expected >= 5 || (last && pooled_expected > 0)) {
            double const d = pooled_observed - pooled_expected;
            result.statistic += d * d / pooled_expected;
            pooled_observed = pooled_expected = 0;
            ++pools;
        }
    }
    result.dof = pools - 1;
    if (result.dof > 0) result.p_value = chi_square_tail(result.statistic, result.dof);
    return result;
}

/// Mean and the variance of that mean.
struct Estimate {
    double mean = 0;
    double variance = 0;
};

inline Estimate estimate(std::span<double const> values) {
    double const n = double(values.size());
    double const mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (double v : values) squares += (v - mean) * (v - mean);
    return {mean, squares / (n - 1) / n};
}

} // namespace weft::testing
