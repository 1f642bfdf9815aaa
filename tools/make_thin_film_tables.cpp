// Writes src/lobes/thin_film_tables.h: the Fourier transforms of the colour channels'
// sensitivities, on the grid of lobes/thin_film.h. Run it again whenever that grid changes:
//     g++ -std=c++20 -O2 -I/usr/include/Imath -Isrc tools/make_thin_film_tables.cpp -o make_tables
//     ./make_tables > src/lobes/thin_film_tables.h
//
// The sensitivities are the CIE 1931 colour matching functions (in the fits of Wyman, Sloan and
// Shirley 2013, "Simple analytic approximations to the CIE XYZ color matching functions", table 1)
// times the spectrum of the illuminant D65 (CIE 15) from 380 to 780 nm, turned to Rec. 709
// primaries, whose white it is. So a flat reflectance is white, and colours are those of a film in
// the white light of the pictures. What the fits' white is off by (0.0005) is divided out.
#include <algorithm>
#include <array>
#include <complex>
#include <cstdio>

#include "lobes/thin_film.h"

namespace {

/// Relative power of D65, every 10 nm from 380 to 780.
constexpr std::array<double, 41> d65{49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865,
                                     117.008, 117.812, 114.861, 115.923, 108.811, 109.354, 107.802,
                                     104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880,
                                     88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
                                     80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040,
                                     69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828};

/// Linear between the table's values, as CIE 15 has it.
double illuminant(double nm) {
    double const x = (nm - 380) / 10;
    auto const i = std::min(size_t(x), d65.size() - 2);
    return d65[i] + (d65[i + 1] - d65[i]) * (x - double(i));
}

double lobe(double x, double mean, double below, double above) {
    double const t = (x - mean) / (x < mean ? below : above);
    return std::exp(-0.5 * t * t);
}

std::array<double, 3> sensitivity(double nm) {
    double const x = 1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                     0.065 * lobe(nm, 501.1, 20.4, 26.2);
    double const y = 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1);
    double const z = 1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8);
    double const light = illuminant(nm);
    return {light * (3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
            light * (-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
            light * (0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

} // namespace

int main() {
    using namespace weft::lobes::thin_film_grid;
    std::printf("// Written by tools/make_thin_film_tables.cpp; see lobes/thin_film.h.\n"
                "// clang-format off\n"
                "#pragma once\n\n"
                "namespace weft::lobes::thin_film_tables {\n\n"
                "// [path difference][red, green, blue][real, imaginary]\n"
                "inline constexpr float sensitivity[] = {\n");
    for (int i = 0; i < nodes; ++i) {
        std::array<std::complex<double>, 3> sum{};
        std::array<double, 3> total{};
        for (double nm = 380.05; nm < 780; nm += 0.1) {
            auto const s = sensitivity(nm);
            for (size_t c = 0; c < 3; ++c) {
                sum[c] += std::polar(s[c], 2 * 3.14159265358979323846 * i * spacing / nm);
                total[c] += s[c];
            }
        }
        for (size_t c = 0; c < 3; ++c)
            std::printf("%.5ff,%.5ff,", sum[c].real() / total[c], sum[c].imag() / total[c]);
        std::printf("\n");
    }
    std::printf("};\n\n// [wavelength][red, green, blue]; each channel sums to 1\n"
                "inline constexpr float weights[] = {\n");
    std::array<double, 3> total{};
    for (int i = 0; i < wavelengths; ++i)
        for (size_t c = 0; c < 3; ++c) total[c] += sensitivity(wavelength(i))[c];
    for (int i = 0; i < wavelengths; ++i) {
        for (size_t c = 0; c < 3; ++c)
            std::printf("%.5ff,", sensitivity(wavelength(i))[c] / total[c]);
        std::printf("\n");
    }
    std::printf("};\n\n} // namespace weft::lobes::thin_film_tables\n");
}
