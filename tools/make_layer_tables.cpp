// Writes src/lobes/layer_tables.h: albedos of Burley's lobes, and the fit of the sheen layer, on
// the grids that the lobes' headers declare. Run it again whenever one of them changes (some
// minutes):
//     g++ -std=c++20 -O3 -pthread -I/usr/include/Imath -Isrc tools/make_layer_tables.cpp -o tables
//     ./tables > src/lobes/layer_tables.h
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "base/hash.h"
#include "lobes/clearcoat.h"
#include "lobes/disney_sheen.h"
#include "lobes/sheen.h"

namespace {

using namespace weft;
using namespace weft::lobes;

/// Prints numbers, comma after comma, in lines of at most 100 columns.
class Array {
  public:
    Array(char const* name, size_t size) {
        std::printf("inline constexpr float %s[%zu] = {\n", name, size);
    }
    ~Array() {
        flush();
        std::printf("};\n");
    }
    void value(double x) {
        char text[32];
        std::snprintf(text, sizeof text, "%#.5gf,", x);
        if (line_.size() + std::strlen(text) > 100) flush();
        line_ += text;
    }

  private:
    void flush() {
        if (!line_.empty()) std::printf("%s\n", line_.c_str());
        line_.clear();
    }
    std::string line_;
};

float node(int i, int nodes) { return float(i) / float(nodes - 1); }

/// wo at a cosine; the end of the axis stands for a limit that lobes do not take.
Vec3 direction(float cosine) {
    float const c = std::max(cosine, 1e-4f);
    return {safe_sqrt(1 - c * c), 0, c};
}

Vec2 hammersley(uint32_t i, uint32_t n) {
    uint32_t r = i;
    r = (r << 16) | (r >> 16);
    r = ((r & 0x00ff00ffu) << 8) | ((r & 0xff00ff00u) >> 8);
    r = ((r & 0x0f0f0f0fu) << 4) | ((r & 0xf0f0f0f0u) >> 4);
    r = ((r & 0x33333333u) << 2) | ((r & 0xccccccccu) >> 2);
    r = ((r & 0x55555555u) << 1) | ((r & 0xaaaaaaaau) >> 1);
    return {(float(i) + 0.5f) / float(n), float(double(r) * 0x1p-32 + 0.5 / n)};
}

template <class L>
double integrate(L const& lobe, Vec3 const& wo) {
    constexpr uint32_t n = 1 << 17;
    double sum = 0;
    for (uint32_t i = 0; i < n; ++i) {
        Vec2 const u = hammersley(i, n);
        Vec3 const wi = lobe.sample(wo, {u.x, u.y, 0});
        LobeValue const v = wi == Vec3(0) ? LobeValue{} : lobe.eval(wo, wi);
        if (v.pdf > 0) sum += v.f.g / v.pdf;
    }
    return sum / n;
}

void write_disney_sheen() {
    Array out("disney_sheen", disney_sheen_cosines);
    for (int c = 0; c < disney_sheen_cosines; ++c)
        out.value(integrate(DisneySheen{}, direction(node(c, disney_sheen_cosines))));
}

/// F is linear in its value at normal incidence: the albedo of F = 1, and of F with f0 = 0.
void write_clearcoat(char const* name, bool white) {
    using namespace clearcoat_grid;
    Array out(name, size_t(alphas) * cosines);
    for (int a = 0; a < alphas; ++a)
        for (int c = 0; c < cosines; ++c)
            out.value(integrate(Clearcoat(alpha_at(node(a, alphas)), white ? 1e9f : 1.f),
                                direction(cosine_at(node(c, cosines)))));
}

/// A normal of the flakes seen along `w`: cosine-weighted over the half of the unit sphere that is
/// visible once the ellipsoid diag(1, 1, cross_section) is stretched to it (Heitz et al. 2015).
Vec3d visible_flake(Vec3d const& w, double cross_section, Rng& rng) {
    Vec3d const v = normalize(Vec3d(w.x, w.y, cross_section * w.z));
    Vec3 const h = square_to_cosine_hemisphere(rng.next2());
    double const sign = std::copysign(1.0, v.z), a = -1 / (sign + v.z), b = v.x * v.y * a;
    Vec3d const s(1 + sign * v.x * v.x * a, sign * b, -sign * v.x);
    Vec3d const t(b, sign + v.y * v.y * a, -v.y);
    Vec3d const q = s * double(h.x) + t * double(h.y) + v * double(h.z);
    return normalize(Vec3d(q.x, q.y, cross_section * q.z));
}

/// Light that leaves the layer's top: where to, and how much.
struct Returned {
    Vec3d direction;
    double weight;
};

/// Walks through the layer from above and calls f(Returned) at every flight that may leave its top.
/// Flights never leave: what does so is taken off the weight.
template <class F>
void walk(Vec3d const& wo, double cross_section, Rng& rng, F&& f) {
    Vec3d back = wo; // the way the light came from
    double height = 1, weight = 1;
    for (;;) {
        double const sine2 = back.x * back.x + back.y * back.y;
        double const extinction = std::sqrt(sine2 + std::pow(cross_section * back.z, 2));
        double const room = back.z > 0 ? height : 1 - height;
        double const leaves = std::exp(-extinction * room / std::abs(back.z));
        if (back.z < 0) f(Returned{-back, weight * leaves});
        weight *= 1 - leaves;
        if (weight < 0.1) {
            if (rng.next() < 0.5f) return;
            weight *= 2;
        }
        height += std::log1p(-double(rng.next()) * (1 - leaves)) / extinction * back.z;
        Vec3d const m = visible_flake(back, cross_section, rng);
        back = normalize(back - m * (2 * dot(back, m)));
    }
}

/// Of a: what is narrower hugs the horizon within its own width of 3 degrees, and only costs
/// samples.
constexpr float kLeastA = 0.05f;

/// In slopes (x, y) / z the lobe is a bivariate Student distribution of 2 degrees of freedom, with
/// mean (-b / a, 0) and scale 1 / a: expectation maximisation for its two parameters; R is 1.
SheenCoefficients fit(std::vector<Returned> const& all) {
    double mean = 0, a2 = 1, total = 0;
    for (Returned const& r : all) total += r.weight;
    for (int iteration = 0; iteration < 300; ++iteration) {
        double weights = 0, weighted = 0, spread = 0;
        for (auto const& [d, weight] : all) {
            double const x = d.x / d.z, y = d.y / d.z;
            double const distance2 = std::pow(x - mean, 2) + y * y;
            double const w = 2 * weight / (1 + a2 * distance2);
            weights += w;
            weighted += w * x;
            spread += w * distance2;
        }
        double const next_a2 = total / spread, next_mean = weighted / weights;
        bool const done = std::abs(next_a2 / a2 - 1) + std::abs(next_mean - mean) < 1e-5;
        a2 = next_a2;
        mean = next_mean;
        if (done) break;
    }
    double const a = std::sqrt(a2);
    return {1, std::max(float(a), kLeastA), float(-mean * a)};
}

/// One node: the albedo to a standard error of 5e-4, the shape from the first directions. a is 0
/// where next to nothing returns.
SheenCoefficients fit_node(int index) {
    using namespace sheen_grid;
    constexpr int least_walks = 1 << 13, most_walks = 1 << 22;
    constexpr size_t enough = 1 << 14; ///< directions to fit
    float const roughness = roughness_at(node(index / cosines, roughnesses));
    Vec3 const wo = direction(cosine_at(node(index % cosines, cosines), roughness));
    Rng rng{uint64_t(index)};
    std::vector<Returned> out;
    double sum = 0, squares = 0, least_weight = 1e-3;
    int n = 0;
    for (; n < most_walks; ++n) {
        double returned = 0;
        walk(Vec3d(wo.x, wo.y, wo.z), double(square(roughness)), rng, [&](Returned const& r) {
            returned += r.weight;
            if (r.weight > least_weight && out.size() < enough) out.push_back(r);
        });
        sum += returned;
        squares += returned * returned;
        bool const sure = squares - sum * sum / (n + 1) < std::pow(5e-4 * (n + 1), 2);
        if (n >= least_walks && sure && (out.size() == enough || n >= 1 << 17)) break;
    }
    SheenCoefficients k{float(sum / n), 0, 0};
    if (out.size() > 500) k = fit(out);
    k.albedo = float(sum / n);
    return k;
}

std::vector<SheenCoefficients> fit_sheen() {
    using namespace sheen_grid;
    std::vector<SheenCoefficients> all(size_t(roughnesses) * cosines);
    std::atomic<int> next = 0;
    {
        std::vector<std::jthread> threads;
        for (unsigned k = 0; k < std::max(std::thread::hardware_concurrency(), 1u); ++k)
            threads.emplace_back([&] {
                for (int i; (i = next++) < int(all.size());) all[size_t(i)] = fit_node(i);
            });
    }
    // Where next to nothing returns, it has the shape of the next rougher layer.
    for (size_t i = all.size() - cosines; i-- > 0;)
        if (all[i].a == 0) all[i] = {all[i].albedo, all[i + cosines].a, all[i + cosines].b};
    return all;
}

void write_sheen() {
    std::vector<SheenCoefficients> const all = fit_sheen();
    auto const write = [&](char const* name, float SheenCoefficients::*member) {
        Array out(name, all.size());
        for (SheenCoefficients const& k : all) out.value(k.*member);
    };
    write("sheen_albedo", &SheenCoefficients::albedo);
    write("sheen_a", &SheenCoefficients::a);
    write("sheen_b", &SheenCoefficients::b);
}

} // namespace

int main() {
    std::printf(
        "// Written by tools/make_layer_tables.cpp; the lobes' headers declare the axes. All "
        "but\n// disney_sheen are [roughness or alpha][cosine].\n"
        "// clang-format off\n"
        "#pragma once\n\n"
        "namespace weft::lobes::layer_tables {\n\n");
    write_disney_sheen();
    write_clearcoat("clearcoat_white", true);
    write_clearcoat("clearcoat_grazing", false);
    write_sheen();
    std::printf("\n} // namespace weft::lobes::layer_tables\n");
}
