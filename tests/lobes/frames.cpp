// Lists whose lobes lie around several frames: layers with normals of their own.
#include <gtest/gtest.h>

#include "tests/lobes/configurations.h"
#include "tests/lobes/sphere_chi_square.h"

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::testing;

namespace {

Vec3 const kNg(0, 0, 1);

constexpr std::array kRules{BentNormals::Dropped, BentNormals::Softened, BentNormals::Folded};

/// A base, a coat and a sheet that scatters through, each bent by `bend` degrees its own way.
Bsdf bent(float bend, Vec3 const& wo, BentNormals rule) {
    Bsdf bsdf({Frame(at_angle(bend, 30)), kNg, rule});
    bsdf.add(Color(0.4f, 0.3f, 0.2f), Lambert{});
    bsdf.use_frame(Frame(at_angle(bend, 200), Vec3(0, 1, 0)));
    bsdf.add(Color(0.2f, 0.3f, 0.3f), GgxReflection{{0.2f, 0.4f}});
    bsdf.use_frame(Frame(at_angle(bend, 110)));
    bsdf.add(Color(0.2f), BeckmannDielectric({0.5f, 0.5f}, 1.5f));
    bsdf.add(Color(0.1f, 0.2f, 0.1f), DiffuseTransmission{});
    bsdf.prepare(wo);
    return bsdf;
}

TEST(Frames, SamplesFollowTheDensity) {
    std::vector<SphereTest> tests;
    for (float const bend : {15.f, 40.f})
        for (BentNormals const rule : kRules) {
            Vec3 const wo = at_angle(bend == 15 ? 5 : 45, 80);
            Bsdf const bsdf = bent(bend, wo, rule);
            auto const sample = [&](Vec3 const& u) {
                BsdfSample const s = bsdf.sample(wo, u);
                return s.pdf > 0 ? s.wi : Vec3(0);
            };
            auto const density = [&](Vec3 const& w) { return bsdf.eval(wo, w).pdf; };
            tests.push_back(SphereChiSquare(sample, density).run(7 + tests.size(), 1 << 16));
        }
    double const level = weft::testing::sidak(0.01, 2 * int(tests.size()));
    for (SphereTest const& t : tests) {
        EXPECT_GE(t.chi_square.p_value, level)
            << t.chi_square.statistic << " of " << t.chi_square.dof << t.chi_square.problem;
        double const sigma = std::sqrt(t.success * (1 - t.success) / (1 << 16));
        double const beyond = std::max(std::abs(t.integral - t.success) - 1e-3, 0.0);
        EXPECT_TRUE(beyond == 0 || weft::testing::normal_tail(beyond / sigma) >= level)
            << t.integral << " " << t.success;
    }
}

TEST(Frames, SamplesWeighWhatEvalSays) {
    Vec3 const wo = at_angle(35, 80);
    for (BentNormals const rule : kRules) {
        Bsdf const bsdf = bent(40, wo, rule);
        Rng rng(3);
        for (int i = 0; i < 2000; ++i) {
            BsdfSample const s = bsdf.sample(wo, rng.next3());
            if (!(s.pdf > 0)) continue;
            LobeValue const v = bsdf.eval(wo, s.wi);
            EXPECT_EQ(v.pdf, s.pdf);
            EXPECT_EQ(s.scattering.through, s.wi.z < 0);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(s.weight[k] * s.pdf, v.f[k], 1e-5f * v.f[k]);
        }
    }
}

/// Each list is the sum of its lobes, whatever frames stand between them.
TEST(Frames, EvalIsTheSumOverFrames) {
    Vec3 const wo = at_angle(35, 80);
    Frame const frames[]{Frame(at_angle(30, 30)), Frame(at_angle(40, 200)), Frame(kNg)};
    Bsdf all({frames[0], kNg});
    std::vector<Bsdf> alone;
    for (int i = 0; i < 6; ++i) { // back and forth between them
        Frame const& frame = frames[size_t(i % 3)];
        all.use_frame(frame);
        all.add(Color(0.1f), GgxReflection{{0.3f, 0.3f}});
        alone.emplace_back(LobeFrame{frame, kNg});
        alone.back().add(Color(0.1f), GgxReflection{{0.3f, 0.3f}});
    }
    Rng rng(4);
    for (int i = 0; i < 1000; ++i) {
        Vec3 const wi = square_to_sphere(rng.next2());
        float sum = 0;
        for (Bsdf const& b : alone) sum += b.eval(wo, wi).f.g;
        EXPECT_NEAR(all.eval(wo, wi).f.g, sum, 1e-5f * sum);
    }
}

/// White lobes around bent frames send all of their power to the right side of the surface.
TEST(Frames, FoldingKeepsAllPower) {
    int tests = 0;
    for (float const bend : {20.f, 60.f})
        for (float const angle : {0.f, 25.f}) {
            Vec3 const wo = at_angle(angle, 80);
            Bsdf bsdf({Frame(at_angle(bend, 30)), kNg, BentNormals::Folded});
            bsdf.add(Color(0.5f), Lambert{});
            bsdf.use_frame(Frame(at_angle(bend, 200)));
            bsdf.add(Color(0.3f), OrenNayar(Color(1), 1));
            bsdf.use_frame(Frame(at_angle(bend, 110)));
            bsdf.add(Color(0.2f), DiffuseTransmission{});
            bsdf.prepare(wo);
            Rng rng(uint64_t(bend + angle) + 1);
            std::vector<double> sampled, above, below;
            for (int i = 0; i < 60000; ++i) {
                BsdfSample const s = bsdf.sample(wo, rng.next3());
                sampled.push_back(s.pdf > 0 ? double(s.weight.g) : 0);
                if (s.pdf > 0) {
                    EXPECT_EQ(s.scattering.through, s.wi.z < 0);
                }
                Vec3 const wi = square_to_sphere(rng.next2());
                double const f = double(bsdf.eval(wo, wi).f.g) * 4 * M_PI;
                above.push_back(wi.z > 0 ? f : 0);
                below.push_back(wi.z < 0 ? f : 0);
            }
            auto const expect = [&](std::vector<double> const& values, double power) {
                auto const e = weft::testing::estimate(values);
                EXPECT_GE(weft::testing::normal_tail((e.mean - power) / std::sqrt(e.variance)),
                          weft::testing::sidak(0.01, 12))
                    << e.mean << " instead of " << power << " at " << bend << ", " << angle;
                ++tests;
            };
            expect(sampled, 1);
            expect(above, 0.8);
            expect(below, 0.2);
        }
    EXPECT_EQ(tests, 12); // what the correction assumes
}

/// Of the cosine lobe around a normal that is bent by b, the part (1 + cos b) / 2 lies above the
/// surface.
TEST(Frames, DroppedLightIsWhatLiesBelow) {
    Vec3 const wo = at_angle(10, 80);
    for (float const bend : {0.f, 20.f, 60.f}) {
        Bsdf bsdf({Frame(at_angle(bend, 30)), kNg});
        bsdf.add(Color(1), Lambert{});
        bsdf.prepare(wo);
        Rng rng(uint64_t(bend) + 1);
        std::vector<double> sampled, evaluated;
        for (int i = 0; i < 60000; ++i) {
            BsdfSample const s = bsdf.sample(wo, rng.next3());
            sampled.push_back(s.pdf > 0 ? double(s.weight.g) : 0);
            Vec3 const wi = square_to_sphere(rng.next2());
            evaluated.push_back(double(bsdf.eval(wo, wi).f.g) * 4 * M_PI);
        }
        double const power = (1 + std::cos(double(radians(bend)))) / 2;
        for (auto const& values : {sampled, evaluated}) {
            auto const e = weft::testing::estimate(values);
            double const beyond = std::max(std::abs(e.mean - power) - 1e-5, 0.0);
            EXPECT_TRUE(beyond == 0 || weft::testing::normal_tail(beyond / std::sqrt(e.variance)) >=
                                           weft::testing::sidak(0.01, 6))
                << e.mean << " instead of " << power << " at " << bend;
        }
    }
}

/// The equations of Chiang, Li and Burley 2019, for directions all around.
TEST(Frames, SoftenedDiffuseLightFades) {
    Vec3 const wo = at_angle(10, 80);
    for (float const bend : {0.f, 5.f, 30.f, 70.f}) {
        Vec3 const n = at_angle(bend, 30);
        Bsdf soft({Frame(n), kNg, BentNormals::Softened}), hard({Frame(n), kNg}), glossy = soft;
        for (Bsdf* b : {&soft, &hard}) b->add(Color(1), OrenNayar(Color(0.8f), 0.5f));
        glossy.add(Color(1), GgxReflection{{0.4f, 0.4f}});
        Bsdf glossy_hard({Frame(n), kNg});
        glossy_hard.add(Color(1), GgxReflection{{0.4f, 0.4f}});
        for (Bsdf* b : {&soft, &hard, &glossy, &glossy_hard}) b->prepare(wo);
        Rng rng(uint64_t(bend) + 1);
        int faded = 0;
        for (int i = 0; i < 4000; ++i) {
            Vec3 const wi = square_to_sphere(rng.next2());
            LobeValue const s = soft.eval(wo, wi), h = hard.eval(wo, wi);
            EXPECT_EQ(s.pdf, h.pdf);
            double const g = std::min(
                1.0, double(wi.z) / (double(dot(wi, n)) * std::cos(double(radians(bend)))));
            double const fade = wi.z > 0 && dot(wi, n) > 0 ? -g * g * g + g * g + g : 0;
            EXPECT_NEAR(double(s.f.g), fade * double(h.f.g), 2e-4 * double(h.f.g)) << bend;
            faded += s.f.g < 0.99f * h.f.g;
            // What is glossy has a border of its own.
            EXPECT_EQ(glossy.eval(wo, wi).f, glossy_hard.eval(wo, wi).f);
        }
        EXPECT_EQ(faded > 50, bend > 1) << bend;
    }
}

TEST(Frames, ThereIsRoomForOneOfEachLobe) {
    Bsdf bsdf({Frame(kNg), kNg});
    for (int i = 0; i < Bsdf::capacity; ++i) {
        bsdf.use_frame(Frame(at_angle(80, float(i) + 200))); // without a lobe it takes no room
        bsdf.use_frame(Frame(at_angle(float(i + 1), 0)));
        bsdf.add(Color(0.01f), Lambert{});
    }
    bsdf.use_frame(Frame(at_angle(80, 100)));
    Bsdf const copy = bsdf;
    for (int i = 0; i < Bsdf::capacity; ++i)
        EXPECT_EQ(copy.frame(copy[i]), Frame(at_angle(float(i + 1), 0)));
    EXPECT_EQ(copy.frame(), Frame(kNg));
}

TEST(Frames, AreFoundAgain) {
    Bsdf bsdf({Frame(kNg), kNg});
    Frame const other(at_angle(20));
    for (int i = 0; i < 6; ++i) {
        bsdf.use_frame(i % 2 ? other : Frame(kNg));
        bsdf.add(Color(0.1f), Lambert{});
        EXPECT_EQ(bsdf[i].frame, i % 2);
    }
    bsdf.prepare(kNg);
    EXPECT_GT(bsdf.sample(kNg, Vec3(0.5f)).pdf, 0);
}

} // namespace
