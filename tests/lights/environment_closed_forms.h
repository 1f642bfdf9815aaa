// Closed forms of what environment maps send, which share no code with the program.
//
// The convention: the texel in column c of row r, from the top left of W x H, is a point at
//   phi = 2 pi (1/2 - (c + 1/2) / W),  theta = pi (1 - (r + 1/2) / H)  from the +y axis,
// and between such points radiance is linear in phi and in theta. Columns go on around the seam.
// Between a pole and the row beside it radiance is that of the row.
//
// So a texel's share of the light is a function of phi (a hat) times one of theta (a hat; beside
// a pole the half of one and a step), and irradiance is a sum of products of integrals of straight
// lines times sines and cosines, which are known.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/vec.h"

namespace weft::lights::testing {

inline constexpr double kPi64 = std::numbers::pi;

/// A straight line over [from, to].
struct Line {
    double from, to, first, last;
};
using Lines = std::vector<Line>;

/// Antiderivatives of (p + q x) times a function.
struct Integrand {
    double (*antiderivative)(double x, double f, double q);
};
inline Integrand const kOne{[](double x, double f, double q) { return f * x - q * x * x / 2; }};
inline Integrand const kCos{
    [](double x, double f, double q) { return f * std::sin(x) + q * std::cos(x); }};
inline Integrand const kSin{
    [](double x, double f, double q) { return -f * std::cos(x) + q * std::sin(x); }};
inline Integrand const kSinCos{[](double x, double f, double q) {
    return -f * std::cos(2 * x) / 4 + q * std::sin(2 * x) / 8;
}};
inline Integrand const kSinSin{[](double x, double f, double q) {
    return (f * x - q * x * x / 2) / 2 - f * std::sin(2 * x) / 4 - q * std::cos(2 * x) / 8;
}};

/// The integral of the lines times `g` over [low, high].
inline double integral(Lines const& lines, Integrand const& g, double low = -1e9,
                       double high = 1e9) {
    double sum = 0;
    for (Line const& l : lines) {
        double const a = std::max(l.from, low), b = std::min(l.to, high);
        if (a >= b) continue;
        double const q = (l.last - l.first) / (l.to - l.from);
        auto const at = [&](double x) {
            return g.antiderivative(x, l.first + q * (x - l.from), q);
        };
        sum += at(b) - at(a);
    }
    return sum;
}

/// A map of one channel, rows from the top.
struct Map {
    int width, height;
    std::vector<double> texels;

    double& at(int column, int row) { return texels[size_t(row * width + column)]; }
    double at(int column, int row) const { return texels[size_t(row * width + column)]; }
    /// Returns a row's share of the light by theta.
    Lines row_share(int row) const {
        double const step = kPi64 / height, centre = kPi64 - step * (row + 0.5);
        Lines lines{{centre - step, centre, 0, 1}, {centre, centre + step, 1, 0}};
        if (row == height - 1) lines[0] = {0, centre, 1, 1};
        if (row == 0) lines[1] = {centre, kPi64, 1, 1};
        return lines;
    }
    /// Returns a column's by phi, `turn` times 2 pi further.
    Lines column_share(int column, int turn = 0) const {
        double const step = 2 * kPi64 / width;
        double const centre = kPi64 - step * (column + 0.5) + 2 * kPi64 * turn;
        return {{centre - step, centre, 0, 1}, {centre, centre + step, 1, 0}};
    }
    template <class F>
    double sum(F&& f) const {
        double total = 0;
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column)
                if (at(column, row) != 0) total += at(column, row) * f(column, row);
        return total;
    }
    double mean() const {
        return sum([&](int column, int row) {
                   return integral(row_share(row), kSin) * integral(column_share(column), kOne);
               }) /
               (4 * kPi64);
    }
    /// Irradiance on a plane with unit normal `n` that sees all texels that are not black.
    double irradiance(Vec3d const& n) const {
        return sum([&](int column, int row) {
            Lines const r = row_share(row), c = column_share(column);
            return n.y * integral(r, kSinCos) * integral(c, kOne) +
                   integral(r, kSinSin) * (n.x * integral(c, kCos) + n.z * integral(c, kSin));
        });
    }
    /// Irradiance on a plane that looks to +y.
    double irradiance_from_above() const {
        return sum([&](int column, int row) {
            return integral(row_share(row), kSinCos, 0, kPi64 / 2) *
                   integral(column_share(column), kOne);
        });
    }
    /// Irradiance on a plane that looks to +x, beside which phi is pi / 2.
    double irradiance_from_x() const {
        return sum([&](int column, int row) {
            double seen = 0;
            for (int turn : {-1, 0, 1})
                seen += integral(column_share(column, turn), kCos, -kPi64 / 2, kPi64 / 2);
            return integral(row_share(row), kSinSin) * seen;
        });
    }
    /// Radiance from the unit direction `d`.
    double radiance(Vec3d const& d) const {
        double const phi = std::atan2(d.z, d.x), theta = std::acos(std::clamp(d.y, -1.0, 1.0));
        auto const value = [](Lines const& lines, double x) {
            for (Line const& l : lines)
                if (x >= l.from && x <= l.to)
                    return l.first + (l.last - l.first) * (x - l.from) / (l.to - l.from);
            return 0.0;
        };
        return sum([&](int column, int row) {
            double share = 0;
            for (int turn : {-1, 0, 1})
                share = std::max(share, value(column_share(column, turn), phi));
            return share * value(row_share(row), theta);
        });
    }
};

inline Map dark(int width, int height) {
    return {width, height, std::vector<double>(size_t(width * height))};
}
inline Map one_texel(int width, int height, int column, int row, double value = 40) {
    Map map = dark(width, height);
    map.at(column, row) = value;
    return map;
}
template <class F>
Map map_of(int width, int height, F&& value) {
    Map map = dark(width, height);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) map.at(column, row) = value(column, row);
    return map;
}

} // namespace weft::lights::testing
