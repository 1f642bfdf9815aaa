// What becomes of light that bent normals send below the surface: pictures that are known on paper.
#include <gtest/gtest.h>

#include "integrator/vertex.h"
#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

std::string const kWhiteSky =
    R"(<light type="envmap"><texture type="constant" value="1"/></light>)";
std::string const kLookDown =
    R"(<camera type="perspective" width="4" height="4" fov="0.01"><transform><lookat origin="0,0,4" target="0,0,0" up="0,1,0"/></transform></camera>)";
/// The same reflectance, as lightwave draws it and with the soft borders of Cycles.
std::string const kHard = R"(<bsdf type="diffuse" albedo="0.8"/>)";
std::string const kSoft = R"(<bsdf type="translucent" reflectance="0.8" transmittance="0"/>)";

/// A floor in the plane z = 0, all of whose normals lean towards +x by `angle` degrees.
std::string leaning_floor(double angle, std::string const& bsdf) {
    double const t = angle * M_PI / 180;
    return "<instance><shape type=\"rectangle\"/>" + bsdf +
           "<texture name=\"normal\" type=\"constant\" value=\"" +
           std::to_string(0.5 + 0.5 * std::sin(t)) + ",0.5," +
           std::to_string(0.5 + 0.5 * std::cos(t)) + "\"/></instance>";
}
/// Of irradiance 1 per area across it; it comes from `angle` degrees off +z towards +x.
std::string sun(double angle) {
    double const t = angle * M_PI / 180;
    return "<light type=\"directional\" direction=\"" + std::to_string(std::sin(t)) + ",0," +
           std::to_string(std::cos(t)) + "\" intensity=\"1\"/>";
}

/// z-tests of the whole picture, `tests` of which are made at this level.
void expect_mean(TestScene const& scene, double truth, int tests, std::string const& what) {
    Estimate const e = block_estimates(scene, 2000, scene.world->camera().size().x, 5)[1];
    EXPECT_GT(difference_p_value(e, {truth, 1e-12}), sidak(0.01, tests))
        << what << ": " << e.mean << " +- " << std::sqrt(e.variance) << " instead of " << truth;
}

/// Chiang, Li and Burley 2019, eq. 2 and 3.
double fade(double surface_i, double bent_i, double surface_bent) {
    if (surface_i <= 0 || bent_i <= 0) return 0;
    double const g = std::min(1.0, surface_i / (bent_i * surface_bent));
    return g + g * g - g * g * g;
}

TEST(BentNormals, UnderAWhiteSky) {
    double const t = 35 * M_PI / 180;
    // The part of the bent cosine lobe above the floor, and what fading leaves of it.
    double soft = 0;
    int const n = 1000;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            double const z = (i + 0.5) / n, s = std::sqrt(1 - z * z),
                         phi = 2 * M_PI * (j + 0.5) / n;
            double const bent = s * std::cos(phi) * std::sin(t) + z * std::cos(t);
            soft += std::max(bent, 0.0) * fade(z, bent, std::cos(t)) * 2 / (double(n) * n);
        }
    double const hard = (1 + std::cos(t)) / 2;
    EXPECT_LT(soft, 0.99 * hard);
    for (char const* strategy : {"mis", "nee", "bsdf"}) {
        std::string const path = std::string("type=\"path\" strategy=\"") + strategy + "\"";
        auto expect = [&](std::string const& bsdf, std::string const& more, double truth) {
            auto const scene =
                make_scene(kLookDown + kWhiteSky + leaning_floor(35, bsdf), path + more);
            expect_mean(scene, 0.8 * truth, 12, bsdf + more + strategy);
        };
        expect(kHard, "", hard);
        expect(kSoft, "", soft);
        expect(kHard, " normals=\"fold\"", 1);
        expect(kSoft, " normals=\"fold\"", 1);
    }
}

TEST(BentNormals, UnderTheSun) {
    double const lean = 30;
    for (double const angle : {-85.0, -40.0, 0.0, 50.0, 85.0, 95.0, 115.0}) {
        auto cosine = [](double degrees) { return std::max(std::cos(degrees * M_PI / 180), 0.0); };
        double const bent = cosine(angle - lean), above = cosine(angle);
        auto expect = [&](std::string const& bsdf, std::string const& more, double truth) {
            auto const scene = make_scene(kLookDown + sun(angle) + leaning_floor(lean, bsdf),
                                          "type=\"path\" strategy=\"nee\"" + more);
            double const mean = block_estimates(scene, 4, 4, 1)[1].mean;
            EXPECT_NEAR(mean, 0.8 / M_PI * truth, 1e-5) << bsdf << more << angle;
        };
        expect(kHard, "", above > 0 ? bent : 0);
        expect(kSoft, "", bent * fade(above, bent, cosine(lean)));
        // What the bent lobe sends below comes back, and nothing comes from behind.
        double const folded = above > 0 ? bent + cosine(180 - angle - lean) : 0;
        expect(kHard, " normals=\"fold\"", folded);
    }
}

