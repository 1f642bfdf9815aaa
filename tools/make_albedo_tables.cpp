// Writes src/lobes/albedo_tables.h: directional albedos of the microfacet lobes on the grids of
// lobes/albedo.h, and the projected area of the Ashikhmin-Shirley distribution, all as 16-bit
// fractions. Run it again whenever distributions, shadowing or grids change:
//     g++ -std=c++20 -O2 -I/usr/include/Imath -Isrc tools/make_albedo_tables.cpp -o make_tables
//     ./make_tables > src/lobes/albedo_tables.h
//
// A normal m drawn for wo by the density of its distribution weighs F(wo.m) G2 / G1(wo) times the
// sampling area over sigma(wo), so that the albedo is the mean of that over the unit cube: here
// over a Hammersley set.
#include <array>
#include <cstdio>
#include <string>

#include "lobes/albedo.h"
#include "lobes/fresnel.h"

namespace {

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::albedo_grid;

double radical_inverse(uint32_t i, uint32_t base) {
    double sum = 0, digit = 1.0 / base;
    for (; i > 0; i /= base, digit /= base) sum += digit * (i % base);
    return sum;
}

constexpr uint32_t kSamples = 1 << 13;

/// A Hammersley set, off the ends of the intervals.
std::array<Vec3, kSamples> const points = [] {
    std::array<Vec3, kSamples> p;
    for (uint32_t i = 0; i < kSamples; ++i) {
        double const half = 0.5 / kSamples;
        p[i] = {float(i * 2 * half + half), float(radical_inverse(i, 2) + half),
                std::min(float(radical_inverse(i, 3) + half), kOneMinusEpsilon)};
    }
    return p;
}();

/// sigma = cos + the integral of D(m) max(0, -w.m); the integral over azimuths has a closed form.
double integrate_area(double alpha, double a) {
    constexpr int n = 20000;
    constexpr double half_pi = 1.57079632679489661923;
    double const start = std::atan(a) / half_pi;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        double const v = start + (1 - start) * (i + 0.5) / n, x = std::tan(v * half_pi);
        double const t2 = alpha * alpha * x * x, k = std::min(a / x, 1.0);
        // D sin^2 dtheta, all in x = tan(theta) / alpha.
        double const density = std::exp(-std::log1p(t2) * (1 / (alpha * alpha) - 1));
        double const measure = x * x / ((1 + t2) * (1 + t2)) * (1 + x * x) * half_pi;
        sum += density / (2 * half_pi) * measure * 2 * (std::sqrt(1 - k * k) - k * std::acos(k));
    }
    return sum * (1 - start) / n;
}

struct Integral {
    ReflectionMoments white;
    DielectricAlbedo dielectric;
};

/// `eta` = 0 leaves out the dielectric.
template <class Distribution>
Integral integrate(Distribution const& d, Vec3 const& wo, float eta) {
    float const sigma_o = d.projected_area(wo);
    double white = 0, schlick = 0, edge = 0, first = 0, second = 0, reflected = 0, transmitted = 0;
    for (Vec3 const& u : points) {
        float spare = u.z;
        Vec3 const m = d.sample_visible_normal(wo, {u.x, u.y}, spare);
        float const cos_m = std::min(dot(wo, m), 1.f);
        if (!(cos_m > 0)) continue;
        float const scale = d.sampling_area(wo, m, sigma_o) / (sigma_o * kSamples);
        float cos_t = 0;
        float const fresnel = eta > 0 ? fresnel_dielectric(cos_m, eta, cos_t) : 1.f;
        Vec3 const r = reflect(wo, m);
        if (r.z > 0) {
            double const w = scale * shadowing_above(wo.z, sigma_o, r.z, d.projected_area(r));
            double const s = 1 - cos_m, s5 = s * s * s * s * s;
            white += w;
            schlick += w * s5;
            edge += w * s5 * s * cos_m;
            first += w * cos_m;
            second += w * cos_m * cos_m;
            reflected += w * fresnel;
        }
        if (!(fresnel < 1)) continue;
        Vec3 const t = refract(wo, m, cos_m, cos_t, eta);
        if (t.z < 0) {
            transmitted +=
                scale * (1 - fresnel) * shadowing_across(wo.z, sigma_o, -t.z, d.projected_area(t));
        }
    }
    double const mean = first / white;
    double const variance = std::max(second / white - mean * mean, 0.0);
    return {{float(white), float(schlick), float(edge), float(mean), float(std::sqrt(variance))},
            {float(reflected), float(transmitted)}};
}

/// Prints 16-bit fractions, comma after comma, in lines of at most 100 columns.
class Writer {
  public:
    void open(std::string const& name) {
        std::printf("inline constexpr uint16_t %s[] = {\n", name.c_str());
    }
    void value(double fraction) {
        std::string const text =
            std::to_string(int(std::min(std::max(fraction, 0.0), 1.0) * 65535 + 0.5)) + ",";
        if (line_.size() + text.size() > 100) flush();
        line_ += text;
    }
    void close() {
        flush();
        std::printf("};\n");
    }

  private:
    void flush() {
        if (!line_.empty()) std::printf("%s\n", line_.c_str());
        line_.clear();
    }
    std::string line_;
};

float node(int i, int nodes) { return float(i) / float(nodes - 1); }

// The ends of the axes stand for limits that the lobes themselves do not take.
float alpha_node(int i, int nodes) { return std::max(alpha_at(node(i, nodes)), 1e-3f); }
/// The unit vector at a cosine, towards (u, v).
Vec3 direction(float cosine, float u, float v) {
    float const c = std::max(cosine, 1e-4f), s = safe_sqrt(1 - c * c) / std::sqrt(u * u + v * v);
    return {s * u, s * v, c};
}

