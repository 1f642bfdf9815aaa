// Which materials shadow how, against the formulas written down once more: separable, G1(wo) G1(wi)
// (Walter et al. 2007, eq. 23), as course renderers have it; correlated where films are made.
#include <gtest/gtest.h>

#include "tests/shading/material_bench.h"

using namespace weft;
using namespace weft::testing;

namespace {

/// Smith's G1 of GGX (Walter et al. 2007, eq. 34).
double g1(double alpha, double cosine) {
    double const tan2 = (1 - cosine * cosine) / (cosine * cosine);
    return 2 / (1 + std::sqrt(1 + alpha * alpha * tan2));
}
double ggx(double alpha, double cosine) {
    double const c2 = cosine * cosine, e = c2 * (alpha * alpha - 1) + 1;
    return alpha * alpha / (3.14159265358979 * e * e);
}
/// G2 / (4 cos_o cos_i), times D and the cosine of wi.
double reflection(double alpha, Vec3 const& wo, Vec3 const& wi, bool correlated) {
    double const o = double(wo.z), i = double(wi.z), h = double(normalize(wo + wi).z);
    double const a = g1(alpha, o), b = g1(alpha, i);
    double const g = correlated ? 1 / (1 / a + 1 / b - 1) : a * b;
    return ggx(alpha, h) * g / (4 * o);
}

/// What of a material's light comes from its microfacet lobes.
double glossy(scene::Material const& m, Vec3 const& wo, Vec3 const& wi) {
    MaterialBench bench;
    auto const id = bench.add(m);
    bench.compile();
    lobes::Bsdf const bsdf = bench.shade(id, wo).bsdf;
    double sum = 0;
    bsdf.for_each_value(wo, wi, [&](lobes::Lobe const& lobe, Color const& f) {
        if (lobes::flags_of(lobe).kind == ScatteringKind::Glossy) sum += double(f.g);
    });
    return sum;
}

/// Pairs of directions from steep to grazing, and roughnesses.
template <class F>
void for_each_case(F&& f) {
    for (float const roughness : {0.3f, 0.7f, 1.f})
        for (float const o : {1.f, 0.6f, 0.15f})
            for (float const i : {0.9f, 0.4f, 0.1f}) f(roughness, towards(o), towards(i, 2.5f));
}

TEST(Shadowing, CourseConductorsAreSeparable) {
    for_each_case([](float roughness, Vec3 const& wo, Vec3 const& wi) {
        scene::RoughConductor m;
        m.roughness = {roughness};
        double const expected = reflection(double(square(roughness)), wo, wi, false);
        EXPECT_NEAR(glossy(m, wo, wi), expected, 1e-4 * expected + 1e-6);
    });
}

TEST(Shadowing, CourseDielectricsAreSeparableOnBothSides) {
    for_each_case([](float roughness, Vec3 const& wo, Vec3 const& wi) {
        scene::RoughDielectric m;
        m.roughness = {roughness};
        double const alpha = double(square(roughness)), eta = 1.5;
        double const cos_h = double(dot(wo, normalize(wo + wi)));
        double const f = double(lobes::fresnel_dielectric(float(cos_h), float(eta)));
        double const expected = f * reflection(alpha, wo, wi, false);
        EXPECT_NEAR(glossy(m, wo, wi), expected, 1e-4 * expected + 1e-6);

        // Walter et al. 2007, eq. 21, seen from the thinner side, as radiance.
        Vec3 const below(wi.x, wi.y, -wi.z), sum = -(wo + below * float(eta));
        Vec3 const h = normalize(sum);
        double const oh = double(dot(wo, h)), ih = double(dot(below, h));
        if (!(oh > 0 && ih < 0)) return;
        double const t = 1 - double(lobes::fresnel_dielectric(float(oh), float(eta)));
        double const through = oh * -ih / double(wo.z) * t * ggx(alpha, double(h.z)) *
                               g1(alpha, double(wo.z)) * g1(alpha, double(wi.z)) /
                               double(length_squared(sum));
        EXPECT_NEAR(glossy(m, wo, below), through, 2e-4 * through + 1e-6);
    });
}

TEST(Shadowing, CoursePrincipledIsSeparable) {
    for_each_case([](float roughness, Vec3 const& wo, Vec3 const& wi) {
        scene::Principled m;
        m.base_color = {Color(0)};
        m.roughness = {roughness};
        double const schlick = 0.08 + 0.92 * std::pow(1 - double(wo.z), 5);
        double const expected =
            0.5 * schlick * reflection(double(square(roughness)), wo, wi, false);
        EXPECT_NEAR(glossy(m, wo, wi), expected, 1e-4 * expected + 1e-6);
    });
}

/// Compensated lobes are too bright by a factor for each wo: the quotient of two directions.
double quotient(scene::Material const& m, Vec3 const& wo, Vec3 const& wi, Vec3 const& other) {
    return glossy(m, wo, wi) / glossy(m, wo, other);
}

TEST(Shadowing, MicrofacetsHaveTheChoice) {
    scene::Microfacet m;
    EXPECT_EQ(m.shadowing, scene::Shadowing::separable);
    m.distribution = scene::MicrofacetDistribution::ggx;
    m.metal = scene::Metal::complex;
    m.complex_ior = {Color(0.001f)}; // reflects all from everywhere
    m.extinction = {Color(100)};
    for_each_case([&](float roughness, Vec3 const& wo, Vec3 const& wi) {
        m.roughness = {roughness};
        Vec3 const up(0, 0, 1);
        for (bool const correlated : {false, true}) {
            m.shadowing = correlated ? scene::Shadowing::correlated : scene::Shadowing::separable;
            double const alpha = double(square(roughness));
            double const expected =
                reflection(alpha, wo, wi, correlated) / reflection(alpha, wo, up, correlated);
            EXPECT_NEAR(quotient(m, wo, wi, up), expected, 1e-3 * expected);
        }
    });
}

TEST(Shadowing, DisneyAndCoatsAreCorrelated) {
    for_each_case([&](float roughness, Vec3 const& wo, Vec3 const& wi) {
        double const alpha = double(square(roughness));
        Vec3 const up(0, 0, 1);
        double const expected = reflection(alpha, wo, wi, true) / reflection(alpha, wo, up, true);
        scene::Disney m;
        m.metallic = {1.f};
        m.base_color = {Color(1)};
        m.roughness = {roughness};
        EXPECT_NEAR(quotient(m, wo, wi, up), expected, 1e-3 * expected);
    });
}

} // namespace
