#include "base/blackbody.h"

#include <array>

namespace weft {

namespace {

double lobe(double x, double mean, double below, double above) {
    double const t = (x - mean) / (x < mean ? below : above);
    return std::exp(-0.5 * t * t);
}

/// Planck's law but for a factor; `wavelength` in nm.
double planck(double wavelength, double kelvin) {
    constexpr double c2 = 1.438776877e7; // h c / k in nm K
    return 1 / (std::pow(wavelength * 1e-3, 5) * std::expm1(c2 / (wavelength * kelvin)));
}

Color rgb_of(Imath::V2d const& xy) {
    double const X = xy.x / xy.y, Z = (1 - xy.x - xy.y) / xy.y; // at Y = 1
    // IEC 61966-2-1.
    Vec3d rgb(3.2404542 * X - 1.5371385 - 0.4985314 * Z, -0.9692660 * X + 1.8760108 + 0.0415560 * Z,
              0.0556434 * X - 0.2040259 + 1.0572252 * Z);
    double const least = std::min(rgb.x, std::min(rgb.y, rgb.z));
    if (least < 0) rgb = Vec3d(1) + (rgb - Vec3d(1)) * (1 / (1 - least));
    return {float(std::max(rgb.x, 0.)), float(std::max(rgb.y, 0.)), float(std::max(rgb.z, 0.))};
}

constexpr int kEntries = 1024;
constexpr double kLowest = 800, kHighest = 40000; // kelvin

/// Chromaticities at equal steps of 1 / kelvin.
std::array<Imath::V2d, kEntries> make_table() {
    std::array<Imath::V2d, kEntries> table;
    for (int i = 0; i < kEntries; ++i) {
        double const t = double(i) / (kEntries - 1);
        table[size_t(i)] = planck_chromaticity(1 / ((1 - t) / kHighest + t / kLowest));
    }
    return table;
}

} // namespace

Vec3d cie_xyz(double w) {
    return {1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) -
                0.065 * lobe(w, 501.1, 20.4, 26.2),
            0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1),
            1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8)};
}

Imath::V2d planck_chromaticity(double kelvin) {
    Vec3d sum(0);
    for (double w = 360; w <= 830; w += 2) sum += cie_xyz(w) * planck(w, kelvin);
    double const total = sum.x + sum.y + sum.z;
    return {sum.x / total, sum.y / total};
}

Color blackbody_color(float kelvin) {
    static std::array<Imath::V2d, kEntries> const table = make_table();
    double const k = std::clamp(double(kelvin), kLowest, kHighest);
    double const t = (1 / k - 1 / kHighest) / (1 / kLowest - 1 / kHighest) * (kEntries - 1);
    int const i = std::clamp(int(t), 0, kEntries - 2);
    double const f = t - i;
    return rgb_of(table[size_t(i)] * (1 - f) + table[size_t(i) + 1] * f);
}

} // namespace weft
