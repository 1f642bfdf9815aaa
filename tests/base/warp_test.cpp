// Every warp against its stated density, by chi-square.
#include "base/warp.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "base/hash.h"
#include "tests/support/statistics.h"

namespace weft {
namespace {

constexpr double kSignificance = 0.01;
constexpr int kSamples = 1 << 20;
constexpr int kRows = 24, kColumns = 48;

double azimuth(float x, float y) {
    double const phi = std::atan2(double(y), double(x)) / (2 * M_PI);
    return phi < 0 ? phi + 1 : phi;
}

int cell(double t, int n) { return std::clamp(int(t * n), 0, n - 1); }

/// A warp seen through a chart of its domain by (a, b) in [0, 1]^2: `chart` takes a sample there,
/// `density` is the stated density times the area (or solid angle) per unit of (a, b).
struct Warp {
    std::string name;
    std::function<std::pair<double, double>(Vec2)> chart;
    std::function<double(double, double)> density;
};

std::vector<Warp> warps() {
    std::vector<Warp> all;
    all.push_back({"disk",
                   [](Vec2 u) {
                       Vec2 const p = square_to_disk(u);
                       EXPECT_LE(dot(p, p), 1 + 1e-6f);
                       return std::pair(double(p.x) * p.x + double(p.y) * p.y, azimuth(p.x, p.y));
                   },
                   [](double, double) { return kInvPi * M_PI; }}); // dA = 1/2 d(r^2) dphi
    all.push_back({"cosine hemisphere",
                   [](Vec2 u) {
                       Vec3 const w = square_to_cosine_hemisphere(u);
                       EXPECT_NEAR(length_squared(w), 1, 1e-5);
                       EXPECT_GE(w.z, 0);
                       return std::pair(double(w.z), azimuth(w.x, w.y));
                   },
                   [](double z, double) { return cosine_hemisphere_pdf(float(z)) * 2 * M_PI; }});
    all.push_back({"sphere",
                   [](Vec2 u) {
                       Vec3 const w = square_to_sphere(u);
                       EXPECT_NEAR(length_squared(w), 1, 1e-5);
                       return std::pair((double(w.z) + 1) / 2, azimuth(w.x, w.y));
                   },
                   [](double, double) { return kSpherePdf * 4 * M_PI; }});
    for (float h : {1e-7f, 1e-3f, 0.3f, 1.f, 1.7f, 2.f})
        all.push_back({"cone with 1 - cos = " + std::to_string(h),
                       [h](Vec2 u) {
                           Vec3 const w = square_to_cone(u, h);
                           EXPECT_NEAR(length_squared(w), 1, 1e-5);
                           // 1 - cos from the sine, which small cones hold more exactly.
                           double const sin2 = double(w.x) * w.x + double(w.y) * w.y;
                           double const a = w.z > 0 ? sin2 / (1 + double(w.z)) : 1 - double(w.z);
                           EXPECT_LE(a, h * 1.00001);
                           return std::pair(a / h, azimuth(w.x, w.y));
                       },
                       [h](double, double) { return cone_pdf(h) * 2 * M_PI * h; }});
    return all;
}

TEST(Warp, SamplesFollowTheStatedDensity) {
    constexpr int kPoints = 16;
    auto const all = warps();
    double const level = testing::sidak(kSignificance, int(all.size()));
    for (size_t k = 0; k < all.size(); ++k) {
        std::vector<double> observed(kRows * kColumns), expected(kRows * kColumns);
        double total = 0;
        for (int i = 0; i < kRows * kPoints; ++i)
            for (int j = 0; j < kColumns * kPoints; ++j) {
                double const a = (i + 0.5) / (kRows * kPoints),
                             b = (j + 0.5) / (kColumns * kPoints);
                double const mass =
                    all[k].density(a, b) / double(expected.size()) / (kPoints * kPoints);
                expected[size_t(i / kPoints * kColumns + j / kPoints)] += mass * kSamples;
                total += mass;
            }
        EXPECT_NEAR(total, 1, 1e-6) << all[k].name;
        Rng rng(k);
        for (int i = 0; i < kSamples; ++i) {
            auto const [a, b] = all[k].chart(rng.next2());
            observed[size_t(cell(a, kRows) * kColumns + cell(b, kColumns))] += 1;
        }
        testing::ChiSquare const test = testing::chi_square(observed, expected);
        EXPECT_GT(test.p_value, level) << all[k].name << " chi2 " << test.statistic << " dof "
                                       << test.dof << " " << test.problem;
    }
}

/// Cells of the (b1, b2) square below its diagonal are whole, those on it halves.
TEST(Warp, TriangleIsUniform) {
    constexpr int n = 32;
    std::vector<double> observed(n * n), expected(n * n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j)
            expected[size_t(i * n + j)] = kSamples * (i + j == n - 1 ? 1.0 : 2.0) / (n * n);
    Rng rng(77);
    for (int i = 0; i < kSamples; ++i) {
        Vec2 const b = square_to_triangle(rng.next2());
        ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1);
        int const row = cell(b.x, n);
        // Rounding may put a point of the hypotenuse into the cell beyond it.
        observed[size_t(row * n + std::min(cell(b.y, n), n - 1 - row))] += 1;
    }
    testing::ChiSquare const test = testing::chi_square(observed, expected);
    EXPECT_GT(test.p_value, kSignificance) << test.statistic << " dof " << test.dof;
}

/// The corners, edges and centre of the square must not give NaN or leave the domain.
TEST(Warp, ExtremeNumbersStayInTheDomain) {
    float const values[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, kOneMinusEpsilon};
    for (float x : values)
        for (float y : values) {
            Vec2 const u(x, y), d = square_to_disk(u), b = square_to_triangle(u);
            EXPECT_LE(dot(d, d), 1 + 1e-6f);
            EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1);
            for (Vec3 const& w : {square_to_cosine_hemisphere(u), square_to_sphere(u),
                                  square_to_cone(u, 1e-6f), square_to_cone(u, 2)})
                EXPECT_NEAR(length_squared(w), 1, 1e-5) << u;
        }
    EXPECT_EQ(square_to_disk(Vec2(0.5f)), Vec2(0));
    EXPECT_EQ(cosine_hemisphere_pdf(-0.5f), 0);
}

} // namespace
TEST(Warp, CosineAndSineOfAnOctant) {
    for (int i = -10000; i <= 10000; ++i) {
        float const a = float(i) * (kPi / 4) / 10000;
        Vec2 const v = cos_sin_octant(a);
        ASSERT_NEAR(v.x, std::cos(double(a)), 6e-8);
        ASSERT_NEAR(v.y, std::sin(double(a)), 6e-8);
    }
}

} // namespace weft