/// A closed cone of 4 flat sides about the z axis, with the normals of a round one.
scene::Mesh smooth_cone() {
    scene::Mesh mesh;
    int const sides = 4;
    auto ring = [&](double turn) { return 2 * M_PI * turn / sides; };
    for (int i = 0; i < sides; ++i) {
        uint32_t const first = uint32_t(mesh.positions.size());
        double const at[]{ring(i), ring(i + 1), ring(i + 0.5)};
        for (int k = 0; k < 3; ++k) {
            float const c = float(std::cos(at[k])), s = float(std::sin(at[k]));
            mesh.positions.push_back(k < 2 ? Vec3(c, s, 0) : Vec3(0, 0, 1.5f));
            mesh.normals.push_back(normalize(Vec3(1.5f * c, 1.5f * s, 1)));
        }
        mesh.triangles.push_back({{first, first + 1, first + 2}});
    }
    uint32_t const base = uint32_t(mesh.positions.size());
    for (int i = 0; i < sides; ++i) {
        mesh.positions.push_back({float(std::cos(ring(i))), float(std::sin(ring(i))), 0});
        mesh.normals.push_back({0, 0, -1});
        if (i > 1) mesh.triangles.push_back({{base, base + uint32_t(i), base + uint32_t(i) - 1}});
    }
    return mesh;
}

/// Under a white sky a point whose normals differ by the angle d keeps the part (1 + cos d) / 2.
TEST(BentNormals, OfASmoothCone) {
    TemporaryFolder const folder;
    write_ply(folder / "cone.ply", smooth_cone());
    std::string const camera =
        R"(<camera type="perspective" width="8" height="8" fov="5"><transform><lookat origin="6,1,0.8" target="0.4,0,0.5" up="0,0,1"/></transform></camera>)";
    auto const scene =
        make_scene(camera + kWhiteSky + R"(<instance><shape type="mesh" filename="cone.ply"/>)" +
                       kHard + "</instance>",
                   "type=\"path\" depth=\"2\"", folder.path());
    Rng rng(3);
    std::vector<double> truth;
    for (int i = 0; i < 100000; ++i) {
        world::Ray const ray = scene.world->camera().ray(rng.next2() * 8.f, Vec2(0.5f), 0);
        world::Hit const hit = scene.world->intersect(ray);
        ASSERT_TRUE(hit);
        shading::SurfacePoint const p = scene.world->surface(ray, hit);
        ASSERT_GT(dot(p.ns, p.wo), 0);
        truth.push_back(0.4 * (1 + double(dot(p.ns, p.ng))));
    }
    Estimate const expected = estimate(truth), found = block_estimates(scene, 2000, 8, 5)[1];
    EXPECT_GT(difference_p_value(found, expected), 0.01)
        << found.mean << " instead of " << expected.mean;
    EXPECT_LT(expected.mean, 0.8 * 0.97);
}

/// Where the normals say that the sun shines on a coarse ball, its own triangles do not shade it.
TEST(BentNormals, SmoothBallsHaveNoBlackTriangles) {
    TemporaryFolder const folder;
    write_ply(folder / "ball.ply", icosphere(1, true));
    std::string const camera =
        R"(<camera type="perspective" width="4" height="4" fov="16"><transform><translate z="-8"/></transform></camera>)";
    Vec3 const sun_at = normalize(Vec3(1, 0.3f, -0.2f));
    for (char const* place :
         {"", R"(<transform><scale x="2" y="0.7"/><translate x="0.3"/></transform>)"}) {
        auto lit = [&](std::string const& bsdf) {
            auto const scene = make_scene(
                camera + R"(<instance><shape type="mesh" filename="ball.ply"/>)" + bsdf + place +
                    "</instance>" + R"(<instance><shape type="mesh" filename="ball.ply"/>)" +
                    R"(<transform><translate z="1e4"/></transform></instance>)",
                "type=\"path\"", folder.path());
            Rng rng(4);
            int met = 0, seen = 0;
            for (int i = 0; i < 100000; ++i) {
                world::Ray const ray = scene.world->camera().ray(rng.next2() * 4.f, Vec2(0.5f), 0);
                world::Hit const hit = scene.world->intersect(ray);
                if (!hit || hit.t > 100) continue;
                PathState path(PathSettings{}, ray, scene.world->outside());
                Place found;
                found.hit = hit;
                SurfaceVertex const vertex(*scene.world, path, found);
                Vec3 const n = vertex.point.ns;
                if (dot(n, vertex.point.wo) < 0.02f || dot(n, sun_at) < 0.02f) continue;
                ++met;
                seen += vertex.bsdf().eval(vertex.point.wo, sun_at).f.g > 0 &&
                        !scene.world->intersect({vertex.origin(sun_at), sun_at});
            }
            EXPECT_GT(met, 10000);
            return double(seen) / met;
        };
        EXPECT_GT(lit(kSoft), 0.999) << place;
        EXPECT_LT(lit(kHard), 0.97) << place; // as triangles are
    }
}

} // namespace
} // namespace weft::integrator
