// Rays and surfaces: closed meshes have no holes, surfaces are not met twice, and every way of
// storing a shape gives the same points.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "base/hash.h"
#include "base/warp.h"
#include "shading/surface_point.h"
#include "tests/support/scenes.h"

namespace weft::world {
namespace {

using namespace weft::testing;

std::string const kCamera = R"(<camera type="perspective" width="4" height="4"/>)";

TEST(Watertight, NothingEscapesFromAClosedMesh) {
    TemporaryFolder const folder;
    scene::Mesh const mesh = icosphere(4, false);
    write_ply(folder / "ball.ply", mesh);
    Rng rng(1);
    for (char const* transform : {"", "<transform><matrix value=\"1,0.7,0,3, 0,-1,0.4,-5, "
                                      "0.3,0,2,1, 0,0,0,1\"/></transform>"}) {
        auto const scene =
            make_scene(kCamera + "<instance><shape type=\"mesh\" filename=\"ball.ply\"/>" +
                           transform + "</instance>",
                       "type=\"path\"", folder.path());
        Affine const to_world = scene.world->space_of(0).to_world;
        Vec3 const centre = to_world.origin;
        uint64_t escaped = 0;
        for (int i = 0; i < 1000000; ++i)
            escaped += !scene.world->intersect({centre, square_to_sphere(rng.next2())});
        EXPECT_EQ(escaped, 0u) << "of random rays";
        // Aimed at points on edges, and at vertices, from points that differ.
        uint64_t at_edges = 0, at_vertices = 0, vertex_rays = 0;
        for (auto const& t : mesh.triangles)
            for (int k = 0; k < 3; ++k) {
                Vec3 const a = to_world.point(mesh.positions[t.v[k]]),
                           b = to_world.point(mesh.positions[t.v[(k + 1) % 3]]);
                Vec3 const inside = to_world.point(square_to_sphere(rng.next2()) * 0.5f);
                for (Vec3 const& from : {centre, inside}) {
                    for (float s : {0.5f, rng.next(), rng.next()})
                        at_edges +=
                            !scene.world->intersect({from, normalize(a + (b - a) * s - from)});
                    at_vertices += !scene.world->intersect({from, normalize(a - from)});
                    ++vertex_rays;
                }
            }
        EXPECT_EQ(at_edges, 0u);
        // The kernel decides edge by edge. Within some 1e-7 of a vertex rounding may turn all the
        // edges there the same way, and the ray slips between them: about one in 500 of rays that
        // are aimed at a vertex, which no random ray is (above).
        EXPECT_LT(double(at_vertices), 0.01 * double(vertex_rays));
    }
}

/// One object to be left by rays.
struct Convex {
    std::string name, shape;
    int copies = 1; ///< 2 makes the mesh an instance
};

std::vector<Convex> const kConvex{
    {"triangles", "<shape type=\"mesh\" filename=\"ball.ply\"/>"},
    {"instanced triangles", "<shape type=\"mesh\" filename=\"ball.ply\"/>", 2},
    {"sphere", "<shape type=\"sphere\"/>"},
    {"rectangle", "<shape type=\"rectangle\"/>"},
    {"disk", "<shape type=\"disk\"/>"},
};

std::string matrix(double scale, Vec3d const& offset, bool shear) {
    Affined m;
    if (shear) m = Affined({1, 0.2, -0.5}, {0.8, 1.1, 0}, {0.1, -0.6, -0.7}, Vec3d(0));
    std::ostringstream text;
    text.precision(17);
    text << "<transform><matrix value=\"";
    for (int row = 0; row < 3; ++row)
        text << m.x[row] * scale << ',' << m.y[row] * scale << ',' << m.z[row] * scale << ','
             << offset[row] << ", ";
    text << "0,0,0,1\"/></transform>";
    return text.str();
}

struct Placement {
    double scale;
    Vec3d offset;
    bool shear;
};

std::vector<Placement> placements() {
    std::vector<Placement> all;
    for (bool shear : {false, true}) {
        for (double scale : {1e-3, 1.0, 1e3}) all.push_back({scale, Vec3d(0), shear});
        all.push_back({1, Vec3d(1e5, -3e4, 7e4), shear});
        all.push_back({1e-3, Vec3d(10, -3, 7), shear});
        all.push_back({1e3, Vec3d(1e5, 1e5, -1e5), shear});
    }
    return all;
}

TEST(SelfIntersection, NeverAfterLeavingAConvexObject) {
    TemporaryFolder const folder;
    write_ply(folder / "ball.ply", icosphere(3, false));
    Rng rng(2);
    for (Convex const& convex : kConvex)
        for (Placement const& place : placements()) {
            std::string contents = kCamera + "<instance>" + convex.shape +
                                   matrix(place.scale, place.offset, place.shear) + "</instance>";
            // The other instance is far away from the first one's rays' lengths.
            if (convex.copies == 2)
                contents += "<instance>" + convex.shape +
                            matrix(place.scale, place.offset + Vec3d(0, 1e7, 0), false) +
                            "</instance>";
            auto const scene = make_scene(contents, "type=\"path\"", folder.path());
            World const& world = *scene.world;
            Affine const to_world = world.space_of(0).to_world;
            bool const is_mesh = std::holds_alternative<TriangleMesh>(world.model(0).geometry);
            ASSERT_EQ(world.model(0).instanced, convex.copies == 2 || (!is_mesh && place.shear));
            int again = 0, rays = 0, lost = 0;
            double const reach = 100 * place.scale;
            while (rays < 300000) {
                // A point: by a ray from outside towards the object, as renders find them.
                Vec3 const target =
                    to_world.point(square_to_sphere(rng.next2()) * 0.9f * rng.next());
                Vec3 const from = target + square_to_sphere(rng.next2()) *
                                               float(place.scale * (3 + 20 * double(rng.next())));
                Ray const ray{from, normalize(target - from)};
                Hit const hit = world.intersect(ray);
                if (!hit || hit.object != 0) {
                    if (++lost > 600000) break;
                    continue;
                }
                shading::SurfacePoint const point = world.surface(ray, hit);
                Frame const frame(dot(point.ng, ray.direction) < 0 ? point.ng : -point.ng);
                for (int k = 0; k < 8; ++k) {
                    // Half of them grazing: cosines from 1e-7 on.
                    Vec3 local = square_to_cosine_hemisphere(rng.next2());
                    if (k % 2) {
                        float const cosine = std::pow(10.f, -7 * rng.next()),
                                    phi = 2 * kPi * rng.next(),
                                    sine = std::sqrt(1 - cosine * cosine);
                        local = {sine * std::cos(phi), sine * std::sin(phi), cosine};
                    }
                    Vec3 const direction = normalize(frame.to_world(local));
                    if (dot(direction, point.ng) * dot(frame.n, point.ng) <= 0)
                        continue; // by rounding
                    Ray const next{shading::offset_origin(point, direction), direction,
                                   float(reach)};
                    again += bool(world.intersect(next)) || world.visibility(next).g < 1;
                    ++rays;
                }
            }
            EXPECT_GE(rays, 300000) << convex.name;
            EXPECT_EQ(again, 0) << "of " << rays << ": " << convex.name << ", scale " << place.scale
                                << ", offset " << place.offset.x
                                << (place.shear ? ", sheared and mirrored" : "");
        }
}

TEST(SelfIntersection, NothingGetsThroughAThinPlate) {
    // Points under the rectangle do not see through it, wherever on it the rays go: those that
    // start on it, towards below, must not meet what lies a thousandth of its size above.
    TemporaryFolder const folder;
    Rng rng(3);
    for (Placement const& place : placements()) {
        if (place.scale == 1e-3 && length(place.offset) > 0)
            continue; // a plate of 1 um at 10 m has no two float sides
        if (place.scale == 1 && length(place.offset) > 0) continue; // nor has one of 1 mm at 100 km
        std::string const plate = "<instance><shape type=\"rectangle\"/>";
        Affined const m = place.shear
                              ? Affined({1, 0.2, -0.5}, {0.8, 1.1, 0}, {0.1, -0.6, -0.7}, Vec3d(0))
                              : Affined();
        Vec3d const lift = m.z * (place.scale * 1e-3);
        auto const scene = make_scene(
            kCamera + plate + matrix(place.scale, place.offset, place.shear) + "</instance>" +
            plate + matrix(place.scale, place.offset + lift, place.shear) + "</instance>");
        World const& world = *scene.world;
        Affine const to_world = world.space_of(0).to_world;
        int leaks = 0, rays = 0;
        for (int i = 0; i < 100000; ++i) {
            Vec3 const target =
                to_world.point({1.8f * rng.next() - 0.9f, 1.8f * rng.next() - 0.9f, 0});
            Vec3 const from = target - Vec3(m.z) * float(place.scale) +
                              Vec3(m.x) * float(place.scale * (double(rng.next()) - 0.5));
            Ray const ray{from, normalize(target - from)};
            Hit const hit = world.intersect(ray);
            ASSERT_TRUE(hit);
            leaks += hit.object != 0;
            if (hit.object != 0) continue;
            shading::SurfacePoint const point = world.surface(ray, hit);
            Frame const frame(-point.ng);
            Vec3 const direction = frame.to_world(square_to_cosine_hemisphere(rng.next2()));
            if (!(dot(direction, point.ng) < 0)) continue;
            leaks += bool(world.intersect({shading::offset_origin(point, direction), direction}));
            ++rays;
        }
        EXPECT_EQ(leaks, 0) << "of " << rays << ", scale " << place.scale << ", offset "
                            << place.offset.x << (place.shear ? ", sheared" : "");
    }
}

TEST(Instances, EqualTheBakedMeshUnderAnyAffineMap) {
    TemporaryFolder const folder;
    write_ply(folder / "ball.ply", icosphere(2, true));
    // With a flat normal map, so that tangents are computed.
    std::string const shape = "<shape type=\"mesh\" filename=\"ball.ply\"/>"
                              "<texture name=\"normal\" type=\"constant\" value=\"0.5,0.5,1\"/>";
    Rng rng(4);
    for (int k = 0; k < 12; ++k) {
        Affined m;
        do
            m = Affined(Vec3d(rng.next3() * 4.f - Vec3(2)), Vec3d(rng.next3() * 4.f - Vec3(2)),
                        Vec3d(rng.next3() * 4.f - Vec3(2)), Vec3d(rng.next3() * 6.f));
        while (std::abs(m.determinant()) < 0.3);
        std::ostringstream text;
        text.precision(17);
        text << "<instance>" << shape << "<transform><matrix value=\"";
        for (int row = 0; row < 3; ++row)
            text << m.x[row] << ',' << m.y[row] << ',' << m.z[row] << ',' << m.origin[row] << ", ";
        text << "0,0,0,1\"/></transform></instance>";
        auto const baked = make_scene(kCamera + text.str(), "type=\"path\"", folder.path());
        auto const shared =
            make_scene(kCamera + text.str() + "<instance>" + shape +
                           "<transform><translate x=\"1e6\"/></transform></instance>",
                       "type=\"path\"", folder.path());
        ASSERT_FALSE(baked.world->model(0).instanced);
        ASSERT_TRUE(shared.world->model(0).instanced);
        int compared = 0, edges = 0;
        Affine const to_world(m);
        auto norm = [](Affined const& a) {
            return float(
                std::sqrt(length_squared(a.x) + length_squared(a.y) + length_squared(a.z)));
        };
        float const condition = norm(m) * norm(m.inverse());
        for (int i = 0; i < 2000; ++i) {
            Vec3 const target = to_world.point(square_to_sphere(rng.next2()) * 0.5f),
                       from = target + square_to_sphere(rng.next2()) * 10.f;
            Ray const ray{from, normalize(target - from)};
            Hit const a = baked.world->intersect(ray), b = shared.world->intersect(ray);
            ASSERT_TRUE(a);
            ASSERT_TRUE(b);
            if (a.primitive != b.primitive) {
                ++edges;
                continue;
            }
            shading::SurfacePoint const p = baked.world->surface(ray, a),
                                        q = shared.world->surface(ray, b);
            // Half an ulp of the ray's origin in either space, and the like of the kernel's own
            // steps, move the hit along the surface: the more the flatter the ray.
            float const slack = 1 / std::abs(dot(p.ng, ray.direction));
            float const near =
                4 * std::numeric_limits<float>::epsilon() * length(from) * condition * slack;
            ASSERT_LT(length(p.p - q.p), near);
            ASSERT_GT(dot(p.ng, q.ng), 1 - 1e-5f);
            ASSERT_GT(dot(p.ns, q.ns), 1 - 1e-5f);
            ASSERT_LT(std::abs(p.uv.x - q.uv.x) + std::abs(p.uv.y - q.uv.y),
                      near * norm(m.inverse()));
            ASSERT_GT(length(p.dpdu), 0);
            ASSERT_LT(length(p.dpdu - q.dpdu), 1e-3f * length(p.dpdu));
            ASSERT_LT(dot(p.ng, ray.direction), 0)
                << "from outside of a convex object, the front is seen";
            // Errors are bounds: p lies that near to the ray.
            Vec3 const off =
                (p.p - ray.origin) - ray.direction * dot(p.p - ray.origin, ray.direction);
            ASSERT_LT(length(off), length(p.p_error) + 1e-6f * a.t * slack);
            ++compared;
        }
        EXPECT_GT(compared, 1950) << edges;
    }
}

TEST(Instances, FlatShapesHaveTheNormalOfTheMap) {
    // A^-T z, whatever is mirrored; spheres point outwards.
    std::string const mirror =
        "<transform><scale x=\"-1\" y=\"2\"/><translate z=\"4\"/></transform>";
    auto const scene = make_scene(kCamera + "<instance><shape type=\"rectangle\"/>" + mirror +
                                  "</instance><instance><shape type=\"sphere\"/><transform><scale "
                                  "x=\"-1\"/><translate x=\"5\"/></transform></instance>"
                                  "<instance><shape type=\"rectangle\"/><transform><scale "
                                  "z=\"-1\"/><translate x=\"10\"/></transform></instance>");
    auto front = [&](Vec3 const& from, Vec3 const& direction) {
        Ray const ray{from, direction};
        return scene.world->surface(ray, scene.world->intersect(ray));
    };
    shading::SurfacePoint const flat = front({0.5f, 1, 9}, {0, 0, -1});
    EXPECT_FLOAT_EQ(flat.ng.z, 1);
    EXPECT_NEAR(flat.uv.x, 0.25f, 1e-6f);
    EXPECT_NEAR(flat.uv.y, 0.75f, 1e-6f);
    EXPECT_FLOAT_EQ(front({5, 0, -3}, {0, 0, 1}).ng.z, -1);
    EXPECT_FLOAT_EQ(front({10, 0, -3}, {0, 0, 1}).ng.z, -1);
}

TEST(NormalMaps, GoAlongUAndVWhateverIsMirrored) {
    // A map that tilts by 45 degrees along +v, on a square whose uvs and transforms mirror in turn,
    // single (in world space) and instanced.
    TemporaryFolder const folder;
    for (bool mirror_uv : {false, true})
        for (bool mirror_transform : {false, true})
            for (bool instanced : {false, true}) {
                scene::Mesh mesh;
                constexpr uint32_t n = 8; // enough triangles to be instanced
                for (uint32_t y = 0; y <= n; ++y)
                    for (uint32_t x = 0; x <= n; ++x) {
                        float const s = float(x) / n, t = float(y) / n;
                        mesh.positions.push_back({2 * s - 1, 2 * t - 1, 0});
                        mesh.uvs.push_back({s, mirror_uv ? 1 - t : t});
                    }
                for (uint32_t y = 0; y < n; ++y)
                    for (uint32_t x = 0; x < n; ++x) {
                        uint32_t const a = y * (n + 1) + x, b = a + 1, c = b + n + 1, d = c - 1;
                        mesh.triangles.push_back({{a, b, c}});
                        mesh.triangles.push_back({{a, c, d}});
                    }
                write_ply(folder / "square.ply", mesh);
                auto const instance = [&](char const* move) {
                    return std::string(R"(<instance><shape type="mesh" filename="square.ply"/>
                        <texture name="normal" type="constant" value="0.5,1,1"/><transform>)") +
                           (mirror_transform ? "<scale y=\"-1\"/>" : "") + move +
                           "</transform></instance>";
                };
                auto const scene = make_scene(
                    kCamera + instance("") + (instanced ? instance("<translate x=\"9\"/>") : ""),
                    "type=\"path\"", folder.path());
                ASSERT_EQ(scene.world->model(0).instanced, instanced);
                Ray const ray{{0.3f, 0.2f, 5}, {0, 0, -1}};
                shading::SurfacePoint const p =
                    scene.world->surface(ray, scene.world->intersect(ray));
                float const up = mirror_uv != mirror_transform ? -1 : 1, r = std::sqrt(0.5f);
                EXPECT_LT(length(p.ns - Vec3(0, up * r, r)), 1e-6f)
                    << mirror_uv << mirror_transform << instanced;
            }
    // On a sphere u grows around the pole from +x to +z, and v from +y to -y.
    auto const scene = make_scene(kCamera + R"(<instance><shape type="sphere"/>
        <texture name="normal" type="constant" value="0.5,1,1"/></instance>)");
    Ray const ray{{5, 0, 0}, {-1, 0, 0}};
    shading::SurfacePoint const p = scene.world->surface(ray, scene.world->intersect(ray));
    EXPECT_LT(length(p.ns - normalize(Vec3(1, -1, 0))), 1e-5f);
}

TEST(RayRecorder, KnowsItsListsWhereverItLives) {
    // One after the other at the same address.
    std::optional<RayRecorder> recorder;
    for (int rays : {3, 2}) {
        recorder.emplace();
        for (int i = 0; i < rays; ++i) recorder->record({});
        ASSERT_EQ(recorder->lists().size(), 1u);
        EXPECT_EQ(recorder->lists()[0]->size(), size_t(rays));
    }
}

/// Two instances of one mesh, 10 apart, told by `alphas`.
TestScene two_balls(TemporaryFolder const& folder, std::array<std::string, 2> const& alphas,
                    RayRecorder* recorder = nullptr) {
    write_ply(folder / "ball.ply", icosphere(2, false));
    std::string contents = kCamera;
    for (int i = 0; i < 2; ++i)
        contents += "<instance" + alphas[size_t(i)] +
                    "><shape type=\"mesh\" filename=\"ball.ply\"/><transform><translate x=\"" +
                    std::to_string(10 * i) + "\"/></transform></instance>";
    auto scene = make_scene(contents, "type=\"path\"", folder.path());
    if (recorder) scene.commit({.recorder = recorder});
    return scene;
}

TEST(Opacity, IsAskedForWhereAnyInstanceOfAMeshHasSome) {
    TemporaryFolder const folder;
    std::string const half = " alpha=\"0.5\"";
    for (auto const& alphas : {std::array<std::string, 2>{"", half}, {half, ""}, {half, half}}) {
        auto const scene = two_balls(folder, alphas);
        for (size_t i = 0; i < 2; ++i) {
            ASSERT_TRUE(scene.world->model(uint32_t(i)).instanced);
            Ray const ray{{float(10 * i) + 0.1f, 0.2f, -5}, {0, 0, 1}};
            EXPECT_EQ(scene.world->visibility(ray).g, alphas[i].empty() ? 0.f : 0.25f);
        }
    }
}

TEST(RayRecorder, ReplaysTheQueriesOfARenderToTheSameAnswers) {
    TemporaryFolder const folder;
    RayRecorder recorder;
    auto const scene = two_balls(folder, {" alpha=\"0.5\"", ""}, &recorder);
    World const& world = *scene.world;
    Rng rng(3);
    std::vector<uint32_t> answers;
    for (uint32_t i = 0; i < 300; ++i) {
        Ray const ray{{-5, 0, 0}, normalize(Vec3(1, 0.3f * rng.next(), 0.3f * rng.next()))};
        Hit const hit = i % 3 == 0   ? world.intersect(ray, i)
                        : i % 3 == 1 ? world.intersect_solid(ray)
                                     : Hit{};
        answers.push_back(i % 3 == 2 ? is_black(world.visibility(ray))
                                     : hit.object + hit.primitive);
    }
    auto const asked = *recorder.lists().at(0);
    ASSERT_EQ(asked.size(), answers.size());
    std::set<uint32_t> different(answers.begin(), answers.end());
    EXPECT_GT(different.size(), 10u);
    for (size_t i = 0; i < asked.size(); ++i) EXPECT_EQ(world.replay(asked[i]), answers[i]) << i;
}

TEST(Groups, OuterSettingsReplaceThoseOfMembers) {
    std::string const group = R"(
        <bsdf type="diffuse" id="red" albedo="1,0,0"/><bsdf type="diffuse" id="blue" albedo="0,0,1"/>
        <shape type="group" id="pair">
          <instance><shape type="sphere"/><ref id="red"/></instance>
          <instance priority="3" alpha="0.5"><shape type="sphere"/><transform><translate x="4"/></transform></instance>
        </shape>
        <instance><ref id="pair"/></instance>
        <instance priority="5" alpha="0.25"><ref id="pair"/><ref id="blue"/><transform><scale value="2"/><translate y="10"/></transform></instance>)";
    auto const scene = make_scene(kCamera + group);
    World const& world = *scene.world;
    ASSERT_EQ(world.statistics().objects, 4u);
    auto object_at = [&](Vec3 const& p) {
        return world.intersect({p - Vec3(0, 0, 5), {0, 0, 1}}, 12).object;
    };
    Model const &a = world.model(0), &b = world.model(1), &c = world.model(2), &d = world.model(3);
    EXPECT_EQ(object_at({0, 0, 0}), 0u);
    EXPECT_EQ(world.transform(3).origin, Vec3d(8, 10, 0));
    EXPECT_TRUE(a.traits.bsdf);
    EXPECT_FALSE(b.traits.bsdf);
    EXPECT_EQ(c.traits.bsdf.index, d.traits.bsdf.index);
    EXPECT_NE(a.traits.bsdf.index, c.traits.bsdf.index);
    EXPECT_EQ(a.opacity.instance.value, 1);
    EXPECT_EQ(b.opacity.instance.value, 0.5f);
    EXPECT_EQ(c.opacity.instance.value, 0.25f);
    EXPECT_EQ(d.opacity.instance.value, 0.25f);
    EXPECT_EQ(b.traits.priority, 3);
    EXPECT_EQ(d.traits.priority, 5);
}

TEST(Opacity, IsTheFrequencyOfBeingMet) {
    // Closest hits by chance and shadow rays by product tell the same, sheared spheres included.
    std::string const alpha = "alpha=\"0.3\"";
    auto const scene = make_scene(
        kCamera + "<instance " + alpha + R"(><shape type="sphere"/></instance>
        <instance )" +
        alpha +
        R"(><shape type="sphere"/><transform><scale y="2"/><translate x="5"/></transform></instance>
        <instance )" +
        alpha +
        R"(><shape type="rectangle"/><transform><translate x="10"/></transform></instance>)");
    constexpr int rays = 20000;
    double const level = sidak(0.01, 3);
    for (auto const& [x, surfaces] : {std::pair(0.f, 2), std::pair(5.f, 2), std::pair(10.f, 1)}) {
        Ray const ray{{x + 0.1f, 0.2f, -5}, {0, 0, 1}};
        double const through = std::pow(0.7, surfaces);
        EXPECT_NEAR(scene.world->visibility(ray).g, through, 1e-6);
        int passed = 0;
        for (uint32_t seed = 0; seed < rays; ++seed)
            passed += !scene.world->intersect(ray, hash32(seed));
        double const z = (passed - rays * through) / std::sqrt(rays * through * (1 - through));
        EXPECT_GT(normal_tail(z), level)
            << surfaces << " surfaces: " << double(passed) / rays << " instead of " << through;
    }
}

