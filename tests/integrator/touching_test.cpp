// Solids that share surfaces, meshes of several shells, and meshes that are not closed: which solid
// a ray is in.
#include <functional>
#include <gtest/gtest.h>

#include "base/hash.h"
#include "integrator/media_walk.h"
#include "integrator/place.h"
#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

std::string const kWhiteSky = R"(<light type="envmap"/>)";

/// A block with sides along the axes.
struct Block {
    Vec3 low, high;
    bool other_diagonals = false; ///< its squares are cut the other way
    bool inwards = false;         ///< its normals point inwards
};

/// Adds a block to a mesh, without the sides named in `lacking` (0 to 5: -x, +x, -y, +y, -z, +z).
void add_block(scene::Mesh& mesh, Block const& b, std::vector<int> const& lacking = {}) {
    uint32_t const first = uint32_t(mesh.positions.size());
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(
            {i & 1 ? b.high.x : b.low.x, i & 2 ? b.high.y : b.low.y, i & 4 ? b.high.z : b.low.z});
    uint32_t const sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int side = 0; side < 6; ++side) {
        if (std::find(lacking.begin(), lacking.end(), side) != lacking.end()) continue;
        auto corner = [&](uint32_t k) {
            uint32_t const turned = (k + uint32_t(b.other_diagonals)) % 4;
            return first + sides[side][b.inwards ? 3 - turned : turned];
        };
        mesh.triangles.push_back({{corner(0), corner(1), corner(2)}});
        mesh.triangles.push_back({{corner(0), corner(2), corner(3)}});
    }
}

scene::Mesh block_mesh(Block const& b, std::vector<int> const& lacking = {}) {
    scene::Mesh mesh;
    add_block(mesh, b, lacking);
    return mesh;
}

/// How much of a ray from `o` along `d` lies in the block.
double length_in(Block const& b, Vec3d const& o, Vec3d const& d) {
    double from = 0, to = 1e30;
    for (int i = 0; i < 3; ++i) {
        double const x = (double(b.low[i]) - o[i]) / d[i], y = (double(b.high[i]) - o[i]) / d[i];
        from = std::max(from, std::min(x, y));
        to = std::min(to, std::max(x, y));
    }
    return std::max(0.0, to - from);
}

/// Where a whole scene stands: rounding is another in each.
struct Standing {
    std::string transform;
    double size = 1; ///< by which lengths grow, about
};
std::vector<Standing> const kPlaces{
    {""},
    {R"(<scale value="0.001"/>)", 0.001},
    {R"(<scale value="1000"/><rotate axis="0.3,0.8,-0.2" angle="37"/>)", 1000},
    {R"(<rotate axis="1,0.2,0.3" angle="71"/><translate x="30" y="-17" z="44"/>)"},
    {R"(<scale x="0.3" y="1.7" z="-0.9"/><rotate axis="0,1,1" angle="23"/><translate x="2"/>)"},
};

/// What medium `i` absorbs of colour `i` on a length of 1, before a place makes it larger.
constexpr double kAbsorption[]{0.6, 0.8, 0.7};

std::string medium_of(int i, double size) {
    std::string sigma;
    for (int k = 0; k < 3; ++k)
        sigma += (k ? "," : "") + std::to_string(k == i ? kAbsorption[i] / size : 0);
    return "<medium type=\"homogeneous\" absorption=\"" + sigma + "\"/>";
}

std::string mesh_of(std::string const& file) {
    return "<shape type=\"mesh\" filename=\"" + file + "\"/>";
}

std::string group(std::string const& members, std::string const& transform) {
    return "<instance><shape type=\"group\">" + members + "</shape><transform>" + transform +
           "</transform></instance>";
}

