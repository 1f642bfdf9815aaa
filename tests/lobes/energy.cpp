// What leaves a surface in a white furnace where multiple scattering is compensated: all of it, as
// far as the tables tell.
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/lobes/configurations.h"
#include "tests/lobes/quadrature.h"

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::testing;

namespace {

constexpr float kAlphas[] = {0.01f, 0.03f, 0.15f, 0.55f, 0.77f, 1};
constexpr float kCosines[] = {0.01f, 0.03f, 0.1f, 0.37f, 0.62f, 1};

struct Deviation {
    double worst = 0, sum = 0, most = 0;
    int count = 0;
    std::string where;
    void add(double furnace, std::string const& at) {
        double const e = std::abs(furnace - 1);
        sum += e;
        ++count;
        most = std::max(most, furnace - 1);
        if (e > worst) {
            worst = e;
            where = at + ": " + std::to_string(furnace);
        }
    }
    void print(char const* what) const {
        std::printf("%-48s furnace off by %.4f in the mean, %.4f at worst, gains %.4f (%s)\n", what,
                    sum / count, worst, most, where.c_str());
    }
};

Vec3 toward(float cos_o, float azimuth) {
    float const s = safe_sqrt(1 - cos_o * cos_o);
    return {s * std::cos(azimuth), s * std::sin(azimuth), cos_o};
}

std::string place(float alpha_x, float alpha_y, float eta, float cos_o) {
    char text[120];
    std::snprintf(text, sizeof text, "alpha %g %g eta %g cosine %g", double(alpha_x),
                  double(alpha_y), double(eta), double(cos_o));
    return text;
}

template <class Distribution>
void furnace(char const* name) {
    Deviation metal, brushed, glass;
    for (float const alpha : kAlphas) {
        for (float const cos_o : kCosines) {
            MicrofacetReflection<Distribution> const lobe{{alpha, alpha}, {}, true};
            metal.add(double(quadrature_albedo(lobe, toward(cos_o, 0.7f), 1 << 12).g),
                      place(alpha, alpha, 0, cos_o));
            for (float const eta : {1.1f, 1.5f, 2.2f}) {
                for (float const n : {eta, 1 / eta}) {
                    MicrofacetDielectric<Distribution> const g({alpha, alpha}, n, Color(1),
                                                               Color(1), {}, true);
                    // The fewer of the samples count, the more it takes.
                    Vec3 const wo = toward(cos_o, 0.7f);
                    DielectricAlbedo const once = dielectric_albedo(g.distribution(), wo, n);
                    int const samples = int((1 << 13) / (once.reflected + once.transmitted));
                    glass.add(double(quadrature_albedo(g, wo, samples).g),
                              place(alpha, alpha, n, cos_o));
                }
            }
            for (float const ratio : {0.5f, 0.1f}) {
                for (float const azimuth : {0.f, 0.5f, 1.f, 1.5f}) {
                    Distribution const d{alpha, std::max(alpha * ratio, 1e-3f)};
                    Vec3 const wo = toward(cos_o, azimuth);
                    MicrofacetReflection<Distribution> const b{d, {}, true};
                    brushed.add(double(quadrature_albedo(b, wo, 1 << 12).g),
                                place(d.alpha_x, d.alpha_y, azimuth, cos_o));
                }
            }
        }
    }
    metal.print((std::string(name) + " metal").c_str());
    glass.print((std::string(name) + " glass").c_str());
    brushed.print((std::string(name) + " brushed metal").c_str());
    EXPECT_LE(metal.worst, 0.01) << metal.where;
    EXPECT_LE(brushed.sum / brushed.count, 0.01);
    EXPECT_LE(brushed.worst, 0.05) << brushed.where;
    // At alpha 1, index 1.1 and grazing angles single scattering keeps but 2% of the light, and the
    // factor of 50 that makes up for it magnifies what the tables miss.
    EXPECT_LE(glass.sum / glass.count, 0.01);
    EXPECT_LE(glass.worst, 0.02) << glass.where;
}

TEST(MultipleScattering, WhiteFurnace) {
    furnace<Ggx>("Ggx");
    furnace<Beckmann>("Beckmann");
    furnace<AshikhminShirley>("AshikhminShirley");
}

} // namespace