/// Rays from random places through known points of the plane of a disk: what is met is the ellipse,
/// with its own uv, on the side that the transformed normal names, also where the kernel's filter
/// looks at it.
TEST(Disk, IsAnEllipseUnderAnyAffineMap) {
    for (char const* alpha : {"", " alpha=\"0.9999999\""})
        for (Placement const& place : placements()) {
            auto const scene =
                make_scene(kCamera + "<instance" + alpha + ">" +
                           R"(<shape type="disk"/><bsdf type="diffuse"/>)" +
                           matrix(place.scale, place.offset, place.shear) + "</instance>");
            World const& world = *scene.world;
            Affined const m(world.space_of(0).to_world);
            Vec3d const front = normalize(m.inverse().transposed({0, 0, 1}));
            double const rounding = 1e-6 * (1 + length(place.offset) / place.scale);
            Rng rng(6);
            for (int i = 0; i < 2000; ++i) {
                Vec2 const at = (rng.next2() * 2 - Vec2(1)) * 1.5f;
                double const r = std::hypot(double(at.x), double(at.y));
                if (std::abs(r - 1) < 10 * rounding) continue;
                Vec3d const target = m.point({double(at.x), double(at.y), 0});
                Vec3 const from(target + Vec3d(square_to_sphere(rng.next2())) * place.scale * 5.0);
                Vec3d const way = target - Vec3d(from);
                if (std::abs(dot(normalize(way), front)) < 0.05) continue;
                Ray const ray{from, Vec3(normalize(way))};
                Hit const hit = world.intersect(ray);
                ASSERT_EQ(bool(hit), r < 1) << at;
                EXPECT_EQ(world.visibility(ray).r < 0.5f, r < 1);
                if (!hit) continue;
                shading::SurfacePoint const point = world.surface(ray, hit);
                EXPECT_NEAR(point.uv.x, 0.5f * (at.x + 1), 40 * rounding);
                EXPECT_NEAR(point.uv.y, 0.5f * (at.y + 1), 40 * rounding);
                EXPECT_GT(dot(Vec3d(point.ng), front), 1 - 1e-5);
                EXPECT_LT(length(Vec3d(point.p) - target), 100 * rounding * place.scale);
                auto const again = world.point_near(0, 0, point.p, ray.direction * -1.f);
                EXPECT_LT((again.uv - point.uv).length(), 40 * rounding);
            }
        }
}

} // namespace
} // namespace weft::world