/// Walks along random lines from outside of a scene whose objects lie within [-1, 1]^3 before
/// `place` is applied. `depth(o, d)`: the optical depth by channel of a line of unit direction
/// there.
template <class Depth>
void expect_depths(std::string const& members, Standing const& place, std::string const& folder,
                   Depth const& depth, std::string const& what) {
    auto const scene = make_scene(
        R"(<camera type="perspective" width="4" height="4"><transform><translate z="99999"/></transform></camera>)" +
            group(members, place.transform),
        "type=\"path\"", folder);
    Affined const to_world = scene.world->transform(0);
    Rng rng(7);
    // Of positions, by which a ray may also be moved: those are the world's.
    double const rounding = 2 * double(world::kRounding) *
                            (length(to_world.point(Vec3d(0))) + length(to_world.vector(Vec3d(1))));
    int wrong = 0, rays = 0;
    for (int i = 0; i < 4000; ++i) {
        Vec3d const o = Vec3d(rng.next3() - Vec3(0.5f)) * 8.0,
                    target = Vec3d(rng.next3() - Vec3(0.5f)) * 1.9;
        if (std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)}) < 1.5) continue;
        world::Ray ray;
        ray.origin = Vec3(to_world.point(o));
        ray.direction = normalize(Vec3(to_world.vector(target - o)));
        // The ray as it is, rounded.
        Affined const back = to_world.inverse();
        Vec3d const start = back.point(Vec3d(ray.origin)), way = back.vector(Vec3d(ray.direction));
        media::MediumStack stack = scene.world->outside();
        Color const found = media_transmittance(*scene.world, ray, stack, 0);
        double const scale = 1 / length(way);
        auto const expected = [&](Vec3d const& shift) {
            return depth(start + shift, way * scale) * (scale / place.size);
        };
        // What rounding of positions does to the true answer, which is much at edges.
        double allowed = 2e-4;
        for (int corner = 0; corner < 8; ++corner) {
            Vec3d const shift =
                Vec3d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1) *
                (rounding * scale);
            allowed = std::max(allowed, 2e-4 + length(expected(shift) - expected(Vec3d(0))));
        }
        for (int k = 0; k < 3; ++k)
            wrong += std::abs(double(found[k]) - std::exp(-expected(Vec3d(0))[k])) > allowed;
        wrong += stack.current().object != UINT32_MAX;
        ++rays;
    }
    EXPECT_EQ(wrong, 0) << what << ", of " << rays << " rays";
}

TEST(Touching, BlocksOfMediaInARow) {
    // Three blocks of media, with one square or two different ones cut in triangles between them.
    for (bool other : {false, true})
        for (Standing const& place : kPlaces) {
            TemporaryFolder const folder;
            Block const blocks[]{{{-1, -1, -1}, {1, 1, -0.3f}},
                                 {{-1, -1, -0.3f}, {1, 1, 0.4f}, other},
                                 {{-1, -1, 0.4f}, {1, 1, 1}}};
            std::string members;
            for (int i = 0; i < 3; ++i) {
                std::string const name = std::to_string(i) + ".ply";
                write_ply(folder / name, block_mesh(blocks[i]));
                members += "<instance>" + mesh_of(name) + medium_of(i, place.size) + "</instance>";
            }
            expect_depths(
                members, place, folder.path(),
                [&](Vec3d const& o, Vec3d const& d) {
                    return Vec3d(0.6 * length_in(blocks[0], o, d), 0.8 * length_in(blocks[1], o, d),
                                 0.7 * length_in(blocks[2], o, d));
                },
                "place '" + place.transform + (other ? "', other triangles" : "', same triangles"));
        }
}

TEST(Touching, SolidsInsideOfEachOther) {
    // A ball that touches all sides of a block, and a block that shares the floor and a wall of it.
    for (Standing const& place : kPlaces) {
        TemporaryFolder const folder;
        Block const outer{{-1, -1, -1}, {1, 1, 1}}, inner{{-1, -1, -1}, {0.2f, 0.5f, 0.1f}, true};
        write_ply(folder / "outer.ply", block_mesh(outer));
        write_ply(folder / "inner.ply", block_mesh(inner));
        std::string const around =
            "<instance>" + mesh_of("outer.ply") + medium_of(0, place.size) + "</instance>";
        expect_depths(
            around + "<instance>" + mesh_of("inner.ply") + medium_of(1, place.size) + "</instance>",
            place, folder.path(),
            [&](Vec3d const& o, Vec3d const& d) {
                double const in = length_in(inner, o, d);
                return Vec3d(0.6 * (length_in(outer, o, d) - in), 0.8 * in, 0);
            },
            "block, place '" + place.transform + "'");
        expect_depths(
            around + "<instance><shape type=\"sphere\"/>" + medium_of(1, place.size) +
                "</instance>",
            place, folder.path(),
            [&](Vec3d const& o, Vec3d const& d) {
                double const middle = -dot(o, d), square = 1 - dot(o, o) + middle * middle;
                double const in = square > 0 ? 2 * std::sqrt(square) : 0;
                return Vec3d(0.6 * (length_in(outer, o, d) - in), 0.8 * in, 0);
            },
            "ball, place '" + place.transform + "'");
    }
}

