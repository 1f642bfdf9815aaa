// Thin films against the Airy summation integrated over the spectrum.
#include <complex>
#include <cstdio>

#include <gtest/gtest.h>

#include "base/hash.h"
#include "lobes/fresnel.h"
#include "lobes/thin_film.h"

using namespace weft;
using namespace weft::lobes;

namespace {

using Complex = std::complex<double>;

/// The relative power of D65, the pictures' white, every 10 nm from 380 to 780 (CIE 15).
constexpr double kD65[41] = {49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865,
                             117.008, 117.812, 114.861, 115.923, 108.811, 109.354, 107.802,
                             104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880,
                             88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
                             80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040,
                             69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828};

/// The fits of Wyman, Sloan and Shirley 2013 to the CIE 1931 curves under D65, in linear Rec. 709.
std::array<double, 3> sensitivity(double nm) {
    auto const g = [nm](double mean, double below, double above) {
        return std::exp(-0.5 * std::pow((nm - mean) / (nm < mean ? below : above), 2));
    };
    double const x =
        1.056 * g(599.8, 37.9, 31.0) + 0.362 * g(442.0, 16.0, 26.7) - 0.065 * g(501.1, 20.4, 26.2);
    double const y = 0.821 * g(568.8, 46.9, 40.5) + 0.286 * g(530.9, 16.3, 31.1);
    double const z = 1.217 * g(437.0, 11.8, 36.0) + 0.681 * g(459.0, 26.0, 13.8);
    size_t const i = std::min(size_t((nm - 380) / 10), size_t(39));
    double const light = kD65[i] + (kD65[i + 1] - kD65[i]) * ((nm - 380) / 10 - double(i));
    return {light * (3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
            light * (-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
            light * (0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

/// Reflectance at one wavelength by the characteristic matrix of the layer (Born and Wolf 1999,
/// 1.6), so that nothing is shared with what is tested. Absolute indices.
double stack_reflectance(double n_outer, double n_film, Complex n_base, double cos_o,
                         double thickness_over_wavelength) {
    double const s = n_outer * std::sqrt(1 - cos_o * cos_o);
    auto const cosine = [s](Complex n) {
        Complex const c = std::sqrt(1.0 - (s / n) * (s / n));
        return c.imag() < 0 ? -c : c; // waves that decay
    };
    Complex const cos_f = cosine(n_film), cos_b = cosine(n_base);
    Complex const delta = 2 * 3.14159265358979323846 * thickness_over_wavelength * n_film * cos_f;
    double sum = 0;
    for (bool const perpendicular : {true, false}) {
        auto const admittance = [&](Complex n, Complex c) { return perpendicular ? n * c : n / c; };
        Complex const y0 = admittance(n_outer, cos_o), y1 = admittance(n_film, cos_f),
                      y2 = admittance(n_base, cos_b), i(0, 1);
        Complex const b = std::cos(delta) - i * std::sin(delta) * y2 / y1;
        Complex const c = y2 * std::cos(delta) - i * std::sin(delta) * y1;
        sum += 0.5 * std::norm((y0 * b - c) / (y0 * b + c));
    }
    return sum;
}

/// Indices per channel, cut to [0, 1] as the gamut.
Color reference(ThinFilm const& film, double cos_o, std::array<Complex, 3> const& base) {
    std::array<double, 3> sum{}, total{};
    for (double nm = 380.5; nm < 780; nm += 1) {
        auto const s = sensitivity(nm);
        double r = 0;
        for (size_t c = 0; c < 3; ++c) {
            if (c == 0 || base[c] != base[c - 1])
                r = stack_reflectance(film.outer_ior, film.ior, base[c], cos_o,
                                      film.thickness / nm);
            sum[c] += s[c] * r;
            total[c] += s[c];
        }
    }
    auto const cut = [&](size_t c) {
        return float(std::min(std::max(sum[c] / total[c], 0.0), 1.0));
    };
    return {cut(0), cut(1), cut(2)};
}

struct Errors {
    double sum = 0, worst = 0;
    int count = 0;
    std::string where;
    void add(Color const& a, Color const& b, std::string const& at) {
        for (int c = 0; c < 3; ++c) {
            double const e = std::abs(a[c] - b[c]);
            sum += e;
            ++count;
            if (e > worst) {
                worst = e;
                where = at + " channel " + std::to_string(c) + ": " + std::to_string(a[c]) +
                        " instead of " + std::to_string(b[c]);
            }
        }
    }
};

constexpr float kCosines[] = {1.f, 0.8f, 0.6f, 0.4f, 0.2f, 0.1f, 0.03f};

std::string place(ThinFilm const& f, float cos_o, float eta) {
    char text[160];
    std::snprintf(text, sizeof text, "%g nm of %g under %g, base %g, cosine %g",
                  double(f.thickness), double(f.ior), double(f.outer_ior), double(eta),
                  double(cos_o));
    return text;
}

TEST(ThinFilm, OverDielectricsIsTheSpectralIntegral) {
    Errors inside, tunnelling;
    for (float thickness = 1; thickness <= 1001; thickness += 50) {
        for (float const ior : {1.2f, 1.33f, 1.5f, 1.8f, 2.4f}) {
            for (auto const& [outer, base] :
                 {std::pair(1.f, 1.f), std::pair(1.f, 1.33f), std::pair(1.f, 1.5f),
                  std::pair(1.f, 2.4f), std::pair(1.5f, 1.f), std::pair(1.33f, 1.5f)}) {
                for (float const cos_o : kCosines) {
                    ThinFilm const film{thickness, ior, outer};
                    Complex const n(double(base), 0);
                    Color const value = thin_film_reflectance(film, cos_o, base / outer);
                    bool const tunnels = outer * std::sqrt(1 - cos_o * cos_o) > ior;
                    (tunnels ? tunnelling : inside)
                        .add(value, reference(film, double(cos_o), {n, n, n}),
                             place(film, cos_o, base));
                }
            }
        }
    }
    std::printf("over dielectrics: mean error %.5f, worst %.4f\n", inside.sum / inside.count,
                inside.worst);
    std::printf("tunnelling: mean error %.5f, worst %.4f\n", tunnelling.sum / tunnelling.count,
                tunnelling.worst);
    EXPECT_LE(inside.worst, 0.02) << inside.where;
    EXPECT_LE(tunnelling.worst, 0.02) << tunnelling.where;
}

TEST(ThinFilm, OverConductorsIsTheSpectralIntegral) {
    struct Metal {
        Color eta, k;
    };
    Errors errors;
    for (Metal const& m : {Metal{Color(0.14f, 0.37f, 1.44f), Color(3.98f, 2.38f, 1.6f)},
                           Metal{Color(1.4f, 0.9f, 0.6f), Color(7.4f, 6.4f, 5.4f)},
                           Metal{Color(2.9f, 2.9f, 2.6f), Color(3.1f, 2.9f, 2.8f)},
                           Metal{Color(0.05f), Color(4.2f, 3.5f, 2.4f)}}) {
        for (float thickness = 1; thickness <= 1001; thickness += 50) {
            for (float const ior : {1.2f, 1.33f, 1.5f, 1.8f, 2.4f}) {
                for (float const cos_o : kCosines) {
                    ThinFilm const film{thickness, ior};
                    auto const n = [&](int c) { return Complex(double(m.eta[c]), double(m.k[c])); };
                    errors.add(thin_film_reflectance(film, cos_o, m.eta, m.k),
                               reference(film, double(cos_o), {n(0), n(1), n(2)}),
                               place(film, cos_o, m.eta.g));
                }
            }
        }
    }
    std::printf("over conductors: mean error %.5f, worst %.4f\n", errors.sum / errors.count,
                errors.worst);
    EXPECT_LE(errors.worst, 0.02) << errors.where;
}

TEST(ThinFilm, VanishesAsItThins) {
    for (float const cos_o : kCosines) {
        for (float const eta : {1.33f, 1.5f, 1 / 1.5f}) {
            Color const r = thin_film_reflectance({1e-3f, 1.4f}, cos_o, eta);
            EXPECT_NEAR(r.g, fresnel_dielectric(cos_o, eta), 4e-3) << cos_o << " " << eta;
        }
        Color const eta(0.14f, 0.37f, 1.44f), k(3.98f, 2.38f, 1.6f);
        Color const r = thin_film_reflectance({1e-3f, 1.4f}, cos_o, eta, k);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(r[c], fresnel_conductor(cos_o, eta, k)[c], 4e-3) << cos_o;
    }
}

TEST(ThinFilm, IsTheSameFromBehind) {
    Rng rng(11);
    for (int i = 0; i < 20000; ++i) {
        float const eta = std::exp(rng.next() * 1.6f - 0.8f), cos_o = rng.next();
        float cos_t;
        if (fresnel_dielectric(cos_o, eta, cos_t) == 1 || cos_t < 1e-3f || cos_o < 1e-3f) continue;
        float const outer = eta < 1 ? 1 / eta : 1.f;
        ThinFilm const film{1000 * rng.next(), 1 + 1.5f * rng.next(), outer};
        ThinFilm const behind{film.thickness, film.ior, outer * eta};
        Color const there = thin_film_reflectance(film, cos_o, eta);
        Color const back = thin_film_reflectance(behind, cos_t, 1 / eta);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(there[c], back[c], 4e-3) << place(film, cos_o, eta);
    }
}

} // namespace
