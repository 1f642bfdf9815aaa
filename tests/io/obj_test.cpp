// OBJ in every form of its faces, polygons of every shape, and what is refused.
#include "base/hash.h"
#include "io/obj.h"
#include "tests/support/bad_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

using namespace weft;
namespace fs = std::filesystem;

namespace {

scene::Mesh read(std::string const& text) {
    scene::Mesh m = io::read_obj(text, "m.obj");
    scene::validate(m, {"m.obj"});
    return m;
}

using Triangle = scene::Mesh::Triangle;

std::string const kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, FacesInAllFourForms) {
    std::string const lists = kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\nvn 0 3 0\n";
    scene::Mesh m = read(lists + "f 1 2 3\n");
    EXPECT_TRUE(m.uvs.empty() && m.normals.empty() && m.colors.empty());
    EXPECT_EQ(m.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
    m = read(lists + "f 1/3 2/2 3/1\n");
    EXPECT_EQ(m.uvs, (std::vector<Vec2>{{1, 1}, {1, 0}, {0, 0}}));
    EXPECT_TRUE(m.normals.empty());
    m = read(lists + "f 1//1 2//2 3//1\n");
    EXPECT_EQ(m.normals, (std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_TRUE(m.uvs.empty());
    m = read(lists + "f 1/2/1 2/2/1 3/2/2\n");
    EXPECT_EQ(m.uvs, (std::vector<Vec2>{{1, 0}, {1, 0}, {1, 0}}));
    EXPECT_EQ(m.normals[2], Vec3(0, 1, 0));
}

TEST(Obj, NegativeIndicesCountFromTheLatest) {
    scene::Mesh const m = read("v 9 9 9\nv 0 0 0\nv 1 0 0\nvn 1 0 0\nv 0 1 0\nvn 0 0 1\n"
                               "f -3//-1 -2//-1 -1//-2\nv 5 5 5\nf -1//2 -2//2 -3//2\n");
    ASSERT_EQ(m.triangles.size(), 2u);
    EXPECT_EQ(m.positions[0], Vec3(0, 0, 0));
    EXPECT_EQ(m.normals[0], Vec3(0, 0, 1));
    EXPECT_EQ(m.normals[2], Vec3(1, 0, 0));
    EXPECT_EQ(m.positions[m.triangles[1].v[0]], Vec3(5, 5, 5));
}

TEST(Obj, EqualCornersShareAVertexAndOthersDoNot) {
    scene::Mesh const m = read(kSquare + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 3/2 4/1\n");
    EXPECT_EQ(m.positions.size(), 5u); // the third position has two uvs
    EXPECT_EQ(m.triangles[0].v[0], m.triangles[1].v[0]);
    EXPECT_NE(m.triangles[0].v[2], m.triangles[1].v[1]);
}

TEST(Obj, AnIndexMayPointAhead) { EXPECT_EQ(read("f 1 2 3\n" + kSquare).triangles.size(), 1u); }

TEST(Obj, LinesContinueAfterABackslash) {
    scene::Mesh const m = read("v 0 0 \\\n 0\nv 1 \\\r\n0 0\nv 0 1 0\\\n\nf 1 2\\\n 3");
    EXPECT_EQ(m.triangles, (std::vector<Triangle>{{{0, 1, 2}}}));
    EXPECT_EQ(m.positions[1], Vec3(1, 0, 0));
}

TEST(Obj, LineEndsCommentsAndAByteOrderMark) {
    for (std::string const end : {"\n", "\r\n", "\r"}) {
        std::string const text = "\xef\xbb\xbf# a comment \\" + end + "v 0 0 0 # origin" + end +
                                 "  v 1 0 0" + end + end + "\tv\t0 1 0 " + end + "f 1 2 3 # last";
        EXPECT_EQ(read(text).triangles.size(), 1u);
    }
}

TEST(Obj, WhatDoesNotChangeTheShapeIsIgnored) {
    scene::Mesh const m =
        read("mtllib C:\\scenes\\\no thing\ng a b\ns off\nusemtl red\n" + kSquare +
             "l 1 2 \\\n 3\np 1\nlod 3\nf 1 2 3\ns 1\nusemtl blue\ng\nf 1 3 4\n");
    EXPECT_EQ(m.triangles.size(), 2u);
    EXPECT_EQ(m.positions.size(), 4u);
}

TEST(Obj, ColoursFollowThePosition) {
    scene::Mesh m = read("v 0 0 0 1 0 0.5\nv 1 0 0\nv 0 1 0 0 1 0 1\nf 1 2 3\n");
    EXPECT_EQ(m.colors, (std::vector<Color>{{1, 0, 0.5f}, {1, 1, 1}, {0, 1, 0}}));
    m = read("v 0 0 0\nv 1 0 0\nv 0 1 0 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(m.colors, (std::vector<Color>{{1, 1, 1}, {1, 1, 1}, {0, 1, 0}}));
    m = read("v 0 0 0 1\nv 1 0 0 2\nv 0 1 0 1\nf 1 2 3\n"); // weights
    EXPECT_TRUE(m.colors.empty());
    EXPECT_EQ(m.positions[1], Vec3(1, 0, 0));
}

TEST(Obj, CornersWithoutNormalsAreFlatWhereOthersHaveThem) {
    // Two faces that share an edge at a right angle, and a third with normals of its own.
    scene::Mesh const m = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 1 0 0\n"
                               "f 1 2 3\nf 1 4 2\nf 2//1 3//1 4//1\n");
    ASSERT_EQ(m.normals.size(), 9u);
    for (uint32_t v : m.triangles[0].v) EXPECT_EQ(m.normals[v], Vec3(0, 0, 1));
    for (uint32_t v : m.triangles[1].v) EXPECT_EQ(m.normals[v], Vec3(0, 1, 0));
    for (uint32_t v : m.triangles[2].v) EXPECT_EQ(m.normals[v], Vec3(1, 0, 0));
}

// Polygons ---------------------------------------------------------------------------------

Vec3d vector_area(std::vector<Vec3> const& p) {
    Vec3d sum(0);
    for (size_t i = 0; i < p.size(); ++i)
        sum += cross(Vec3d(p[i]), Vec3d(p[(i + 1) % p.size()])) * 0.5;
    return sum;
}

/// The triangles of the polygon cover its area once: their areas, all turned its way, add up to
/// its own, and each inner edge is walked once in each direction.
void expect_covered(std::vector<Vec3> const& polygon, std::string const& what) {
    std::vector<uint32_t> corners(polygon.size());
    for (size_t i = 0; i < corners.size(); ++i) corners[i] = uint32_t(i);
    std::vector<Triangle> triangles;
    ASSERT_TRUE(scene::triangulate(polygon, corners, triangles));
    ASSERT_EQ(triangles.size(), polygon.size() - 2) << what;
    Vec3d const whole = vector_area(polygon);
    double const area = length(whole);
    double covered = 0;
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (Triangle const& t : triangles) {
        Vec3d const part = vector_area({polygon[t.v[0]], polygon[t.v[1]], polygon[t.v[2]]});
        EXPECT_GE(dot(part, whole), -1e-6 * area * area) << what;
        covered += length(part);
        for (int k = 0; k < 3; ++k) ++edges[{t.v[k], t.v[(k + 1) % 3]}];
    }
    EXPECT_NEAR(covered, area, 1e-5 * area) << what;
    for (auto const& [edge, count] : edges) {
        EXPECT_EQ(count, 1) << what;
        bool const outline = edge.second == (edge.first + 1) % polygon.size();
        EXPECT_NE(edges.count({edge.second, edge.first}) > 0, outline) << what;
    }
}

/// A star-shaped polygon of random radii around the origin, in the plane of two random vectors.
std::vector<Vec3> random_star(size_t corners, Rng& rng) {
    Vec3 const a = normalize(rng.next3() - Vec3(0.5f));
    Vec3 const b = normalize(cross(a, rng.next3() - Vec3(0.5f)));
    std::vector<Vec3> p;
    for (size_t i = 0; i < corners; ++i) {
        float const phi = 2 * kPi * float(i) / float(corners), r = 0.05f + rng.next();
        p.push_back(a * (r * std::cos(phi)) + b * (r * std::sin(phi)) + Vec3(3, -2, 1));
    }
    return p;
}

TEST(Polygons, QuadsAreCutAlongTheShorterDiagonal) {
    std::vector<Vec3> const kite{{0, 0, 0}, {2, -1, 0}, {4, 0, 0}, {2, 1, 0}};
    std::vector<uint32_t> const corners{0, 1, 2, 3};
    std::vector<Triangle> triangles;
    ASSERT_TRUE(scene::triangulate(kite, corners, triangles));
    EXPECT_EQ(triangles, (std::vector<Triangle>{{{0, 1, 3}}, {{1, 2, 3}}}));
}

TEST(Polygons, ConcaveQuadsAreCutAtTheirReflexCorner) {
    std::vector<Vec3> const dart{{0, 0, 0}, {4, 4, 1}, {0, 1, 0}, {-4, 4, 1}};
    for (size_t turn = 0; turn < 4; ++turn) {
        std::vector<Vec3> p;
        for (size_t i = 0; i < 4; ++i) p.push_back(dart[(i + turn) % 4]);
        expect_covered({p[0] - Vec3(0, 0, p[0].z), p[1] - Vec3(0, 0, p[1].z),
                        p[2] - Vec3(0, 0, p[2].z), p[3] - Vec3(0, 0, p[3].z)},
                       "dart " + std::to_string(turn));
    }
}

TEST(Polygons, ShapesThatTripFans) {
    expect_covered(
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
        "U");
    expect_covered(
        {{0, 0, 0}, {0, 3, 0}, {1, 3, 0}, {1, 1, 0}, {2, 1, 0}, {2, 3, 0}, {3, 3, 0}, {3, 0, 0}},
        "U the other way round");
    expect_covered(
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}},
        "square with corners on its sides");
    // A square with a square hole, joined to the outline by a bridge walked twice.
    std::vector<Vec3> const keyhole{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                    {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    expect_covered(keyhole, "keyhole");
}

TEST(Polygons, AStarOfRandomRadiiIsCoveredOnce) {
    Rng rng(5);
    for (size_t corners : {5, 6, 7, 10, 30, 100, 1000})
        for (int round = 0; round < 20; ++round)
            expect_covered(random_star(corners, rng), std::to_string(corners) + " corners");
}

TEST(Polygons, CombsOfManyTeeth) {
    std::vector<Vec3> comb;
    for (int i = 0; i < 500; ++i) {
        comb.push_back({float(i), 1, 0});
        comb.push_back({float(i) + 0.5f, 100, 0});
    }
    comb.push_back({500, 0, 0});
    comb.push_back({0, 0, 0});
    expect_covered(comb, "comb");
    std::reverse(comb.begin(), comb.end());
    expect_covered(comb, "comb the other way round");
}

TEST(Polygons, PolygonsWithoutAreaStillGiveTriangles) {
    std::vector<Vec3> const points(6, Vec3(1, 2, 3));
    std::vector<uint32_t> const corners{0, 1, 2, 3, 4, 5};
    std::vector<Triangle> triangles;
    ASSERT_TRUE(scene::triangulate(points, corners, triangles));
    EXPECT_EQ(triangles.size(), 4u);
}

TEST(Polygons, ConcaveOnesBeyondTheLimitAreRefused) {
    Rng rng(1);
    std::vector<Vec3> const p = random_star(scene::kMaxConcaveCorners + 1, rng);
    std::string text, face = "f";
    for (size_t i = 0; i < p.size(); ++i) {
        text += "v " + std::to_string(p[i].x) + " " + std::to_string(p[i].y) + " " +
                std::to_string(p[i].z) + "\n";
        face += " " + std::to_string(i + 1);
    }
    try {
        io::read_obj(text + face + "\n", "m.obj");
        FAIL();
    } catch (InputError const& e) {
        EXPECT_STREQ(e.what(), "m.obj:10002:1: face 1: expected at most 10000 corners in a concave "
                               "polygon, found 10001");
    }
}

TEST(Polygons, AnObjFaceKeepsItsArea) {
    scene::Mesh const m = read("v 0 0 0\nv 3 0 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\n"
                               "v 0 3 0\nf 1 2 3 4 5 6 7 8\n");
    double area = 0;
    for (Triangle const& t : m.triangles)
        area +=
            length(vector_area({m.positions[t.v[0]], m.positions[t.v[1]], m.positions[t.v[2]]}));
    EXPECT_DOUBLE_EQ(area, 7);
}

// Refusals ---------------------------------------------------------------------------------

/// Every tests/io/bad/NAME.obj is refused with the message in NAME.obj.expected.
TEST(Obj, BadFilesAreRefusedWithTheirMessages) {
    int const count = weft::testing::expect_refusals(
        ".obj",
        [](std::string const& bytes, std::string const& name) { io::read_obj(bytes, name); });
    EXPECT_GE(count, 25);
}

TEST(Obj, EveryTruncationReadsOrIsRefused) {
    std::string const whole =
        kSquare + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf 1 \\\n2 3\n";
    size_t const first_face = whole.find("3/1/1") + 5;
    for (size_t n = 0; n < whole.size(); ++n) {
        bool refused = false;
        try {
            read(whole.substr(0, n));
        } catch (InputError const&) {
            refused = true;
        }
        // Without the end of a face's third corner there is no face.
        if (n < first_face - 4) {
            EXPECT_TRUE(refused) << n;
        }
    }
}

TEST(Mesh, ValidateTellsWhichAndWhat) {
    auto message = [](scene::Mesh const& m) -> std::string {
        try {
            scene::validate(m, {"s.xml", 3, 4});
        } catch (InputError const& e) {
            return e.what();
        }
        return "";
    };
    scene::Mesh const good = read(kSquare + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n");
    EXPECT_EQ(message(good), "");
    scene::Mesh m = good;
    m.positions[2].y = kInfinity;
    EXPECT_EQ(message(m), "s.xml:3:4: expected finite numbers, found (1.000000, inf, 0.000000) as "
                          "the position of vertex 2");
    m = good;
    m.normals[1] = Vec3(0, 0, 2);
    EXPECT_EQ(message(m), "s.xml:3:4: expected a vector of length 1, found (0.000000, 0.000000, "
                          "2.000000) as the normal of vertex 1");
    m = good;
    m.triangles[1].v[1] = 4;
    EXPECT_EQ(message(m), "s.xml:3:4: triangle 1 uses vertex 4, but the mesh has 4 vertices, "
                          "counted from 0");
    m = good;
    m.uvs.resize(3);
    EXPECT_EQ(message(m), "s.xml:3:4: expected 0 or 4 uvs, one per vertex, found 3");
    m = good;
    m.triangles.push_back({{1, 1, 1}}); // without area, and legal
    EXPECT_EQ(message(m), "");
}

/// What other programs wrote, where it is at hand: the number of triangles, or a part of the
/// message. Each file there is in this table.
TEST(Obj, FilesOfOtherPrograms) {
    fs::path const folder = fs::path(WEFT_SOURCE_DIR "/../shared/data/meshes/assimp_obj");
    if (!fs::exists(folder)) GTEST_SKIP() << "no meshes at hand";
    struct Case {
        size_t triangles;
        char const* message = "";
    };
    std::map<std::string, Case> const cases{
        {"WusonOBJ.obj", {3732}},
        {"box.obj", {12}},
        {"box_UTF16BE.obj", {0, ":1:1: expected ASCII or UTF-8 text, found UTF-16"}},
        {"box_longline.obj", {944}},
        {"box_mat_with_spaces.obj", {12}},
        {"box_without_lineending.obj", {12}},
        {"concave_polygon.obj", {64}},
        {"cube_mtllib_after_g.obj", {12}},
        {"cube_usemtl.obj", {12}},
        {"cube_with_vertexcolors.obj", {12}},
        {"cube_with_vertexcolors_uni.obj", {12}},
        {"empty_mat.obj", {256}},
        {"mtl_different_folder.obj", {12}},
        {"multiple_spaces.obj", {1}},
        {"number_formats.obj", {0, ":11:14: expected a number as z, found '3.1+e2'"}},
        {"only_a_part_of_vertexcolors.obj", {3}},
        {"point_cloud.obj", {0, "expected faces, found none; it has 3 vertices"}},
        {"regr_3429812.obj", {4}},
        {"space_in_material_name.obj", {64}},
        {"spider.obj", {1368}},
        {"testline.obj", {0, "expected faces, found none; it has 8 vertices, 6 lines"}},
        {"testmixed.obj", {12}},
        {"testpoints.obj", {0, "0 lines and 6 points"}}};
    size_t seen = 0;
    for (fs::directory_entry const& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".obj") continue;
        std::string const name = entry.path().filename().string();
        ASSERT_TRUE(cases.count(name)) << name;
        Case const& c = cases.at(name);
        ++seen;
        try {
            scene::Mesh const m = io::read_obj(entry.path().string());
            scene::validate(m, {name});
            EXPECT_EQ(m.triangles.size(), c.triangles) << name;
        } catch (InputError const& e) {
            EXPECT_EQ(c.triangles, 0u) << e.what();
            EXPECT_NE(std::string(e.what()).find(c.message), std::string::npos) << e.what();
        }
    }
    EXPECT_EQ(seen, cases.size());
}

} // namespace
