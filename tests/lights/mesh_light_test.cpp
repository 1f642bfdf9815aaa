// The triangles of a mesh as leaves of the light tree.
#include <gtest/gtest.h>

#include "base/distribution.h"
#include "base/hash.h"
#include "base/warp.h"
#include "lights/light_tree.h"
#include "tests/support/statistics.h"

namespace weft::lights {
namespace {

/// A wavy sheet of 2 n^2 triangles over [-1, 1]^2 that shines down, brightly in a few places.
struct Sheet {
    MeshEmitter mesh;
    std::vector<float> radiance;
    std::vector<LightBounds> bounds;
};

Sheet make_sheet(uint32_t n) {
    std::vector<Vec3> positions;
    std::vector<MeshEmitter::Triangle> triangles;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            float const x = 2 * float(i) / float(n) - 1, y = 2 * float(j) / float(n) - 1;
            positions.push_back({x, y, 0.2f * std::sin(9 * x) * std::cos(7 * y)});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            uint32_t const a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            triangles.push_back({a, c, b});
            triangles.push_back({b, c, d});
        }
    Sheet sheet{MeshEmitter(positions, triangles), {}, {}};
    for (uint32_t i = 0; i < sheet.mesh.primitives(); ++i) {
        Vec3 const p = sheet.mesh.point(i, Vec2(1 / 3.f));
        bool const bright = std::hypot(p.x - 0.4f, p.y + 0.3f) < 0.06f;
        sheet.radiance.push_back(bright ? 200.f : 0.1f);
        sheet.bounds.push_back(bounds_of(sheet.mesh, i));
        sheet.bounds.back().power = kPi * sheet.mesh.area(i) * sheet.radiance.back();
    }
    return sheet;
}

/// Estimates of the irradiance at `ref` on a surface that faces up; `choose(u)` gives a triangle
/// and its chance.
template <class Choose>
weft::testing::Estimate irradiance(Sheet const& sheet, Vec3 const& ref, int samples,
                                   Choose const& choose) {
    std::vector<double> values;
    Rng rng(3);
    for (int i = 0; i < samples; ++i) {
        float const u = rng.next();
        auto const [index, probability] = choose(u);
        Vec2 const at = rng.next2();
        double value = 0;
        if (probability > 0) {
            EmitterSample const s = sheet.mesh.sample(ref, at, index);
            if (s.pdf > 0 && dot(s.n, s.wi) < 0)
                value = double(sheet.radiance[index] * std::max(s.wi.z, 0.f)) /
                        (double(s.pdf) * double(probability));
        }
        values.push_back(value);
    }
    return weft::testing::estimate(values);
}

TEST(MeshLight, of_uneven_emission_is_sampled_where_it_shines) {
    Sheet const sheet = make_sheet(100);
    LightTree const tree(sheet.bounds);
    std::vector<float> areas;
    for (uint32_t i = 0; i < sheet.mesh.primitives(); ++i) areas.push_back(sheet.mesh.area(i));
    Distribution1D const by_area(areas);
    Vec3 const up{0, 0, 1};
    struct {
        Vec3 ref;
        double gain; ///< at least, in variance
    } const places[] = {{{0.2f, 0, -1}, 50},
                        {{2, 1, -3}, 50},
                        // Of the bright place next to nothing faces this way, which the bounds
                        // know only near the leaves: half of the choices end without one.
                        {{-0.6f, 0.5f, -0.5f}, 0.5}};
    for (auto const& [at_ref, gain] : places) {
        Vec3 const ref = at_ref;
        auto const from_tree = irradiance(sheet, ref, 200'000, [&](float u) {
            auto const c = tree.choose(ref, up, double(u));
            return std::pair(c.index, c.probability);
        });
        auto const from_areas = irradiance(sheet, ref, 200'000, [&](float u) {
            auto const c = by_area.choose(u);
            return std::pair(c.index, c.probability);
        });
        double const sigma = std::sqrt(from_tree.variance + from_areas.variance);
        EXPECT_LT(std::abs(from_tree.mean - from_areas.mean), 4 * sigma) << ref;
        EXPECT_GT(from_areas.variance / from_tree.variance, gain) << ref;
    }
}

TEST(MeshLight, of_a_million_triangles_fits) {
    Sheet const sheet = make_sheet(700);
    size_t const count = sheet.mesh.primitives();
    LightTree const tree(sheet.bounds);
    EXPECT_LT(tree.memory_bytes(), 130 * count);
    // Near the sheet, where the chances of neighbours are far below the digits of a float.
    Vec3 const ref{0.1f, 0.2f, -0.3f}, up{0, 0, 1};
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) sum += double(tree.probability(ref, up, i));
    EXPECT_LT(sum, 1 + 1e-3);
    Rng rng(1);
    int const samples = 20'000;
    std::vector<double> something(samples);
    for (double& any : something) {
        auto const c = tree.choose(ref, up, double(rng.next()) + double(rng.next()) * 0x1p-24);
        any = c.probability > 0;
        ASSERT_EQ(c.probability, any > 0 ? tree.probability(ref, up, c.index) : 0);
    }
    auto const found = weft::testing::estimate(something);
    EXPECT_LT(std::abs(found.mean - sum), 4 * std::sqrt(found.variance));
}

} // namespace
} // namespace weft::lights
