// Frames and affine maps.
#include <gtest/gtest.h>

#include <vector>

#include "base/affine.h"
#include "base/frame.h"
#include "base/hash.h"
#include "base/warp.h"

namespace weft {
namespace {

/// Directions everywhere, the axes, and those next to the pole where a naive frame breaks.
std::vector<Vec3> directions() {
    std::vector<Vec3> list = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (float e : {1e-2f, 1e-4f, 1e-6f, 1e-20f})
        for (float z : {1.f, -1.f}) list.push_back(normalize(Vec3(e, -e, z)));
    Rng rng(1);
    for (int i = 0; i < 5000; ++i) list.push_back(normalize(square_to_sphere(rng.next2())));
    return list;
}

void expect_orthonormal(Frame const& f) {
    EXPECT_NEAR(dot(f.s, f.s), 1, 2e-6);
    EXPECT_NEAR(dot(f.t, f.t), 1, 2e-6);
    EXPECT_NEAR(dot(f.n, f.n), 1, 2e-6);
    EXPECT_NEAR(dot(f.s, f.t), 0, 1e-6);
    EXPECT_NEAR(dot(f.s, f.n), 0, 1e-6);
    EXPECT_NEAR(dot(f.t, f.n), 0, 1e-6);
    EXPECT_NEAR(dot(cross(f.s, f.t), f.n), 1, 3e-6); // right-handed
}

TEST(Frame, IsOrthonormalAndRightHandedAroundAnyNormal) {
    for (Vec3 const& n : directions()) {
        Frame const f(n);
        EXPECT_EQ(f.n, n);
        expect_orthonormal(f);
        Vec3 const v(0.3f, -2, 0.7f);
        EXPECT_LT(length(f.to_world(f.to_local(v)) - v), 3e-6f) << n;
        EXPECT_LT(length(f.to_local(n) - Vec3(0, 0, 1)), 2e-6f) << n;
    }
    expect_orthonormal(Frame());
}

TEST(Frame, FollowsTheTangent) {
    Rng rng(2);
    for (Vec3 const& n : directions()) {
        Vec3 const tangent = square_to_sphere(rng.next2()) * 3.f;
        Frame const f(n, tangent);
        expect_orthonormal(f);
        EXPECT_NEAR(dot(tangent, f.t), 0, 1e-5);
        EXPECT_GE(dot(tangent, f.s), 0);
    }
}

TEST(Frame, TangentNearTheNormalIsNoWorse) {
    for (Vec3 const& n : directions())
        for (float e : {1e-2f, 1e-4f, 1e-5f, 3e-6f})
            expect_orthonormal(Frame(n, n + Frame(n).s * e));
}

TEST(Frame, TangentAlongTheNormalGivesSomeFrame) {
    for (Vec3 const& n : directions()) {
        expect_orthonormal(Frame(n, n * 5.f));
        expect_orthonormal(Frame(n, Vec3(0)));
    }
}

/// Mirrors, shears, turns, unequal scales, and random maps.
std::vector<Affined> maps() {
    std::vector<Affined> list = {
        {},
        {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}},       // mirror
        {{1, 0, 0}, {0.9, 1, 0}, {-2, 0.3, 1}, {0, 0, -4}},  // shear
        {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {5, 0, 0}},       // quarter turn
        {{1e-3, 0, 0}, {0, 40, 0}, {0, 0, 2}, {7, 7, 7}},    // unequal scale
        {{0, 0, -2}, {0, 3, 0.5}, {1, -1, 0}, {-1, 0, 100}}, // all of it
    };
    Rng rng(3);
    while (list.size() < 200) {
        auto column = [&] {
            Vec3 const v = rng.next3() * 2.f - Vec3(1);
            return Vec3d(v.x, v.y, v.z);
        };
        Vec3d const x = column(), y = column(), z = column();
        if (Affined const m(x, y, z, column()); std::abs(m.determinant()) > 0.05) list.push_back(m);
    }
    return list;
}

Vec3d random_vector(Rng& rng) {
    Vec3 const v = rng.next3() * 4.f - Vec3(2);
    return {v.x, v.y, v.z};
}

TEST(Affine, InverseUndoesTheMap) {
    Rng rng(4);
    for (Affined const& m : maps()) {
        Affined const inverse = m.inverse(), both = m * inverse;
        EXPECT_NEAR(both.determinant(), 1, 1e-12);
        EXPECT_LT(length(both.origin), 1e-10);
        EXPECT_NEAR(inverse.determinant() * m.determinant(), 1, 1e-12);
        for (int i = 0; i < 10; ++i) {
            Vec3d const p = random_vector(rng);
            EXPECT_LT(length(inverse.point(m.point(p)) - p), 1e-11);
            EXPECT_LT(length(m.vector(inverse.vector(p)) - p), 1e-11);
            EXPECT_LT(length(m.vector(p) - (m.point(p) - m.point(Vec3d(0)))), 1e-12);
        }
    }
}

TEST(Affine, SinglePrecisionInverseIsGoodToItsRounding) {
    Rng rng(5);
    for (Affined const& m : maps()) {
        Affine const f(m), inverse = f.inverse();
        for (int i = 0; i < 10; ++i) {
            Vec3 const p = Vec3(random_vector(rng));
            float const condition =
                1 +
                length(f.point(p)) * (length(inverse.x) + length(inverse.y) + length(inverse.z));
            EXPECT_LT(length(inverse.point(f.point(p)) - p), 1e-6f * condition * condition);
        }
    }
}

TEST(Affine, ProductAppliesTheRightFactorFirst) {
    auto const all = maps();
    Rng rng(6);
    for (size_t i = 1; i < all.size(); ++i) {
        Affined const &a = all[i - 1], &b = all[i];
        Vec3d const p = random_vector(rng);
        double const scale = 1 + length(a.point(b.point(p)));
        EXPECT_LT(length((a * b).point(p) - a.point(b.point(p))), 5e-11 * scale);
        EXPECT_NEAR((a * b).determinant(), a.determinant() * b.determinant(),
                    1e-12 * (1 + std::abs(a.determinant() * b.determinant())));
    }
}

TEST(Affine, DeterminantIsTheSignedVolume) {
    EXPECT_EQ(maps()[1].determinant(), -1); // mirror
    EXPECT_EQ(maps()[2].determinant(), 1);  // shear
    EXPECT_EQ(maps()[3].determinant(), 1);  // turn
    EXPECT_NEAR(maps()[4].determinant(), 0.08, 1e-15);
}

/// A normal n of the plane of tangents a and b stays perpendicular to both images, on the side
/// that the map sends the outside to.
TEST(Affine, NormalsStayPerpendicular) {
    Rng rng(7);
    for (Affined const& m : maps()) {
        Affined const inverse = m.inverse();
        for (int i = 0; i < 10; ++i) {
            Vec3d const a = random_vector(rng), b = random_vector(rng);
            Vec3d const n = normalize(cross(a, b)), mapped = normalize(inverse.transposed(n));
            Vec3d const ma = normalize(m.vector(a)), mb = normalize(m.vector(b));
            EXPECT_NEAR(dot(mapped, ma), 0, 1e-9);
            EXPECT_NEAR(dot(mapped, mb), 0, 1e-9);
            EXPECT_GT(dot(mapped, m.vector(n)), 0);
            // The cross product of the images turns over where the map mirrors.
            double const side = dot(cross(m.vector(a), m.vector(b)), mapped);
            EXPECT_EQ(side > 0, m.determinant() > 0);
        }
    }
}

} // namespace
} // namespace weft
