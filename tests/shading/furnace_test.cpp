// No material gives out more light than it receives, whatever its parameters.
//
// `disney`: every corner of the cube of its scalar parameters, and random points of it. Fixed are
// what cannot add energy: colours are white or saturated where they matter (black adds none),
// opacity 1, no emission, normals of the surface, no turn of the stretch; subsurface parameters
// have no lobes of their own. Parameters of what is switched off are left alone.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/shading/material_bench.h"

using namespace weft;
using namespace weft::testing;

namespace {

/// What tables may be off by: `disney` looks GGX up alone, and rounds up what it only estimates.
/// tests/lobes/energy.cpp has the figures.
constexpr double kTableError = 5e-4;

/// By which few samples, of which some are rare, seem to pass what is true.
constexpr double kSampling = 0.01;

constexpr float kCosines[]{1, 0.5f, 0.1f, 0.02f, -1, -0.5f, -0.1f};

constexpr float kGreatestIor = 3; ///< of the soft range

/// The corner `bits` of the cube; false if it is another one's twin.
bool corner(uint32_t bits, scene::Disney& m) {
    auto next = [&bits](float low, float high) {
        float const v = bits & 1 ? high : low;
        bits >>= 1;
        return v;
    };
    m.metallic = {next(0, 1)};
    m.roughness = {next(0, 1)};
    m.specular = {next(0, 1)};
    m.anisotropic = {next(0, 1)};
    m.sheen = {next(0, 1)};
    m.sheen_roughness = {next(0, 1)};
    m.clearcoat = {next(0, 1)};
    m.clearcoat_roughness = {next(0, 1)};
    m.clearcoat_ior = {next(1, 3)};
    m.transmission = {next(0, 1)};
    m.transmission_roughness = {next(-1, 1)};
    m.thin_film_thickness = {next(0, 400)};
    m.thin_film_ior = {next(1, 4)};
    m.ior = {next(1, kGreatestIor)};
    m.base_color = {Color(1)};
    bool const glass = m.transmission.value == 1, metal = m.metallic.value == 1;
    return !(m.sheen.value == 0 && m.sheen_roughness.value == 1) &&
           !(m.clearcoat.value == 0 &&
             (m.clearcoat_roughness.value == 1 || m.clearcoat_ior.value == 3)) &&
           !(!glass && m.transmission_roughness.value == 1) &&
           !(m.thin_film_thickness.value == 0 && m.thin_film_ior.value == 4) &&
           !(metal && (glass || m.specular.value == 1 || m.ior.value > 1));
}
constexpr uint32_t kCorners = 1 << 14;

scene::Disney random_disney(Rng& rng) {
    auto const some = [&](float chance, float low, float high) {
        float const value = low + (high - low) * rng.next();
        return scene::Input<float>{rng.next() < chance ? value : 0.f};
    };
    auto const color = [&] { return Color(1 - square(rng.next()), 1 - square(rng.next()), 1); };
    scene::Disney m;
    m.base_color = {color()};
    m.metallic = some(0.4f, 0, 1);
    m.roughness = some(0.9f, 0, 1);
    m.ior = {1 + 2 * square(rng.next())};
    m.specular = some(0.9f, 0, 1);
    m.specular_tint = {rng.next() < 0.5f ? Color(1) : color()};
    m.anisotropic = some(0.4f, 0, 1);
    m.sheen = some(0.4f, 0, 1);
    m.sheen_roughness = some(1, 0, 1);
    m.clearcoat = some(0.4f, 0, 1);
    m.clearcoat_roughness = some(1, 0, 1);
    m.clearcoat_ior = {1 + 2 * rng.next()};
    m.transmission = some(0.4f, 0, 1);
    m.transmission_roughness = {rng.next() < 0.5f ? -1.f : rng.next()};
    m.thin_film_thickness = some(0.3f, 0, 1000);
    m.thin_film_ior = {1 + 2 * rng.next()};
    return m;
}

/// One-sided: the probability of a mean this far above `most`, if the truth were `most`.
double excess_p_value(Estimate const& e, double most) {
    if (e.mean <= most) return 1;
    double const sigma = std::sqrt(e.variance);
    return sigma > 0 ? 0.5 * normal_tail((e.mean - most) / sigma) : 0;
}

/// `what` tells the place, for messages.
template <class What>
void expect_no_gain(lobes::Bsdf const& bsdf, Vec3 const& wo, double most, int samples,
                    uint64_t seed, double level, What const& what) {
    EXPECT_LE(max_component(bsdf.albedo(wo)), most) << what();
    Estimate const e = sampled_power(bsdf, wo, samples, seed);
    EXPECT_GE(excess_p_value(e, most), level)
        << what() << ": " << e.mean << " +- " << std::sqrt(e.variance);
}

std::string describe(scene::Disney& m, float cosine) {
    std::string text = "cosine " + std::to_string(cosine);
    auto const print = [&text](std::string_view name, auto const& in, schema::Attr const&) {
        if constexpr (std::is_same_v<decltype(in), scene::Input<float> const&>)
            text += " " + std::string(name) + " " + std::to_string(in.value);
    };
    m.describe(print);
    return text;
}

TEST(Furnace, DisneyGainsNothingAtAnyCorner) {
    MaterialBench bench;
    std::vector<scene::Disney> corners;
    for (uint32_t bits = 0; bits < kCorners; ++bits)
        if (scene::Disney m; corner(bits, m)) {
            corners.push_back(m);
            bench.add(m);
        }
    bench.compile();
    double const level = sidak(0.01, int(corners.size() * std::size(kCosines)));
    for (size_t i = 0; i < corners.size(); ++i)
        for (float const cosine : kCosines) {
            Vec3 const wo = towards(cosine);
            shading::Shading const s = bench.shade({int32_t(i)}, wo);
            expect_no_gain(s.bsdf, wo, 1 + kSampling, 512, i, level,
                           [&] { return describe(corners[i], cosine); });
        }
}

TEST(Furnace, DisneyGainsNothingAnywhere) {
    MaterialBench bench;
    std::vector<scene::Disney> points;
    Rng rng(17);
    for (int i = 0; i < 1000; ++i) bench.add(points.emplace_back(random_disney(rng)));
    bench.compile();
    double const level = sidak(0.01, int(points.size() * std::size(kCosines)));
    double most = 0;
    for (size_t i = 0; i < points.size(); ++i)
        for (float const cosine : kCosines) {
            Vec3 const wo = towards(cosine);
            shading::Shading const s = bench.shade({int32_t(i)}, wo);
            most = std::max(most, double(max_component(s.bsdf.albedo(wo))));
            expect_no_gain(s.bsdf, wo, 1 + kSampling, 1024, i, level,
                           [&] { return describe(points[i], cosine); });
        }
    std::printf("greatest sum of albedos of 1000 disney materials: %.5f\n", most);
}

/// White and physical parameters: what comes in goes out.
TEST(Furnace, DisneyLosesLittleWhereNothingAbsorbs) {
    MaterialBench bench;
    std::vector<scene::Disney> points;
    auto const add = [&](float transmission, float roughness, float ior, auto const& change) {
        scene::Disney m;
        m.base_color = {Color(1)};
        m.transmission = {transmission};
        m.roughness = {roughness};
        m.ior = {ior};
        change(m);
        bench.add(points.emplace_back(m));
    };
    for (float const transmission : {0.f, 0.5f, 1.f})
        for (float const roughness : {0.f, 0.1f, 0.35f, 0.7f, 1.f})
            for (float const ior : {1.1f, 1.5f, 2.2f}) {
                add(transmission, roughness, ior, [](auto&) {});
                add(transmission, roughness, ior, [](auto& m) { m.clearcoat = {1.f}; });
                add(transmission, roughness, ior, [](auto& m) { m.anisotropic = {0.8f}; });
                add(transmission, roughness, ior, [](auto& m) { m.sheen = {0.7f}; });
                add(transmission, roughness, ior, [](auto& m) { m.metallic = {0.6f}; });
                add(transmission, roughness, ior, [](auto& m) { m.specular = {0.f}; });
                add(transmission, roughness, ior, [](auto& m) { m.thin_film_thickness = {350.f}; });
                add(transmission, roughness, ior,
                    [](auto& m) { m.transmission_roughness = {0.5f}; });
            }
    bench.compile();
    double least = 1, most = 0;
    for (size_t i = 0; i < points.size(); ++i)
        for (float const cosine : {1.f, 0.35f, 0.05f, -0.7f, -0.1f}) {
            if (cosine < 0 && points[i].transmission.value == 0)
                continue; // nobody looks from there
            Vec3 const wo = towards(cosine);
            Color const power = integrated_power(bench.shade({int32_t(i)}, wo).bsdf, wo);
            EXPECT_GE(min_component(power), 0.97) << describe(points[i], cosine);
            EXPECT_LE(max_component(power), 1 + kTableError) << describe(points[i], cosine);
            least = std::min(least, double(min_component(power)));
            most = std::max(most, double(max_component(power)));
        }
    std::printf("%zu white disney materials send out %.5f to %.5f\n", points.size(), least, most);
}

/// Any parameters, without the noise of samples.
TEST(Furnace, DisneyGainsNothingToFourDigits) {
    MaterialBench bench;
    std::vector<scene::Disney> points;
    Rng rng(23);
    for (int i = 0; i < 150; ++i) bench.add(points.emplace_back(random_disney(rng)));
    bench.compile();
    double most = 0;
    for (size_t i = 0; i < points.size(); ++i)
        for (float const cosine : {0.9f, 0.3f, 0.04f, -0.8f, -0.15f}) {
            Vec3 const wo = towards(cosine);
            Color const power = integrated_power(bench.shade({int32_t(i)}, wo).bsdf, wo);
            EXPECT_LE(max_component(power), 1 + kTableError) << describe(points[i], cosine);
            most = std::max(most, double(max_component(power)));
        }
    std::printf("most of 150 disney materials: %.5f\n", most);
}

/// The same by `eval` alone, which samples' weights may hide from where sampling never goes.
TEST(Furnace, EvaluatedPowerGainsNothing) {
    MaterialBench bench;
    std::vector<scene::Disney> points;
    Rng rng(18);
    for (int i = 0; i < 200; ++i) {
        scene::Disney m = random_disney(rng);
        m.roughness = {0.4f + 0.6f * m.roughness.value}; // what cosines can sample
        m.clearcoat_roughness = {0.5f + 0.5f * m.clearcoat_roughness.value};
        if (m.transmission_roughness.value >= 0) m.transmission_roughness.value = 0.6f;
        bench.add(points.emplace_back(m));
    }
    bench.compile();
    double const level = sidak(0.01, int(points.size()) * 3);
    for (size_t i = 0; i < points.size(); ++i)
        for (float const cosine : {0.9f, 0.3f, -0.6f}) {
            Vec3 const wo = towards(cosine);
            Estimate const e = evaluated_power(bench.shade({int32_t(i)}, wo).bsdf, wo, 4096, i);
            EXPECT_GE(excess_p_value(e, 1 + kSampling), level)
                << describe(points[i], cosine) << ": " << e.mean;
        }
}

scene::Microfacet random_microfacet(Rng& rng) {
    scene::Microfacet m;
    m.distribution = scene::MicrofacetDistribution(rng.next_uint() % 3);
    m.metal = scene::Metal(rng.next_uint() % 10);
    m.roughness = {rng.next()};
    m.anisotropic = {rng.next() < 0.5f ? 0.f : rng.next()};
    m.ior = {1.1f + 1.5f * rng.next()};
    m.reflection_ior = {rng.next() < 0.7f ? 0.f : 1.1f + 1.5f * rng.next()};
    return m;
}

/// A material of at most `depth` levels.
scene::MaterialId random_material(MaterialBench& bench, Rng& rng, int depth) {
    uint32_t const kind = rng.next_uint() % (depth > 0 ? 8 : 5);
    switch (kind) {
    case 0:
        return bench.add(scene::Diffuse{{Color(1)}, {rng.next()}});
    case 1:
        return bench.add(random_microfacet(rng));
    case 2: {
        scene::Translucent m;
        m.reflectance = {Color(rng.next())};
        m.transmittance = {Color(rng.next())};
        return bench.add(m);
    }
    case 3:
        return bench.add(scene::Transparent{});
    case 4: {
        scene::Disney m = random_disney(rng);
        m.thin_film_thickness = {0.f};
        m.opacity = {rng.next()};
        return bench.add(m);
    }
    case 5: {
        scene::Coat m;
        m.bsdf = random_material(bench, rng, depth - 1);
        m.weight = {rng.next()};
        m.roughness = {rng.next()};
        m.ior = {1 + 3 * rng.next()};
        return bench.add(m);
    }
    case 6: {
        scene::Mix m;
        m.bsdfs = {random_material(bench, rng, depth - 1), random_material(bench, rng, depth - 1)};
        m.amount = {rng.next()};
        return bench.add(m);
    }
    default: {
        scene::Layered m;
        for (int layers = 1 + int(rng.next_uint() % 5); layers > 0; --layers) {
            scene::Layer layer;
            layer.bsdf = random_material(bench, rng, 0);
            layer.opacity = {rng.next()};
            m.layers.push_back(bench.add(layer));
        }
        return bench.add(m);
    }
    }
}

TEST(Furnace, WhatIsMadeOfMaterialsGainsNothing) {
    MaterialBench bench;
    std::vector<scene::MaterialId> made;
    Rng rng(19);
    for (int i = 0; i < 400; ++i) made.push_back(random_material(bench, rng, 2));
    bench.compile();
    double const level = sidak(0.01, int(made.size() * std::size(kCosines)));
    for (size_t i = 0; i < made.size(); ++i)
        for (float const cosine : kCosines) {
            Vec3 const wo = towards(cosine);
            expect_no_gain(bench.shade(made[i], wo).bsdf, wo, 1 + kSampling, 1024, i, level, [&] {
                return "material " + std::to_string(i) + " at " + std::to_string(cosine);
            });
        }
}

TEST(Furnace, HairGainsNothing) {
    MaterialBench bench;
    std::vector<scene::MaterialId> hairs;
    Rng rng(20);
    for (int i = 0; i < 60; ++i) {
        scene::Hair m;
        m.eumelanin = {0.f};
        m.roughness = {0.1f + 0.9f * rng.next()};
        m.radial_roughness = {0.1f + 0.9f * rng.next()};
        m.ior = {1.2f + rng.next()};
        m.scale_angle = {10 * rng.next() - 5};
        hairs.push_back(bench.add(m));
    }
    bench.compile();
    double const level = sidak(0.01, int(hairs.size()) * 3);
    for (size_t i = 0; i < hairs.size(); ++i)
        for (float const cosine : {1.f, 0.5f, 0.1f}) {
            Vec3 const wo = towards(cosine, 1.1f);
            expect_no_gain(bench.shade(hairs[i], wo).bsdf, wo, 1 + kSampling, 1024, i, level, [&] {
                return "hair " + std::to_string(i) + " at " + std::to_string(cosine);
            });
        }
}

} // namespace
