// PLY in every variety it is written in, and what is refused.
#include "base/hash.h"
#include "io/ply.h"
#include "tests/support/bad_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

using namespace weft;
namespace fs = std::filesystem;

namespace {

fs::path const kBad = fs::path(WEFT_SOURCE_DIR) / "tests/io/bad";

std::string error_of(std::string const& bytes) {
    try {
        io::read_ply(bytes, "m.ply");
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

enum class Format { ascii, little, big };

/// Writes a PLY value by value, in any format.
class Writer {
  public:
    explicit Writer(Format format) : format_(format) {}
    template <class T>
    Writer& put(T value) {
        if (format_ == Format::ascii) {
            std::ostringstream text;
            text.precision(9);
            if constexpr (sizeof(T) == 1)
                text << int(value);
            else
                text << value;
            bytes += (at_line_start_ ? "" : " ") + text.str();
            at_line_start_ = false;
        } else {
            char raw[sizeof(T)];
            std::memcpy(raw, &value, sizeof(T));
            if (format_ == Format::big) std::reverse(raw, raw + sizeof(T));
            bytes.append(raw, sizeof(T));
        }
        return *this;
    }
    void end_record() {
        if (format_ == Format::ascii) bytes += "\n";
        at_line_start_ = true;
    }
    std::string header(std::string const& elements, std::string const& end = "\n") const {
        char const* const name = format_ == Format::ascii    ? "ascii"
                                 : format_ == Format::little ? "binary_little_endian"
                                                             : "binary_big_endian";
        std::string s = std::string("ply\nformat ") + name + " 1.0\ncomment a test\n" + elements +
                        "end_header\n";
        if (end == "\n") return s;
        std::string replaced;
        for (char c : s) replaced += c == '\n' ? end : std::string(1, c);
        return replaced;
    }
    std::string bytes;

  private:
    Format format_;
    bool at_line_start_ = true;
};

class EveryFormat : public ::testing::TestWithParam<Format> {};
INSTANTIATE_TEST_SUITE_P(Ply, EveryFormat,
                         ::testing::Values(Format::ascii, Format::little, Format::big));

constexpr std::array<Vec3, 4> kPoints{Vec3(0, 0, 0), Vec3(1.25f, 0, 0), Vec3(0, 2.1f, 0),
                                      Vec3(0.1f, 0.2f, 3.3f)};
constexpr std::array<std::array<uint32_t, 3>, 4> kFaces{
    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

template <class Index, class Count>
std::string tetrahedron(Format format, std::string const& count, std::string const& index,
                        std::string const& line_end = "\n") {
    Writer w(format);
    for (Vec3 const& p : kPoints) {
        w.put(p.x).put(p.y).put(p.z);
        w.end_record();
    }
    for (auto const& f : kFaces) {
        w.put(Count(3)).put(Index(f[0])).put(Index(f[1])).put(Index(f[2]));
        w.end_record();
    }
    return w.header("element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face 4\nproperty list " +
                        count + " " + index + " vertex_indices\n",
                    line_end) +
           w.bytes;
}

void expect_tetrahedron(std::string const& bytes) {
    scene::Mesh const m = io::read_ply(bytes, "m.ply");
    ASSERT_EQ(m.positions.size(), 4u);
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(m.positions[i], kPoints[i]);
    ASSERT_EQ(m.triangles.size(), 4u);
    for (size_t i = 0; i < 4; ++i)
        for (size_t k = 0; k < 3; ++k) EXPECT_EQ(m.triangles[i].v[k], kFaces[i][k]);
    EXPECT_TRUE(m.normals.empty());
    EXPECT_TRUE(m.uvs.empty());
    EXPECT_TRUE(m.colors.empty());
    scene::validate(m, {"m.ply"});
}

TEST_P(EveryFormat, EveryTypeOfIndexAndLength) {
    Format const f = GetParam();
    expect_tetrahedron(tetrahedron<int32_t, uint8_t>(f, "uchar", "int"));
    expect_tetrahedron(tetrahedron<uint32_t, uint8_t>(f, "uint8", "uint32"));
    expect_tetrahedron(tetrahedron<int32_t, int8_t>(f, "char", "int32"));
    expect_tetrahedron(tetrahedron<int16_t, uint16_t>(f, "ushort", "int16"));
    expect_tetrahedron(tetrahedron<uint16_t, int16_t>(f, "short", "ushort"));
    expect_tetrahedron(tetrahedron<uint8_t, int32_t>(f, "int", "uint8"));
    expect_tetrahedron(tetrahedron<int8_t, uint32_t>(f, "uint", "char"));
}

TEST_P(EveryFormat, EveryLineEndOfTheHeader) {
    for (char const* end : {"\n", "\r\n", "\r"})
        expect_tetrahedron(tetrahedron<int32_t, uint8_t>(GetParam(), "uchar", "int", end));
}

TEST(Ply, AByteThatLooksLikeALineEndBelongsToTheBody) {
    // 3.0000026 starts with the byte 0x0a, and 0x0d is next to it.
    for (char first : {'\n', '\r', ' '}) {
        float x = 3;
        std::memcpy(&x, &first, 1);
        Writer w(Format::little);
        for (int i = 0; i < 3; ++i) w.put(x).put(float(i)).put(float(i * i));
        w.put(uint8_t(3)).put(0).put(1).put(2);
        for (char const* end : {"\n", "\r\n"}) {
            scene::Mesh const m = io::read_ply(
                w.header("element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                         "element face 1\nproperty list uchar int vertex_index\n",
                         end) +
                    w.bytes,
                "m.ply");
            EXPECT_EQ(m.positions[2], Vec3(x, 2, 4));
        }
    }
}

/// All that a mesh can hold, amid what it cannot, in an order that nobody writes.
std::string everything(Format format, bool list_in_vertex, bool faces_first) {
    Writer vertices(format), faces(format), other(format);
    for (int i = 0; i < 5; ++i) {
        vertices.put(uint8_t(255 * i / 4)).put(double(i) * 0.5);
        if (list_in_vertex) {
            vertices.put(uint16_t(i));
            for (int k = 0; k < i; ++k) vertices.put(int16_t(k));
        }
        vertices.put(float(i) * 2).put(int16_t(-i)).put(uint8_t(51)).put(float(i) / 8).put(0.0f);
        vertices.put(float(7)).put(0.0).put(int8_t(-100)).put(uint8_t(0)).put(0.25);
        vertices.end_record();
    }
    for (int i = 0; i < 2; ++i) {
        faces.put(int16_t(99)).put(uint8_t(2)).put(0.5f).put(0.5f);
        faces.put(uint8_t(3)).put(i).put(i + 1).put(i + 2).put(1.5);
        faces.end_record();
    }
    for (int i = 0; i < 3; ++i) {
        other.put(uint8_t(i));
        for (int k = 0; k < i; ++k) other.put(1.0f);
        other.end_record();
    }
    std::string const vertex_header =
        "element vertex 5\nproperty uchar red\nproperty double x\n" +
        std::string(list_in_vertex ? "property list ushort short neighbours\n" : "") +
        "property float z\nproperty short y\nproperty uchar green\nproperty float u\n"
        "property float nx\nproperty float unknown\nproperty double ny\nproperty char nz\n"
        "property uchar blue\nproperty double v\n";
    std::string const face_header = "element face 2\nproperty short material\n"
                                    "property list uchar float texcoord\n"
                                    "property list uchar int vertex_index\nproperty double q\n";
    std::string const other_header = "element other 3\nproperty list uchar float values\n";
    return faces_first ? vertices.header(face_header + other_header + vertex_header) + faces.bytes +
                             other.bytes + vertices.bytes
                       : vertices.header(other_header + vertex_header + face_header) + other.bytes +
                             vertices.bytes + faces.bytes;
}

TEST_P(EveryFormat, PropertiesAndElementsInAnyOrder) {
    for (bool list : {false, true})
        for (bool faces_first : {false, true}) {
            scene::Mesh const m = io::read_ply(everything(GetParam(), list, faces_first), "m.ply");
            scene::validate(m, {"m.ply"});
            ASSERT_EQ(m.positions.size(), 5u);
            for (int i = 0; i < 5; ++i) {
                auto const k = size_t(i);
                EXPECT_EQ(m.positions[k], Vec3(float(i) * 0.5f, float(-i), float(i) * 2));
                EXPECT_EQ(m.normals[k], Vec3(0, 0, -1));
                EXPECT_EQ(m.uvs[k], Vec2(float(i) / 8, 0.25f));
                EXPECT_FLOAT_EQ(m.colors[k].r, float(255 * i / 4) / 255);
                EXPECT_FLOAT_EQ(m.colors[k].g, 0.2f);
                EXPECT_EQ(m.colors[k].b, 0);
            }
            ASSERT_EQ(m.triangles.size(), 2u);
            EXPECT_EQ(m.triangles[1].v[0], 1u);
            EXPECT_EQ(m.triangles[1].v[2], 3u);
        }
}

TEST_P(EveryFormat, LargeMeshesComeBackAsTheyWere) {
    // Enough for several blocks and a part of one.
    constexpr size_t kCount = 1000;
    Rng rng(11);
    std::vector<Vec3> points(kCount);
    std::vector<scene::Mesh::Triangle> triangles(2 * kCount);
    for (Vec3& p : points) p = rng.next3();
    for (auto& t : triangles)
        for (uint32_t& v : t.v) v = rng.next_uint() % kCount;
    Writer w(GetParam());
    for (Vec3 const& p : points) {
        w.put(p.x).put(p.y).put(p.z);
        w.end_record();
    }
    for (auto const& t : triangles) {
        w.put(uint8_t(3)).put(t.v[0]).put(t.v[1]).put(t.v[2]);
        w.end_record();
    }
    scene::Mesh const m = io::read_ply(
        w.header("element vertex 1000\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 2000\nproperty list uchar uint vertex_indices\n") +
            w.bytes,
        "m.ply");
    EXPECT_TRUE(m.positions == points);
    EXPECT_TRUE(m.triangles == triangles);
}

TEST_P(EveryFormat, EveryTruncationIsRefused) {
    std::string const whole = everything(GetParam(), true, false);
    // In text the last line end, and the last digits of the last number, can go unnoticed.
    size_t const least = GetParam() == Format::ascii ? whole.size() - 3 : whole.size();
    for (size_t n = 0; n < least; ++n)
        EXPECT_NE(error_of(whole.substr(0, n)), "no error") << n << " of " << whole.size();
    EXPECT_EQ(error_of(whole), "no error");
}

TEST(Ply, NormalsOfLengthZeroTakeThatOfAFace) {
    scene::Mesh const m = io::read_ply(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "element face 1\nproperty list uchar int vertex_index\nend_header\n"
        "0 0 0 0 0 0\n1 0 0 0 3 0\n0 0 -1 1e-30 0 0\n9 9 9 0 0 0\n0 0 0 1e30 0 1e30\n3 0 1 2\n",
        "m.ply");
    EXPECT_EQ(m.normals[0], Vec3(0, 1, 0));
    EXPECT_EQ(m.normals[1], Vec3(0, 1, 0));
    EXPECT_EQ(m.normals[2], Vec3(1, 0, 0)); // short is not zero
    EXPECT_EQ(m.normals[3], Vec3(0, 0, 1)); // in no face
    EXPECT_NEAR(m.normals[4].x, std::sqrt(0.5f), 1e-6f);
}

TEST(Ply, NumbersInEverySpelling) {
    scene::Mesh const m =
        io::read_ply("ply\nformat ascii 1.0\nobj_info none\nelement vertex 3\nproperty float32 x\n"
                     "property float64 y\nproperty double z\nelement face 1\n"
                     "property list uint8 int32 vertex_indices\nend_header\n\n"
                     "+1 .5 -2.\n\t 1e2   1E-2 +1.5e+1 \r\n\n1e-60 -0 123456789\n3 +0 1 2",
                     "m.ply");
    EXPECT_EQ(m.positions[0], Vec3(1, 0.5f, -2));
    EXPECT_EQ(m.positions[1], Vec3(100, 0.01f, 15));
    EXPECT_EQ(m.positions[2], Vec3(0, 0, 123456789.f));
}

TEST(Ply, CoordinatesUnderEveryName) {
    for (auto [u, v] : {std::pair{"s", "t"}, std::pair{"u", "v"},
                        std::pair{"texture_u", "texture_v"}, std::pair{"texture_s", "texture_t"}}) {
        scene::Mesh const m =
            io::read_ply(std::string("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                     "property float y\nproperty float z\nproperty float ") +
                             v + "\nproperty float " + u +
                             "\nproperty float red\nproperty float green\nproperty float blue\n"
                             "element face 1\nproperty list uchar int vertex_index\nend_header\n"
                             "0 0 0 1 2 .5 .25 2\n1 0 0 3 4 0 0 0\n0 1 0 5 6 0 0 0\n3 0 1 2\n",
                         "m.ply");
        EXPECT_EQ(m.uvs[1], Vec2(4, 3)) << u;
        EXPECT_EQ(m.colors[0], Color(0.5f, 0.25f, 2)) << u;
    }
}

/// Every tests/io/bad/NAME.ply is refused with the message in NAME.ply.expected.
TEST(Ply, BadFilesAreRefusedWithTheirMessages) {
    int const count = weft::testing::expect_refusals(
        ".ply",
        [](std::string const& bytes, std::string const& name) { io::read_ply(bytes, name); });
    EXPECT_GE(count, 30);
}

TEST(Ply, HugeCountsAreRefusedBeforeAnyAllocation) {
    for (char const* format : {"ascii", "binary_little_endian"})
        for (char const* count : {"4000000000", "9000000000000000000"}) {
            std::string const head = std::string("ply\nformat ") + format + " 1.0\nelement vertex ";
            std::string const xyz = "\nproperty uchar x\nproperty uchar y\nproperty uchar z\n";
            std::string const list = "\nproperty list uchar uchar vertex_index\nend_header\n";
            EXPECT_NE(error_of(head + count + xyz + "element face 1" + list + "0 0 0"), "no error");
            EXPECT_NE(error_of(head + "1" + xyz + "element face " + count + list + "0 0 0"),
                      "no error");
        }
}

TEST(Ply, MissingFilesAndFoldersAreRefused) {
    auto message = [](std::string const& path) -> std::string {
        try {
            io::read_ply(path);
        } catch (InputError const& e) {
            return e.what();
        }
        return "no error";
    };
    EXPECT_EQ(message("no/such.ply"),
              "no/such.ply: cannot open the file: No such file or directory");
    EXPECT_EQ(message(kBad.string()), kBad.string() + ": expected a file, found a folder");
}

/// What other programs wrote, where it is at hand: the number of triangles, or a part of the
/// message.
TEST(Ply, FilesOfOtherPrograms) {
    fs::path const shared = fs::path(WEFT_SOURCE_DIR "/../shared");
    if (!fs::exists(shared / "data/meshes/assimp_ply")) GTEST_SKIP() << "no meshes at hand";
    struct Case {
        char const* file;
        size_t triangles;
        char const* message = "";
    };
    fs::path const ours = shared / "data/meshes/assimp_ply", bunny = shared / "lightwave/meshes";
    for (Case const& c :
         {Case{"cube.ply", 12}, Case{"cube_binary.ply", 12},
          Case{"cube_binary_header_with_RN_newline.ply", 12},
          Case{"cube_binary_starts_with_nl.ply", 12}, Case{"cube_uv.ply", 12},
          Case{"float-color.ply", 1}, Case{"issue623.ply", 0, "a point cloud"},
          Case{"points.ply", 0, "a point cloud"},
          Case{"payload_JVN42386607", 0, ":2:13: expected version '1.0'"}, Case{"bunny.ply", 28808},
          Case{"icosphere.ply", 80}, Case{"rubber_duck_toy_1k.ply", 4288}, Case{"uvquad.ply", 2}}) {
        fs::path const path = fs::exists(ours / c.file) ? ours / c.file : bunny / c.file;
        try {
            scene::Mesh const m = io::read_ply(path.string());
            scene::validate(m, {c.file});
            EXPECT_EQ(m.triangles.size(), c.triangles) << c.file;
        } catch (InputError const& e) {
            EXPECT_EQ(c.triangles, 0u) << e.what();
            EXPECT_NE(std::string(e.what()).find(c.message), std::string::npos) << e.what();
        }
    }
}

} // namespace