TEST(Touching, ManySurfacesAtOnePlace) {
    // Twelve blocks around the same floor and side, six on each side of it.
    TemporaryFolder const folder;
    std::vector<Block> blocks;
    for (int i = 0; i < 12; ++i) {
        float const size = 0.1f + 0.15f * float(i % 6);
        blocks.push_back(i < 6 ? Block{{-1, -size, 0}, {-1 + size, size, size}, i % 2 == 0}
                               : Block{{-1, -size, -size}, {-1 + size, size, 0}, i % 3 == 0});
        write_ply(folder / (std::to_string(i) + ".ply"), block_mesh(blocks.back()));
    }
    // All of a side have the same medium, so together they are as the largest.
    for (Standing const& place : kPlaces) {
        std::string members;
        for (int i = 0; i < 12; ++i)
            members += "<instance>" + mesh_of(std::to_string(i) + ".ply") +
                       medium_of(i / 6, place.size) + "</instance>";
        expect_depths(
            members, place, folder.path(),
            [&](Vec3d const& o, Vec3d const& d) {
                return Vec3d(0.6 * length_in(blocks[5], o, d), 0.8 * length_in(blocks[11], o, d),
                             0);
            },
            "place '" + place.transform + "'");
    }
}

TEST(Shells, OneMeshOfSeveral) {
    Block const a{{-1, -1, -1}, {0.3f, 1, 1}}, b{{-0.4f, -0.8f, -0.7f}, {1, 0.9f, 0.8f}, true},
        touching{{0.3f, -1, -1}, {1, 1, 1}},
        hollow{{-0.5f, -0.5f, -0.5f}, {0.2f, 0.6f, 0.6f}, true, true},
        inside{{-0.5f, -0.5f, -0.5f}, {0.2f, 0.6f, 0.6f}},
        both{{-0.4f, -0.8f, -0.7f}, {0.3f, 0.9f, 0.8f}};
    struct Case {
        char const* name;
        std::vector<Block> shells;
        std::function<double(Vec3d const&, Vec3d const&)> length;
    };
    std::vector<Case> const cases{
        {"that overlap",
         {a, b},
         [&](Vec3d const& o, Vec3d const& d) {
             return length_in(a, o, d) + length_in(b, o, d) - length_in(both, o, d);
         }},
        {"that touch",
         {a, touching},
         [&](Vec3d const& o, Vec3d const& d) {
             return length_in(a, o, d) + length_in(touching, o, d);
         }},
        {"outer and inner wall",
         {a, hollow},
         [&](Vec3d const& o, Vec3d const& d) {
             return length_in(a, o, d) - length_in(hollow, o, d);
         }},
        {"one in the other",
         {a, inside},
         [&](Vec3d const& o, Vec3d const& d) { return length_in(a, o, d); }},
        {"the same twice",
         {a, a},
         [&](Vec3d const& o, Vec3d const& d) { return length_in(a, o, d); }},
    };
    for (Case const& c : cases)
        for (Standing const& place : kPlaces) {
            TemporaryFolder const folder;
            scene::Mesh mesh;
            for (Block const& shell : c.shells) add_block(mesh, shell);
            write_ply(folder / "shells.ply", mesh);
            expect_depths(
                "<instance>" + mesh_of("shells.ply") + medium_of(0, place.size) + "</instance>",
                place, folder.path(),
                [&](Vec3d const& o, Vec3d const& d) { return Vec3d(0.6 * c.length(o, d), 0, 0); },
                std::string(c.name) + ", place '" + place.transform + "'");
        }
}

