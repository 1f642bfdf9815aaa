#include "lobes/thin_film.h"

#include <array>
#include <complex>

#include "lobes/thin_film_tables.h"

namespace weft::lobes {

namespace {

using Complex = std::complex<float>;
using namespace thin_film_grid;

/// Spelled out: std::complex checks products for NaN.
Complex product(Complex const& a, Complex const& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
Complex quotient(Complex const& a, Complex const& b) {
    return product(a, std::conj(b)) * (1 / std::norm(b));
}
/// The root with both parts >= 0 of a number with imaginary part >= 0.
Complex root(Complex const& a) {
    float const size = std::sqrt(std::norm(a));
    return {safe_sqrt(0.5f * (size + a.real())), safe_sqrt(0.5f * (size - a.real()))};
}

/// Amplitudes of one interface for both polarisations. Angles come as n cos, indices as n.
struct Amplitudes {
    Complex perpendicular, parallel;
};
Amplitudes interface(Complex const& n_a, Complex const& cos_a, Complex const& n_b,
                     Complex const& cos_b) {
    Complex const sa = product(n_a, cos_a), sb = product(n_b, cos_b);
    Complex const pa = product(n_b, cos_a), pb = product(n_a, cos_b);
    return {quotient(sa - sb, sa + sb), quotient(pa - pb, pa + pb)};
}

using Sensitivity = std::array<Complex, 3>;

/// S of the three channels at a path difference in nm below the grid's end; Catmull-Rom between
/// nodes, which are mirrored at 0 (S(-x) is the conjugate of S(x)).
Sensitivity sensitivity(float difference) {
    float const x = difference * (1 / spacing);
    int const i = int(x);
    float const t = x - float(i), t2 = t * t, t3 = t2 * t;
    float const w[4] = {0.5f * (2 * t2 - t - t3), 1 + 0.5f * (3 * t3 - 5 * t2),
                        0.5f * (4 * t2 + t - 3 * t3), 0.5f * (t3 - t2)};
    float const* const p = thin_film_tables::sensitivity + 6 * i;
    float const* const before = i > 0 ? p - 6 : p + 6;
    float const mirror = i > 0 ? 1.f : -1.f;
    Sensitivity s;
    for (int c = 0; c < 3; ++c) {
        int const re = 2 * c, im = 2 * c + 1;
        s[size_t(c)] = {w[0] * before[re] + w[1] * p[re] + w[2] * p[6 + re] + w[3] * p[12 + re],
                        w[0] * mirror * before[im] + w[1] * p[im] + w[2] * p[6 + im] +
                            w[3] * p[12 + im]};
    }
    return s;
}

/// One polarisation at one channel: the running term of the series and its sum.
struct Series {
    float k = 0;
    Complex minus_q, power{1, 0};
    float sum = 1;

    Series(float r12, Complex const& r23) : minus_q(-r12 * r23) {
        float const q2 = std::norm(minus_q);
        if (q2 < 1) k = (1 - r12 * r12) * std::max(1 - std::norm(r23), 0.f) / (1 - q2);
    }
    void add(Complex const& s) {
        power = product(power, minus_q);
        sum += 2 * product(power, s).real();
    }
    float ratio() const { return std::sqrt(std::norm(minus_q)); }
    float reflectance() const { return 1 - k * sum; }
};

/// The film as seen from wo's side under one cosine.
class FilmView {
  public:
    FilmView(ThinFilm const& film, float cos_o)
        : cos_o_(std::min(std::max(cos_o, 1e-4f), 1.f)), eta_(film.ior / film.outer_ior) {
        // (eta cos_f)^2, arranged so that indices next to 1 keep their digits.
        float const k2 = (eta_ - 1) * (eta_ + 1) + cos_o_ * cos_o_;
        float const cos_f = std::sqrt(std::abs(k2)) / eta_;
        tunnels_ = k2 <= 0;
        cos_f_ = tunnels_ ? Complex(0, cos_f) : Complex(cos_f, 0);
        path_ = 2 * film.thickness * film.ior * cos_f;
        top_ = interface(1, cos_o_, eta_, cos_f_);
    }

    /// The amplitudes under the film, over a base of this index relative to wo's side.
    Amplitudes bottom(Complex const& base) const {
        Complex const ratio = quotient(1, base);
        float const sin2 = 1 - cos_o_ * cos_o_;
        return interface(eta_, cos_f_, base, root(1.f - product(ratio, ratio) * sin2));
    }

    Color reflectance(std::array<Amplitudes, 3> const& bottoms) const {
        std::array<float, 3> const r = tunnels_ ? tunnelling(bottoms) : series(bottoms);
        auto const cut = [](float x) { return std::min(std::max(x, 0.f), 1.f); };
        return {cut(r[0]), cut(r[1]), cut(r[2])};
    }

  private:
    std::array<float, 3> series(std::array<Amplitudes, 3> const& bottoms) const {
        constexpr float negligible = 2e-3f, end = spacing * (nodes - 2);
        float const s12 = top_.perpendicular.real(), p12 = top_.parallel.real();
        std::array<Series, 6> all{
            Series(s12, bottoms[0].perpendicular), Series(p12, bottoms[0].parallel),
            Series(s12, bottoms[1].perpendicular), Series(p12, bottoms[1].parallel),
            Series(s12, bottoms[2].perpendicular), Series(p12, bottoms[2].parallel)};
        float k = 0, ratio = 0;
        for (Series const& s : all) {
            k = std::max(k, s.k);
            ratio = std::max(ratio, s.ratio());
        }
        float difference = path_;
        // All terms from here on sum to at most `rest`.
        for (float rest = 2 * k * ratio / (1 - ratio); rest > negligible && difference < end;
             rest *= ratio, difference += path_) {
            Sensitivity const s = sensitivity(difference);
            for (size_t i = 0; i < 6; ++i) all[i].add(s[i / 2]);
        }
        auto const channel = [&](size_t c) {
            return 0.5f * (all[2 * c].reflectance() + all[2 * c + 1].reflectance());
        };
        return {channel(0), channel(1), channel(2)};
    }

    std::array<float, 3> tunnelling(std::array<Amplitudes, 3> const& bottoms) const {
        std::array<float, 3> r{};
        for (int i = 0; i < wavelengths; ++i) {
            float const z = std::exp(-2 * kPi / wavelength(i) * path_);
            auto const airy = [z](Complex const& r12, Complex const& r23) {
                return std::norm(r12 + r23 * z) / std::norm(1.f + product(r12, r23) * z);
            };
            for (size_t c = 0; c < 3; ++c) {
                r[c] += 0.5f * thin_film_tables::weights[3 * size_t(i) + c] *
                        (airy(top_.perpendicular, bottoms[c].perpendicular) +
                         airy(top_.parallel, bottoms[c].parallel));
            }
        }
        return r;
    }

    float cos_o_, eta_, path_;
    bool tunnels_;
    Complex cos_f_;
    Amplitudes top_;
};

} // namespace

Color thin_film_reflectance(ThinFilm const& film, float cos_o, Color const& eta, Color const& k) {
    FilmView const view(film, cos_o);
    return view.reflectance(
        {view.bottom({eta.r, k.r}), view.bottom({eta.g, k.g}), view.bottom({eta.b, k.b})});
}

Color thin_film_reflectance(ThinFilm const& film, float cos_o, float eta) {
    if ((eta - 1) * (eta + 1) + cos_o * cos_o <= 0) return Color(1); // nothing to go on in
    FilmView const view(film, cos_o);
    Amplitudes const bottom = view.bottom(eta);
    return view.reflectance({bottom, bottom, bottom});
}

} // namespace weft::lobes
