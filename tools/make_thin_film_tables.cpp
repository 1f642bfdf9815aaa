// Writes src/lobes/thin_film_tables.h: the Fourier transforms of the colour channels'
// sensitivities, on the grid of lobes/thin_film.h. Run it again whenever that grid changes:
//     g++ -std=c++20 -O2 -I/usr/include/Imath -Isrc tools/make_thin_film_tables.cpp -o make_tables
//     ./make_tables > src/lobes/thin_film_tables.h
//
// The sensitivities are the CIE 1931 colour matching functions (in the fits of Wyman, Sloan and
// Shirley 2013, "Simple analytic approximations to the CIE XYZ color matching functions", table 1)
// from 380 to 780 nm, turned to Rec. 709 primaries and each divided by its integral, so that a
// flat spectrum is white.
#include <array>
#include <complex>
#include <cstdio>

#include "lobes/thin_film.h"

namespace {

double lobe(double x, double mean, double below, double above) {
    double const t = (x - mean) / (x < mean ? below : above);
    return std::exp(-0.5 * t * t);
}

std::array<double, 3> sensitivity(double nm) {
    double const x = 1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                     0.065 * lobe(nm, 501.1, 20.4, 26.2);
    double const y = 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1);
    double const z = 1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8);
    return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
            -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
            0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
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
