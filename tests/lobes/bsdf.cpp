// The list: mixtures, delta lobes among smooth ones, disagreeing normals, and bookkeeping.
#include <gtest/gtest.h>

#include "tests/lobes/configurations.h"
#include "tests/lobes/sphere_chi_square.h"

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::testing;

namespace {

Frame const kFrame(normalize(Vec3(0.3f, -0.5f, 0.8f)), Vec3(1, 0.2f, 0));

Bsdf mixture(Vec3 const& ng, Vec3 const& wo, BentNormals bent = BentNormals::Folded) {
    Bsdf bsdf({kFrame, ng, bent});
    bsdf.add(Color(0.5f, 0.3f, 0.1f), Lambert{});
    bsdf.add(Color(0.3f), GgxReflection{{0.1f, 0.2f}});
    bsdf.add(Color(0.2f, 0.2f, 0.4f), BeckmannDielectric({0.3f, 0.3f}, 1.5f));
    bsdf.prepare(wo);
    return bsdf;
}

TEST(Bsdf, MixturesFollowTheirDensity) {
    std::vector<SphereTest> tests;
    for (Vec3 const& ng_local : {Vec3(0, 0, 1), at_angle(20)}) {
        for (float const angle : {0.5f, 45.f, 80.f}) {
            Vec3 const wo = kFrame.to_world(at_angle(angle)), ng = kFrame.to_world(ng_local);
            Bsdf const bsdf = mixture(ng, wo);
            auto const sample = [&](Vec3 const& u) {
                BsdfSample const s = bsdf.sample(wo, u);
                return s.pdf > 0 ? kFrame.to_local(s.wi) : Vec3(0);
            };
            auto const density = [&](Vec3 const& w) {
                return bsdf.eval(wo, kFrame.to_world(w)).pdf;
            };
            tests.push_back(SphereChiSquare(sample, density).run(99 + tests.size(), 1 << 17));
        }
    }
    double const level = weft::testing::sidak(0.01, int(tests.size()));
    for (SphereTest const& t : tests) {
        EXPECT_GE(t.chi_square.p_value, level)
            << t.chi_square.statistic << " of " << t.chi_square.dof << t.chi_square.problem;
        double const sigma = std::sqrt(t.success * (1 - t.success) / (1 << 17));
        double const beyond = std::max(std::abs(t.integral - t.success) - 1e-3, 0.0);
        EXPECT_TRUE(beyond == 0 || weft::testing::normal_tail(beyond / sigma) >= level)
            << t.integral << " " << t.success;
    }
}

TEST(Bsdf, EvalIsTheSum) {
    Vec3 const wo_local = at_angle(50), wo = kFrame.to_world(wo_local);
    Bsdf const bsdf = mixture(kFrame.n, wo);
    Rng rng(5);
    float picks = 0;
    for (int i = 0; i < bsdf.size(); ++i) picks += bsdf[i].pick;
    EXPECT_NEAR(picks, 1, 1e-6);
    for (int n = 0; n < 1000; ++n) {
        Vec3 const wi = square_to_sphere(rng.next2()), local = kFrame.to_local(wi);
        Color f;
        float pdf = 0;
        for (int i = 0; i < bsdf.size(); ++i) {
            match(bsdf[i].kind, [&](auto const& lobe) {
                if constexpr (SmoothLobe<std::remove_cvref_t<decltype(lobe)>>) {
                    LobeValue const v = lobe.eval(kFrame.to_local(wo), local);
                    f += bsdf[i].weight * v.f;
                    pdf += bsdf[i].pick * v.pdf;
                }
            });
        }
        LobeValue const v = bsdf.eval(wo, wi);
        EXPECT_NEAR(v.pdf, pdf, 1e-5f * pdf);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(v.f[k], f[k], 1e-5f * f[k]);
    }
}

/// Delta and smooth lobes whose albedos are exact: the mean weight is their sum.
TEST(Bsdf, DeltaAmongSmoothIsUnbiased) {
    constexpr int n = 200000;
    int tests = 0;
    for (float const angle : {10.f, 60.f, 85.f}) {
        Vec3 const wo = kFrame.to_world(at_angle(angle));
        Bsdf bsdf({kFrame, kFrame.n});
        bsdf.add(Color(0.3f, 0.1f, 0.2f), SpecularReflection{});
        bsdf.add(Color(0.2f, 0.5f, 0.1f), Lambert{});
        bsdf.add(Color(0.4f), SpecularDielectric{1.5f, Color(1), Color(0.5f, 0.9f, 1)});
        bsdf.prepare(wo);
        Rng rng(uint64_t(angle) + 1);
        std::array<std::vector<double>, 3> values;
        for (int i = 0; i < n; ++i) {
            BsdfSample const s = bsdf.sample(wo, rng.next3());
            for (int k = 0; k < 3; ++k)
                values[size_t(k)].push_back(s.pdf > 0 ? s.weight[k] * s.eta_scale : 0);
        }
        Color const albedo = bsdf.albedo(wo);
        for (int k = 0; k < 3; ++k) {
            auto const e = weft::testing::estimate(values[size_t(k)]);
            EXPECT_GE(weft::testing::normal_tail((e.mean - albedo[k]) / std::sqrt(e.variance)),
                      weft::testing::sidak(0.01, 9))
                << e.mean << " instead of " << albedo[k] << " at " << angle;
            ++tests;
        }
    }
    EXPECT_EQ(tests, 9); // what the correction assumes
}

/// A list of one gives back its lobe: sample and eval agree in world space too.
TEST(Bsdf, OneLobeAlone) {
    for_each_configuration<true>([&](auto const& c) {
        Vec3 const wo = kFrame.to_world(at_angle(40));
        Bsdf bsdf({kFrame, kFrame.n});
        bsdf.add(Color(0.5f), c.lobe);
        bsdf.prepare(wo);
        EXPECT_EQ(bsdf[0].pick, 1);
        Rng rng(hash_bytes(c.name));
        std::vector<float> errors;
        for (int i = 0; i < 500; ++i) {
            BsdfSample const s = bsdf.sample(wo, rng.next3());
            if (s.pdf == 0) continue;
            LobeValue const v = bsdf.eval(wo, s.wi);
            bool const transmits = dot(s.wi, kFrame.n) < 0;
            EXPECT_EQ(s.scattering.through, transmits);
            errors.push_back(std::abs(v.pdf - s.pdf) / s.pdf);
            errors.push_back(std::abs(v.f.g - s.weight.g * s.pdf) / std::max(v.f.g, 1e-6f));
        }
        // The way to world space and back rounds directions by another 1e-7; steep tails of
        // narrow lobes magnify it, so that a few values may stray.
        std::sort(errors.begin(), errors.end());
        if (errors.empty()) return;
        EXPECT_LE(errors[errors.size() * 9 / 10], std::max(1e-4f, 2 * c.resolution)) << c.name;
    });
}

TEST(Bsdf, NormalsThatDisagreeLeakNoLight) {
    Vec3 const wo = kFrame.to_world(at_angle(30, 0)), ng = kFrame.to_world(at_angle(50, 180));
    Bsdf const bsdf = mixture(ng, wo);
    Rng rng(8);
    int folded = 0;
    for (int i = 0; i < 2000; ++i) {
        BsdfSample const s = bsdf.sample(wo, rng.next3());
        if (!(s.pdf > 0)) continue;
        Vec3 const other = s.wi - ng * (2 * dot(s.wi, ng));
        folded += dot(other, kFrame.n) * dot(s.wi, ng) > 0;
        EXPECT_EQ(s.scattering.through, dot(s.wi, ng) < 0);
        LobeValue const v = bsdf.eval(wo, s.wi);
        if (is_delta(s.scattering.kind)) continue;
        EXPECT_NEAR(v.pdf, s.pdf, 1e-3f * s.pdf);
    }
    EXPECT_GT(folded, 100);
}

TEST(Bsdf, FoldedNormalsKeepAllPower) {
    // However far the shading normal is bent, white stays white, and densities integrate to 1.
    for (float const bend : {10.f, 40.f, 75.f}) {
        Vec3 const ng = kFrame.to_world(at_angle(bend, 0)), wo = kFrame.to_world(at_angle(10, 60));
        if (!(dot(wo, ng) > 0)) continue;
        LobeFrame const frame{kFrame, ng, BentNormals::Folded};
        Bsdf diffuse(frame), mirror(frame);
        diffuse.add(Color(1), Lambert{});
        mirror.add(Color(1), SpecularReflection{});
        Rng rng(uint64_t(bend) + 9);
        std::vector<double> density;
        for (int i = 0; i < 40000; ++i) {
            BsdfSample const s = diffuse.sample(wo, rng.next3());
            ASSERT_GT(dot(s.wi, ng), 0);
            ASSERT_NEAR(s.weight.g, 1, 1e-4);
            density.push_back(double(diffuse.eval(wo, square_to_sphere(rng.next2())).pdf) * 4 *
                              M_PI);
        }
        auto const e = weft::testing::estimate(density);
        EXPECT_GE(weft::testing::normal_tail((e.mean - 1) / std::sqrt(e.variance)),
                  weft::testing::sidak(0.01, 3))
            << e.mean << " at " << bend;
        BsdfSample const s = mirror.sample(wo, Vec3(0.5f));
        EXPECT_GT(dot(s.wi, ng), 0);
        EXPECT_NEAR(length(s.wi), 1, 1e-6);
        EXPECT_EQ(s.weight, Color(1));
    }
}

TEST(Bsdf, Bookkeeping) {
    Vec3 const wo = kFrame.n;
    Bsdf bsdf({kFrame, kFrame.n});
    EXPECT_EQ(bsdf.sample(wo, Vec3(0.5f)).pdf, 0);
    bsdf.add(Color(0), Lambert{});
    EXPECT_EQ(bsdf.size(), 0);
    bsdf.add(Color(1), SpecularDielectric{});
    EXPECT_FALSE(bsdf.has_smooth());
    EXPECT_EQ(bsdf.sides(), Sides::Both);
    EXPECT_EQ(bsdf.eval(wo, wo).f, Color());
    bsdf.add(Color(1), LobeVariant(Lambert{}));
    EXPECT_TRUE(bsdf.has_smooth());
    EXPECT_EQ(bsdf.sides(), Sides::Both);
    while (bsdf.size() < Bsdf::capacity) bsdf.add(Color(0.1f), Lambert{});
    bsdf.add(Color(0), Lambert{}); // adds nothing, so that it fits
    EXPECT_DEATH(bsdf.add(Color(0.1f), Lambert{}), "no room for another lobe");
    bsdf.prepare(wo);

    Bsdf const copy = bsdf;
    Bsdf assigned({kFrame, -kFrame.n});
    assigned = copy;
    EXPECT_EQ(assigned.size(), Bsdf::capacity);
    Vec3 const wi = kFrame.to_world(at_angle(30));
    EXPECT_EQ(assigned.eval(wo, wi).pdf, bsdf.eval(wo, wi).pdf);
    EXPECT_GT(assigned.eval(wo, wi).pdf, 0);
}

/// What `prepare` looks up once is what every `eval` would look up, and the picks are shared out by
/// the albedos whether the builder has looked them up or not.
TEST(Bsdf, LookUpsAreThoseOfEveryEval) {
    for_each_configuration<true>([&](auto const& c) {
        for (float const angle : {0.5f, 40.f, 85.f}) {
            Vec3 const wo = at_angle(angle);
            auto prepared = c.lobe, with_albedo = c.lobe;
            look_up(prepared, wo);
            Color const albedo = look_up_albedo(with_albedo, wo);
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(albedo[k], c.lobe.albedo(wo)[k], 1e-6f) << c.name;
            Rng rng(hash_bytes(c.name));
            for (int i = 0; i < 50; ++i) {
                Vec3 const wi = square_to_sphere(rng.next2());
                LobeValue const v = c.lobe.eval(wo, wi);
                for (auto const& lobe : {prepared, with_albedo}) {
                    LobeValue const again = lobe.eval(wo, wi);
                    EXPECT_NEAR(again.pdf, v.pdf, c.resolution * v.pdf) << c.name;
                    for (int k = 0; k < 3; ++k)
                        EXPECT_NEAR(again.f[k], v.f[k], c.resolution * v.f[k]) << c.name;
                }
            }
            Bsdf bsdf({Frame(Vec3(0, 0, 1)), {0, 0, 1}}), known({Frame(Vec3(0, 0, 1)), {0, 0, 1}});
            bsdf.add(Color(0.3f), c.lobe);
            known.add_looked_up(Color(0.3f), with_albedo, 0, albedo);
            for (Bsdf* b : {&bsdf, &known}) {
                b->add(Color(0.2f), Lambert{});
                b->prepare(wo);
            }
            EXPECT_NEAR(bsdf[0].pick, known[0].pick, 1e-6f) << c.name;
        }
    });
}

/// Inside glass at one radiance L, radiance leaving is L / eta^2-scaled both ways: in a furnace
/// of radiance n^2 (that of a cavity in equilibrium) every direction keeps that radiance.
TEST(Bsdf, FurnaceInsideGlass) {
    for (float const eta : {1.5f, 1 / 1.5f}) {
        for (float const angle : {5.f, 40.f, 60.f}) {
            SpecularDielectric const glass{eta};
            constexpr int n = 1 << 12;
            double radiance = 0; // wo's side has index 1 and so radiance 1, the far side eta^2
            for (int i = 0; i < n; ++i) {
                DeltaSample const s = glass.sample(at_angle(angle), {0, 0, (float(i) + 0.5f) / n});
                radiance += s.weight.g * (s.wi.z < 0 ? square(eta) : 1.f) / n;
            }
            EXPECT_NEAR(radiance, 1, 1e-5);
        }
    }
}

} // namespace
