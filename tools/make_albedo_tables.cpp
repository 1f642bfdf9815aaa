// Writes src/lobes/albedo_tables.h: directional albedos of the microfacet lobes on the grids of
// lobes/albedo.h, and the projected area of the Ashikhmin-Shirley distribution, all as 16-bit
// fractions. Run it again whenever distributions, shadowing or grids change (some minutes):
//     g++ -std=c++20 -O3 -pthread -I/usr/include/Imath -Isrc tools/make_albedo_tables.cpp -o tables
//     ./tables > src/lobes/albedo_tables.h
//
// Normals m are drawn with weights that turn their mean into the integral of D(m) max(0, wo.m) /
// sigma(wo), so that the albedo is the mean of F(wo.m) G2 / G1(wo). Points are those of a Fibonacci
// lattice, which leave errors below 3e-4 of a value, and mostly below 3e-5. All is in double
// precision and by formulas of its own, except for what defines the lobes' values; so the lobes'
// tests compare two ways.
#include <array>
#include <atomic>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "lobes/albedo.h"

namespace {

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::albedo_grid;

constexpr int kSamples = 17711; // a Fibonacci number
constexpr double kGoldenRatio = 0.61803398874989484820, kPiD = 3.14159265358979323846;

double square(double x) { return x * x; }

/// A facet's normal, and its share of the projected area.
struct Facet {
    Vec3d m;
    double weight;
};

/// What is common to the distributions. `half`: the surface is even in y and so is what is
/// integrated, so that normals of one side will do.
struct View {
    double alpha_x, alpha_y;
    Vec3d wo;
    bool half;
};

/// By spherical caps, the tail drawn densely: a third power.
struct GgxSampler {
    static double area(View const& v, Vec3d const& w) {
        double const s2 = square(v.alpha_x * w.x) + square(v.alpha_y * w.y);
        return 0.5 * (std::abs(w.z) + std::sqrt(s2 + w.z * w.z));
    }
    explicit GgxSampler(View const& v)
        : view(v), w(normalize(Vec3d(v.alpha_x * v.wo.x, v.alpha_y * v.wo.y, v.wo.z))) {}
    Facet operator()(double t, double u) const {
        double const above = std::pow(1 - t, 3) * (1 + w.z), phi = kPiD * (view.half ? u : 2 * u);
        double const one_plus_z = above + (w.x * w.x + w.y * w.y) / (1 + w.z);
        double const r = std::sqrt(std::max(one_plus_z * (2 - one_plus_z), 0.0));
        return {normalize(Vec3d(view.alpha_x * (r * std::cos(phi) + w.x),
                                view.alpha_y * (r * std::sin(phi) + w.y), above)),
                3 * square(1 - t)};
    }
    View const view;
    Vec3d const w;
};

/// By D(m) m.z.
struct BeckmannSampler {
    static double area(View const& v, Vec3d const& w) {
        double const s = std::sqrt(square(v.alpha_x * w.x) + square(v.alpha_y * w.y));
        double const z = std::abs(w.z);
        if (z > 6 * s) return z;
        double const a = z / s;
        return 0.5 * (z * (1 + std::erf(a)) + s / std::sqrt(kPiD) * std::exp(-a * a));
    }
    explicit BeckmannSampler(View const& v) : view(v), area_o(area(v, v.wo)) {}
    Facet operator()(double t, double u) const {
        double const slope = std::sqrt(-std::log1p(-t)), psi = kPiD * (view.half ? u : 2 * u);
        Vec3d const m(view.alpha_x * slope * std::cos(psi), view.alpha_y * slope * std::sin(psi),
                      1);
        return {normalize(m), std::max(dot(view.wo, m), 0.0) / area_o};
    }
    View const view;
    double const area_o;
};

/// By D(m) m.z, the tail drawn densely.
struct AshikhminShirleySampler {
    static double area(View const& v, Vec3d const& w) {
        double const z = std::abs(w.z);
        double const t = std::sqrt(square(v.alpha_x * w.x) + square(v.alpha_y * w.y));
        if (!(t > 0)) return z;
        float const greater = float(std::max(v.alpha_x, v.alpha_y));
        return z + t * double(ashikhmin_shirley_area(greater, float(z / t)));
    }
    explicit AshikhminShirleySampler(View const& v) : view(v), area_o(area(v, v.wo)) {}
    Facet operator()(double t, double u) const {
        double const psi = kPiD * (view.half ? u : 2 * u);
        double const x = view.alpha_x * std::cos(psi), y = view.alpha_y * std::sin(psi);
        double const r2 = x * x + y * y, log_z = 1.5 * r2 * std::log1p(-t);
        double const scale = std::sqrt(-std::expm1(2 * log_z) / r2);
        Vec3d const m(x * scale, y * scale, std::exp(log_z));
        return {m, 3 * square(1 - t) * std::max(dot(view.wo, m), 0.0) / (m.z * area_o)};
    }
    View const view;
    double const area_o;
};

struct Integral {
    double white = 0, schlick = 0, edge = 0;
    double reflected = 0, transmitted = 0;
};
using Integrals = std::array<Integral, 2>; ///< by Shadowing

/// Both cosines of an interface in double precision; 1 under total reflection.
double fresnel(double cos_o, double eta, double& cos_t) {
    double const k = (eta - 1) * (eta + 1) + cos_o * cos_o;
    cos_t = k > 0 ? std::sqrt(k) / eta : 0;
    if (!(k > 0)) return 1;
    double const perpendicular = (cos_o - eta * cos_t) / (cos_o + eta * cos_t);
    double const parallel = (eta * cos_o - cos_t) / (eta * cos_o + cos_t);
    return 0.5 * (square(perpendicular) + square(parallel));
}

/// `eta` = 0 leaves out the dielectric.
template <class Sampler>
Integrals integrate(View const& view, double eta) {
    Integrals sums;
    Sampler const sample(view);
    Vec3d const& wo = view.wo;
    double const area_o = Sampler::area(view, wo);
    for (int i = 0; i < kSamples; ++i) {
        double const turn = i * kGoldenRatio + 0.5 / kSamples;
        Facet const facet = sample((i + 0.5) / kSamples, turn - std::floor(turn));
        Vec3d const& m = facet.m;
        double const cos_m = std::min(dot(wo, m), 1.0), share = facet.weight / kSamples;
        if (!(cos_m > 0 && share > 0)) continue;
        double cos_t = 0;
        double const f = eta > 0 ? fresnel(cos_m, eta, cos_t) : 1.0;
        Vec3d const r = m * (2 * cos_m) - wo;
        Vec3d const t = m * (cos_m / eta - cos_t) - wo * (1 / eta);
        double const area_r = Sampler::area(view, r);
        double const area_t = f < 1 ? Sampler::area(view, t) : 0;
        double const s = 1 - cos_m, s5 = s * s * s * s * s;
        for (size_t k = 0; k < 2; ++k) {
            auto const shadowing = Shadowing(k);
            Integral& sum = sums[k];
            if (r.z > 0) {
                double const w =
                    share * double(shadowing_above(shadowing, float(wo.z), float(area_o),
                                                   float(r.z), float(area_r)));
                sum.white += w;
                sum.schlick += w * s5;
                sum.edge += w * s5 * s * cos_m;
                sum.reflected += w * f;
            }
            if (f < 1 && t.z < 0)
                sum.transmitted += share * (1 - f) *
                                   double(shadowing_across(shadowing, float(wo.z), float(area_o),
                                                           float(-t.z), float(area_t)));
        }
    }
    return sums;
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

double node(int i, int nodes) { return double(i) / (nodes - 1); }

/// The unit vector at a cosine, towards (u, v). Grazing ones stay off what lobes do not take.
Vec3d direction(double cosine, double u, double v) {
    double const c = std::min(std::max(cosine, 1e-5), 1.0);
    double const s = std::sqrt((1 - c) * (1 + c)) / std::sqrt(u * u + v * v);
    return {s * u, s * v, c};
}

/// Calls f(i) for all i below n, from all cores.
template <class F>
void for_all(int n, F&& f) {
    std::atomic<int> next = 0;
    std::vector<std::jthread> threads;
    for (unsigned k = 0; k < std::max(std::thread::hardware_concurrency(), 1u); ++k)
        threads.emplace_back([&] {
            for (int i; (i = next++) < n;) f(i);
        });
}

template <class Sampler>
void write_reflection(Writer& out, std::string const& name) {
    std::vector<Integrals> all(size_t(alphas) * cosines);
    for_all(int(all.size()), [&](int i) {
        double const alpha = double(alpha_at(float(node(i / cosines, alphas))));
        double const c = cosine_at(node(i % cosines, cosines), float(alpha));
        all[size_t(i)] = integrate<Sampler>({alpha, alpha, direction(c, 1, 0), true}, 0);
    });
    out.open(name + "_reflection");
    for (size_t k = 0; k < 2; ++k)
        for (auto const moment : {&Integral::white, &Integral::schlick, &Integral::edge})
            for (Integrals const& i : all) out.value(i[k].*moment);
    out.close();
}

template <class Sampler>
void write_anisotropic(Writer& out, std::string const& name) {
    std::vector<Integrals> all(size_t(greater_alphas) * alpha_ratios * azimuths *
                               anisotropic_cosines);
    for_all(int(all.size()), [&](int i) {
        int const c = i % anisotropic_cosines, p = i / anisotropic_cosines % azimuths,
                  r = i / (anisotropic_cosines * azimuths) % alpha_ratios,
                  g = i / (anisotropic_cosines * azimuths * alpha_ratios);
        double const greater = double(alpha_at(float(node(g, greater_alphas))));
        double const ratio = double(ratio_at(float(node(r, alpha_ratios)))), v = node(p, azimuths);
        double const cosine = cosine_at(node(c, anisotropic_cosines), float(greater));
        all[size_t(i)] = integrate<Sampler>(
            {greater, greater * ratio, direction(cosine, std::sqrt(ratio) * (1 - v), v), false}, 0);
    });
    out.open(name + "_anisotropic");
    for (size_t k = 0; k < 2; ++k)
        for (Integrals const& i : all) out.value(i[k].white);
    out.close();
}

template <class Sampler>
void write_dielectric(Writer& out, std::string const& name) {
    constexpr int part = indices * alphas * cosines;
    std::vector<Integrals> all(size_t(sides) * part);
    for_all(int(all.size()), [&](int i) {
        auto const side = DielectricSide(i / part);
        int const c = i % cosines, a = i / cosines % alphas, e = i % part / (cosines * alphas);
        // Total reflection does not fade as the indices meet: it shrinks. The first node stands for
        // that limit rather than for equal indices.
        float const ratio = std::max(index_at(float(node(e, indices))), 1.001f);
        float const alpha = alpha_at(float(node(a, alphas)));
        double const cosine = dielectric_cosine_at(side, node(c, cosines), ratio, alpha);
        double const eta = side == DielectricSide::Entering ? double(ratio) : 1 / double(ratio);
        all[size_t(i)] =
            integrate<Sampler>({double(alpha), double(alpha), direction(cosine, 1, 0), true}, eta);
    });
    out.open(name + "_dielectric");
    for (size_t k = 0; k < 2; ++k)
        for (int side = 0; side < sides; ++side) {
            auto const begin = all.begin() + side * part;
            for (auto i = begin; i != begin + part; ++i)
                out.value(double(power_coordinate(float((*i)[k].reflected + (*i)[k].transmitted))));
            for (auto i = begin; i != begin + part; ++i) out.value((*i)[k].reflected);
        }
    out.close();
}

template <class Sampler>
void write_tables(Writer& out, std::string const& name) {
    write_reflection<Sampler>(out, name);
    write_anisotropic<Sampler>(out, name);
    write_dielectric<Sampler>(out, name);
}

/// sigma = cos + the integral of D(m) max(0, -w.m); the integral over azimuths has a closed form.
double integrate_area(double alpha, double a) {
    constexpr int n = 20000;
    constexpr double half_pi = kPiD / 2;
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

using AreaTable = std::array<std::array<float, area_slopes>, area_alphas>;
AreaTable const area_table = [] {
    AreaTable t{};
    for (int i = 0; i < area_alphas; ++i)
        for (int j = 0; j + 1 < area_slopes; ++j) // beyond the last slope nothing is hidden
            t[size_t(i)][size_t(j)] =
                float(integrate_area(std::max(node(i, area_alphas), 1e-3),
                                     double(area_slope_at(float(node(j, area_slopes))))));
    return t;
}();

} // namespace

/// The library looks this up in the table that is being made.
float weft::lobes::ashikhmin_shirley_area(float alpha, float a) {
    float const x = std::min(alpha, 1.f) * (area_alphas - 1),
                y = area_slope_coordinate(a) * (area_slopes - 1);
    auto const i = size_t(std::min(int(x), area_alphas - 2)),
               j = size_t(std::min(int(y), area_slopes - 2));
    float const s = x - float(i), t = y - float(j);
    return lerp(lerp(area_table[i][j], area_table[i][j + 1], t),
                lerp(area_table[i + 1][j], area_table[i + 1][j + 1], t), s);
}

int main() {
    std::printf(
        "// Written by tools/make_albedo_tables.cpp; see lobes/albedo.h for the axes.\n"
        "// clang-format off\n"
        "#pragma once\n\n"
        "#include <cstdint>\n\n"
        "namespace weft::lobes::albedo_tables {\n\n"
        "// In 1 / 65535. Reflection: [shadowing][moment][alpha][cosine]. Anisotropic:\n"
        "// [shadowing][greater alpha][ratio][azimuth][cosine]. Dielectric:\n"
        "// [shadowing][side][power_coordinate(all), reflected][index][alpha][cosine]. Area:\n"
        "// [alpha][slope].\n");
    Writer out;
    out.open("ashikhmin_shirley_area");
    for (auto const& row : area_table)
        for (float const value : row) out.value(double(value));
    out.close();
    write_tables<GgxSampler>(out, "ggx");
    write_tables<BeckmannSampler>(out, "beckmann");
    write_tables<AshikhminShirleySampler>(out, "ashikhmin_shirley");
    std::printf("\n} // namespace weft::lobes::albedo_tables\n");
}