/// z-tests against what is known, in red, green and blue.
void expect_mean(TestScene const& scene, Color const& truth, int samples, std::string const& what) {
    auto const estimates = block_estimates(scene, samples, 4, 5);
    for (size_t i = 0; i < estimates.size(); ++i) {
        Estimate const& e = estimates[i];
        EXPECT_GT(difference_p_value(e, {double(truth[int(i % 3)]), 0}), 1e-4)
            << what << ", channel " << i % 3 << ": " << e.mean << " +- " << std::sqrt(e.variance)
            << " instead of " << truth[int(i % 3)];
    }
}

std::string const kFromAbove =
    R"(<camera type="orthographic" width="4" height="4" scale="0.5"><transform><lookat origin="0,0,5" target="0,0,0" up="0,-1,0"/></transform></camera>)";

TEST(Touching, CameraRaysThroughBlocksOfGlass) {
    // Two blocks of the same index are one: a slab of two absorbing halves, seen at right angles.
    for (bool other : {false, true}) {
        TemporaryFolder const folder;
        write_ply(folder / "upper.ply", block_mesh({{-9, -9, 0}, {9, 9, 1}}));
        write_ply(folder / "lower.ply", block_mesh({{-9, -9, -1}, {9, 9, 0}, other}));
        auto const block = [&](char const* name, char const* absorption) {
            return "<instance>" + mesh_of(name) + R"(<bsdf type="dielectric" ior="1.5"/>)" +
                   "<medium type=\"homogeneous\" absorption=\"" + absorption + "\"/></instance>";
        };
        auto const scene = make_scene(
            kFromAbove + kWhiteSky + block("upper.ply", "1,0,0") + block("lower.ply", "0,2,0"),
            "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"", folder.path());
        auto const slab = [](double a) { // light of 1 from both sides, with interreflections
            double const r = 0.04, t = (1 - r) * (1 - r) * a;
            return float(r + (t + t * a * r) / (1 - r * r * a * a));
        };
        expect_mean(scene, {slab(std::exp(-1)), slab(std::exp(-2)), 1}, 4000,
                    other ? "other triangles" : "same triangles");
    }
}

TEST(Touching, LiquidOnTheBottomOfAGlassOnATable) {
    // One boundary of the relative index between them, and the table, which is black, right below.
    TemporaryFolder const folder;
    write_ply(folder / "liquid.ply", block_mesh({{-9, -9, 0.1f}, {9, 9, 1.3f}}));
    write_ply(folder / "glass.ply", block_mesh({{-9, -9, -0.7f}, {9, 9, 0.1f}, true}));
    std::string const solids = "<instance>" + mesh_of("liquid.ply") +
                               R"(<bsdf type="dielectric" ior="1.33"/></instance>
        <instance>)" + mesh_of("glass.ply") +
                               R"(<bsdf type="dielectric" ior="1.5"/></instance>)";
    std::string const table =
        R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0"/><transform><scale value="20"/><translate z="-0.7"/></transform></instance>)";
    auto const r = [](double a, double b) { return (a - b) * (a - b) / ((a + b) * (a + b)); };
    double const top = r(1, 1.33), between = r(1.33, 1.5);
    float const expected = float(top + (1 - top) * (1 - top) * between / (1 - top * between));
    for (std::string const& order : {table + solids, solids + table})
        expect_mean(make_scene(kFromAbove + kWhiteSky + order,
                               "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"", folder.path()),
                    Color(expected), 20000, "liquid, glass, table");
}

TEST(Touching, TheCameraInside) {
    // Right below a plane that two blocks share: what it is in follows from all that lies around.
    TemporaryFolder const folder;
    write_ply(folder / "upper.ply", block_mesh({{-1, -1, 0}, {1, 1, 1}}));
    write_ply(folder / "lower.ply", block_mesh({{-1, -1, -1}, {1, 1, 0}, true}));
    auto const scene =
        make_scene(R"(<camera type="perspective" width="4" height="4"/>)"
                   "<instance>" +
                       mesh_of("upper.ply") + medium_of(0, 1) + "</instance><instance>" +
                       mesh_of("lower.ply") + medium_of(1, 1) + "</instance>",
                   "type=\"path\"", folder.path());
    Rng rng(9);
    for (int i = 0; i < 300; ++i) {
        Vec3 const p = (rng.next3() - Vec3(0.5f)) * 2.2f;
        bool const outside = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 1;
        EXPECT_EQ(media_at(*scene.world, p).current().object, outside   ? UINT32_MAX
                                                              : p.z > 0 ? 0u
                                                                        : 1u);
    }
}

/// No channel of any pixel is brighter than the sky, which is 1.
void expect_no_gain(std::string const& objects, std::string const& folder,
                    std::string const& what) {
    for (char const* camera : {R"(<lookat origin="0,0,5" target="0,0,0" up="0,-1,0"/>)",
                               R"(<lookat origin="3,2,-4" target="0,0,0" up="0,1,0"/>)"}) {
        auto const scene =
            make_scene(R"(<camera type="orthographic" width="8" height="8" scale="2"><transform>)" +
                           std::string(camera) + "</transform></camera>" + kWhiteSky + objects,
                       "type=\"path\" depth=\"12\" rouletteDepth=\"1000\"", folder);
        for (Estimate const& e : block_estimates(scene, 300, 4, 6))
            EXPECT_LE(e.mean, 1 + 1e-4 + 5 * std::sqrt(e.variance)) << what << ", " << camera;
    }
}

TEST(OpenSolids, MakeNoLight) {
    TemporaryFolder const folder;
    Block const block{{-1, -1, -1}, {1, 1, 1}};
    std::vector<std::pair<std::string, std::vector<int>>> const cases{
        {"closed", {}},          {"no top", {5}},  {"no bottom", {4}},
        {"no wall", {0}},        {"tube", {4, 5}}, {"two walls", {0, 1, 2, 5}},
        {"one", {0, 1, 2, 3, 4}}};
    for (bool inwards : {false, true})
        for (auto const& [name, lacking] : cases)
            for (char const* more : {"", R"( alpha="0.5")"})
                for (char const* bsdf :
                     {R"(<bsdf type="dielectric" ior="1.5"/>)",
                      R"(<bsdf type="roughdielectric" ior="1.5" roughness="0.3"/>)"}) {
                    Block b = block;
                    b.inwards = inwards;
                    write_ply(folder / "block.ply", block_mesh(b, lacking));
                    expect_no_gain("<instance" + std::string(more) + ">" + mesh_of("block.ply") +
                                       bsdf + "</instance>",
                                   folder.path(),
                                   name + more + bsdf + (inwards ? ", inwards" : ""));
                }
}

TEST(OpenSolids, MakeNoLightWithOthersInThem) {
    // A medium without a surface hides the glass that it overlaps, and ends in it.
    TemporaryFolder const folder;
    write_ply(folder / "glass.ply", block_mesh({{-1, -1, -1}, {1, 1, 1}}));
    write_ply(folder / "cup.ply", block_mesh({{-1, -1, -1}, {1, 1, 1}}, {5}));
    write_ply(folder / "fog.ply", block_mesh({{-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1.5f}}));
    write_ply(folder / "drink.ply", block_mesh({{-1, -1, -1}, {1, 1, 0.3f}, true}));
    std::string const fog = "<instance>" + mesh_of("fog.ply") +
                            R"(<medium type="homogeneous" absorption="0"/></instance>)";
    for (char const* outer : {"glass.ply", "cup.ply"}) {
        std::string const glass =
            "<instance>" + mesh_of(outer) + R"(<bsdf type="dielectric" ior="1.5"/></instance>)";
        expect_no_gain(glass + fog, folder.path(), outer + std::string(" with fog"));
        expect_no_gain(glass + "<instance>" + mesh_of("drink.ply") +
                           R"(<bsdf type="dielectric" ior="1.33"/></instance>)",
                       folder.path(), outer + std::string(" with a drink"));
    }
}

TEST(OpenSolids, AMixOfGlassAndHolesKeepsAllLight) {
    auto const scene =
        make_scene(kFromAbove + kWhiteSky +
                       R"(<instance><shape type="sphere"/><bsdf type="mix" amount="0.5">
            <bsdf type="dielectric"/><bsdf type="transparent"/></bsdf></instance>)",
                   "type=\"path\" depth=\"-1\" rouletteDepth=\"1000\"");
    expect_mean(scene, Color(1), 20000, "mix");
}

} // namespace
} // namespace weft::integrator
