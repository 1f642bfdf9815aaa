// Noises against their definitions.
#include "shading/noise.h"

#include <cmath>
#include <set>

#include "tests/shading/networks.h"

using namespace weft;
using namespace weft::testing;

namespace {

/// The gradient at a whole place, found from the noise's slopes there.
Vec3d gradient_at(Vec3 const& corner) {
    constexpr float h = 0x1p-10f;
    Vec3d g;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 ahead = corner, behind = corner;
        ahead[axis] += h, behind[axis] -= h;
        g[axis] = (shading::perlin_noise(ahead) - shading::perlin_noise(behind)) / (2 * h) / 0.982;
    }
    return g;
}

TEST(Noise, PerlinIsTheBlendOfItsGradients) {
    Rng rng(1);
    for (int i = 0; i < 300; ++i) {
        Vec3 const cell(std::floor(rng.next() * 40 - 20), std::floor(rng.next() * 40 - 20),
                        std::floor(rng.next() * 40 - 20));
        Vec3 const f = rng.next3();
        double expected = 0;
        for (int corner = 0; corner < 8; ++corner) {
            Vec3 const offset(float(corner & 1), float(corner >> 1 & 1), float(corner >> 2));
            EXPECT_NEAR(shading::perlin_noise(cell + offset), 0, 1e-6);
            Vec3d const g = gradient_at(cell + offset);
            // One of the twelve edges of a cube.
            EXPECT_NEAR(length_squared(g), 2, 1e-2);
            EXPECT_NEAR(g.x * g.y * g.z, 0, 1e-2);
            double weight = 1;
            for (int axis = 0; axis < 3; ++axis) {
                double const t = f[axis];
                double const s = 6 * std::pow(t, 5) - 15 * std::pow(t, 4) + 10 * std::pow(t, 3);
                weight *= offset[axis] == 1 ? s : 1 - s;
            }
            expected += weight * dot(g, Vec3d(f - offset));
        }
        EXPECT_NEAR(shading::perlin_noise(cell + f), 0.982 * expected, 2e-3);
    }
}

TEST(Noise, PerlinInThePlaneIsSmoothAndZeroOnTheGrid) {
    Rng rng(2);
    double sum = 0, sum2 = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
        Vec2 const p = rng.next2() * 100.f - Vec2(50);
        float const x = shading::perlin_noise(p);
        EXPECT_LT(std::abs(x), 1.01f);
        EXPECT_NEAR(x, shading::perlin_noise(p + Vec2(1e-3f)), 1e-2);
        EXPECT_NEAR(shading::perlin_noise(Vec2(std::floor(p.x), std::floor(p.y))), 0, 1e-6);
        sum += x, sum2 += x * x;
    }
    EXPECT_NEAR(sum / n, 0, 0.02);
    EXPECT_GT(sum2 / n, 0.02);
}

TEST(Noise, CellsAreConstantAndDiffer) {
    EXPECT_EQ(shading::cell_noise(Vec3(0.1f, 5.2f, -3.9f)),
              shading::cell_noise(Vec3(0.9f, 5.8f, -3.1f)));
    std::set<float> values;
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
        float const x =
            shading::cell_noise(Vec3(float(i % 10), float(i / 10 % 10) - 5, float(i / 100)));
        values.insert(x);
        sum += x;
        EXPECT_TRUE(x >= 0 && x < 1);
    }
    EXPECT_GT(values.size(), 990u);
    EXPECT_NEAR(sum / 1000, 0.5, 0.04); // 4.4 standard deviations
}

TEST(Noise, WorleyMeasuresDistances) {
    Rng rng(3);
    for (int i = 0; i < 2000; ++i) {
        Vec3 const p = rng.next3() * 20.f - Vec3(10), d = (rng.next3() - Vec3(0.5f)) * 0.2f;
        // Without jitter the points are the centres of cells.
        Vec3 const centre(std::floor(p.x) + 0.5f, std::floor(p.y) + 0.5f, std::floor(p.z) + 0.5f);
        EXPECT_NEAR(shading::worley_noise(p, 0).f1, length(p - centre), 1e-5);
        auto const here = shading::worley_noise(p, 1), there = shading::worley_noise(p + d, 1);
        EXPECT_LE(here.f1, here.f2);
        EXPECT_LE(std::abs(here.f1 - there.f1), length(d) + 1e-5f);
        auto const flat = shading::worley_noise(Vec2(p.x, p.y), 0);
        EXPECT_NEAR(flat.f1, std::hypot(p.x - centre.x, p.y - centre.y), 1e-5);
    }
}

TEST(Noise, NodesAddAmplitudePivotAndOctaves) {
    Rng rng(4);
    for (int i = 0; i < 50; ++i) {
        auto const point = random_point(rng);
        Network net;
        nodes::Noise3d noise{{2}, {0.5f}, {}};
        EXPECT_NEAR(net.at(net.add(noise), point).x, 0.5f + 2 * shading::perlin_noise(point.p),
                    1e-6);
        nodes::Noise2d flat{{3}, {-1}, {}};
        EXPECT_NEAR(net.at(net.add(flat), point).x, -1 + 3 * shading::perlin_noise(point.uv), 1e-6);
        nodes::Fractal3d fractal;
        fractal.amplitude.value = 2, fractal.octaves = 4;
        fractal.lacunarity.value = 3, fractal.diminish.value = 0.25f;
        double expected = 0;
        for (int k = 0; k < 4; ++k)
            expected +=
                2 * std::pow(0.25, k) * shading::perlin_noise(point.p * float(std::pow(3, k)));
        EXPECT_NEAR(net.at(net.add(fractal), point).x, expected, 1e-5);
        auto const worley = shading::worley_noise(point.p, 0.7f);
        nodes::WorleyNoise3d cells{{0.7f}, nodes::WorleyFeature::f2_f1, {}};
        EXPECT_NEAR(net.at(net.add(cells), point).x, worley.f2 - worley.f1, 1e-6);
        EXPECT_EQ(net.at(net.add(nodes::CellNoise3d{}), point).x, shading::cell_noise(point.p));
    }
}

} // namespace
