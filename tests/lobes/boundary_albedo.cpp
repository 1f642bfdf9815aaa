// Albedos of rough boundaries between the nodes of their lattice, against sums over many normals.
#include "lobes/boundary_albedo.h"

#include <gtest/gtest.h>

#include "tests/lobes/configurations.h"

using namespace weft;
using namespace weft::lobes;

namespace {

float within(float low, float high, float u) { return low * std::pow(high / low, u); }

template <class D>
void expect_agreement(bool stretched, bool film, uint64_t seed) {
    Rng rng(seed);
    double worst = 0, sum = 0, splits = 0;
    std::string where;
    constexpr int n = 200;
    for (int i = 0; i < n; ++i) {
        D d{.alpha_x = within(0.02f, 1, rng.next()), .shadowing = Shadowing(i % 2)};
        d.alpha_y = stretched ? std::clamp(d.alpha_x * within(0.1f, 10, rng.next()), 0.02f, 1.f)
                              : d.alpha_x;
        float const ior = within(1.1f, 2.4f, rng.next()), eta = i % 4 < 2 ? ior : 1 / ior;
        BoundaryOptions options;
        if (film) options.film = {within(100, 900, rng.next()), within(1.2f, 2, rng.next()), 1};
        float const z = within(0.02f, 1, rng.next()), s = safe_sqrt(1 - z * z),
                    phi = 2 * kPi * rng.next();
        Vec3 const wo(s * std::cos(phi), s * std::sin(phi), z);
        BoundarySplit const lattice = boundary_albedo(d, eta, options, wo),
                            many = boundary_albedo_over_normals(d, eta, options, wo, 6765);
        Color const all = lattice.reflected + lattice.transmitted,
                    truth = many.reflected + many.transmitted;
        double e = 0, split = 0;
        for (int k = 0; k < 3; ++k) {
            e = std::max(e, double(std::abs(all[k] - truth[k])));
            split = std::max(split, double(std::abs(lattice.reflected[k] - many.reflected[k])));
        }
        splits += split;
        sum += e;
        if (e > worst) {
            worst = e;
            where = std::to_string(d.alpha_x) + " " + std::to_string(d.alpha_y) + " eta " +
                    std::to_string(eta) + " film " + std::to_string(options.film.thickness) +
                    " cosine " + std::to_string(z);
        }
    }
    std::printf("lattice off by %.5f in the mean, %.5f at worst: %s; reflection by %.5f\n", sum / n,
                worst, where.c_str(), splits / n);
    EXPECT_LT(worst, 1e-2) << where;
    EXPECT_LT(sum / n, 2e-3);
    EXPECT_LT(splits / n, 3e-3); // more at the critical angle, where it jumps
}

TEST(BoundaryAlbedo, OfStretchedGlass) {
    expect_agreement<Ggx>(true, false, 1);
    expect_agreement<Beckmann>(true, false, 2);
    expect_agreement<AshikhminShirley>(true, false, 3);
}
TEST(BoundaryAlbedo, OfFilmsOnRoughGlass) {
    expect_agreement<Ggx>(false, true, 4);
    expect_agreement<Beckmann>(true, true, 5);
}

/// A second look-up finds what the first one made.
TEST(BoundaryAlbedo, IsTheSameWheneverAsked) {
    Ggx const d{0.2f, 0.4f};
    Vec3 const wo = lobes::testing::at_angle(40, 0.3f);
    BoundarySplit const first = boundary_albedo(d, 1.5f, {}, wo);
    for (float z : {0.3f, 0.5f}) boundary_albedo(d, 1.5f, {}, {safe_sqrt(1 - z * z), 0, z});
    BoundarySplit const again = boundary_albedo(d, 1.5f, {}, wo);
    EXPECT_EQ(first.reflected, again.reflected);
    EXPECT_EQ(first.transmitted, again.transmitted);
}

} // namespace