void write_area(Writer& out) {
    out.open("ashikhmin_shirley_area");
    for (int i = 0; i < area_alphas; ++i) {
        for (int j = 0; j < area_slopes; ++j) {
            bool const last = j + 1 == area_slopes;
            out.value(last ? 0
                           : integrate_area(std::max(node(i, area_alphas), 1e-3f),
                                            area_slope_at(node(j, area_slopes))));
        }
    }
    out.close();
}

template <class Distribution>
void write_reflection(Writer& out, std::string const& name) {
    std::array<ReflectionMoments, alphas * reflection_cosines> all;
    for (int a = 0; a < alphas; ++a) {
        Distribution const d{alpha_node(a, alphas), alpha_node(a, alphas)};
        for (int c = 0; c < reflection_cosines; ++c)
            all[size_t(a * reflection_cosines + c)] =
                integrate(
                    d, direction(fresnel_cosine_at(node(c, reflection_cosines), d.alpha_x), 1, 0),
                    0)
                    .white;
    }
    out.open(name + "_reflection");
    for (auto const member :
         {&ReflectionMoments::white, &ReflectionMoments::schlick, &ReflectionMoments::edge,
          &ReflectionMoments::mean, &ReflectionMoments::deviation})
        for (ReflectionMoments const& m : all) out.value(m.*member);
    out.close();

    out.open(name + "_anisotropic");
    for (int g = 0; g < greater_alphas; ++g)
        for (int r = 0; r < alpha_ratios; ++r) {
            float const greater = alpha_node(g, greater_alphas);
            Distribution const d{greater,
                                 std::max(greater * alpha_at(node(r, alpha_ratios)), 1e-3f)};
            for (int p = 0; p < azimuths; ++p)
                for (int c = 0; c < anisotropic_cosines; ++c) {
                    float const v = node(p, azimuths);
                    out.value(integrate(d,
                                        direction(cosine_at(node(c, anisotropic_cosines), greater),
                                                  1 - v, v),
                                        0)
                                  .white.white);
                }
        }
    out.close();
}

template <class Distribution>
void write_dielectric(Writer& out, std::string const& name) {
    std::array<std::array<DielectricAlbedo, indices * dielectric_alphas * cosines>, 2> sides;
    for (int leaving = 0; leaving < 2; ++leaving)
        for (int e = 0; e < indices; ++e)
            for (int a = 0; a < dielectric_alphas; ++a)
                for (int c = 0; c < cosines; ++c) {
                    // Total reflection does not fade as the indices meet: it shrinks. The
                    // first node stands for that limit rather than for equal indices.
                    float const ratio = std::max(index_at(node(e, indices)), 1.001f);
                    float const u = node(c, cosines), alpha = alpha_node(a, dielectric_alphas);
                    float const eta = leaving ? 1 / ratio : ratio;
                    float const cos_o =
                        leaving ? leaving_cosine_at(u, eta, alpha) : fresnel_cosine_at(u, alpha);
                    sides[size_t(leaving)][size_t((e * dielectric_alphas + a) * cosines + c)] =
                        integrate(Distribution{alpha, alpha}, direction(cos_o, 1, 0), eta)
                            .dielectric;
                }
    out.open(name + "_dielectric");
    for (auto const& side : sides) {
        for (DielectricAlbedo const& albedo : side)
            out.value(double(power_coordinate(albedo.reflected + albedo.transmitted)));
        for (DielectricAlbedo const& albedo : side) out.value(double(albedo.reflected));
    }
    out.close();
}

template <class Distribution>
void write_tables(Writer& out, std::string const& name) {
    write_reflection<Distribution>(out, name);
    write_dielectric<Distribution>(out, name);
}

} // namespace

/// The library looks this up in the table that is being made.
float weft::lobes::ashikhmin_shirley_area(float alpha, float a) {
    static auto const table = [] {
        std::array<std::array<float, area_slopes>, area_alphas> t{};
        for (int i = 0; i < area_alphas; ++i)
            for (int j = 0; j + 1 < area_slopes; ++j)
                t[size_t(i)][size_t(j)] = float(integrate_area(
                    std::max(node(i, area_alphas), 1e-3f), area_slope_at(node(j, area_slopes))));
        return t;
    }();
    float const x = std::min(alpha, 1.f) * (area_alphas - 1),
                y = area_slope_coordinate(a) * (area_slopes - 1);
    auto const i = size_t(std::min(int(x), area_alphas - 2)),
               j = size_t(std::min(int(y), area_slopes - 2));
    float const s = x - float(i), t = y - float(j);
    return lerp(lerp(table[i][j], table[i][j + 1], t),
                lerp(table[i + 1][j], table[i + 1][j + 1], t), s);
}

int main() {
    std::printf(
        "// Written by tools/make_albedo_tables.cpp; see lobes/albedo.h for the axes.\n"
        "// clang-format off\n"
        "#pragma once\n\n"
        "#include <cstdint>\n\n"
        "namespace weft::lobes::albedo_tables {\n\n"
        "// In 1 / 65535. Reflection: [moment][alpha][cosine]. Anisotropic:\n"
        "// [greater alpha][ratio][azimuth][cosine]. Dielectric:\n"
        "// [entering, leaving][power_coordinate(all), reflected][index][alpha][cosine]. Area:\n"
        "// [alpha][slope].\n");
    Writer out;
    write_area(out);
    write_tables<Ggx>(out, "ggx");
    write_tables<Beckmann>(out, "beckmann");
    write_tables<AshikhminShirley>(out, "ashikhmin_shirley");
    std::printf("\n} // namespace weft::lobes::albedo_tables\n");
}
