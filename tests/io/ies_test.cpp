// IES files of every edition and symmetry, and what is refused.
#include "base/hash.h"
#include "io/ies.h"
#include "tests/support/bad_files.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace weft;

namespace {

std::string const kFolder = std::string(WEFT_SOURCE_DIR) + "/tests/io/ies/";

/// A file of the given angles whose candela are 1000 h + v by their indices.
std::string numbered(std::string const& vertical, int v, std::string const& horizontal, int h) {
    std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 " + std::to_string(v) + " " +
                       std::to_string(h) + " 1 2 0 0 0 1 1 60\n" + vertical + "\n" + horizontal +
                       "\n";
    for (int i = 0; i < h; ++i)
        for (int k = 0; k < v; ++k) text += std::to_string(1000 * i + k) + "\n";
    return text;
}

/// The candela of the first vertical angle, plane by plane.
std::vector<float> planes(scene::Photometry const& lamp) {
    std::vector<float> first;
    for (size_t h = 0; h < lamp.horizontal.size(); ++h) first.push_back(lamp.at(h, 0));
    return first;
}

using Floats = std::vector<float>;

TEST(Ies, AllEditionsAreRead) {
    for (char const* name : {"lm63_1986", "lm63_1991", "lm63_1995", "lm63_2002"}) {
        SCOPED_TRACE(name);
        scene::Photometry const lamp = io::read_ies(kFolder + name + ".ies");
        EXPECT_EQ(lamp.vertical, (Floats{0, 30, 60, 90}));
        EXPECT_EQ(lamp.horizontal, (Floats{0}));
        // The factors are 2, 0.5 and, but for the last edition, 0.8.
        float const factor = std::string(name) == "lm63_2002" ? 1.f : 0.8f;
        ASSERT_EQ(lamp.candela.size(), 4u);
        EXPECT_FLOAT_EQ(lamp.candela[0], 400 * factor);
        EXPECT_FLOAT_EQ(lamp.candela[3], 2.5f * factor);
        EXPECT_EQ(lamp.lamp_lumens, 2400);
        EXPECT_EQ(lamp.watts, 36);
    }
}

TEST(Ies, SymmetriesAreCompletedToAllAround) {
    auto lamp = io::read_ies(numbered("0 90", 2, "0", 1), "l.ies");
    EXPECT_EQ(lamp.horizontal, (Floats{0}));
    lamp = io::read_ies(numbered("0 90", 2, "0 30 90", 3), "l.ies");
    EXPECT_EQ(lamp.horizontal, (Floats{0, 30, 90, 150, 180, 210, 270, 330, 360}));
    EXPECT_EQ(planes(lamp), (Floats{0, 1000, 2000, 1000, 0, 1000, 2000, 1000, 0}));
    lamp = io::read_ies(numbered("0 180", 2, "0 45 180", 3), "l.ies");
    EXPECT_EQ(lamp.horizontal, (Floats{0, 45, 180, 315, 360}));
    EXPECT_EQ(planes(lamp), (Floats{0, 1000, 2000, 1000, 0}));
    lamp = io::read_ies(numbered("90 180", 2, "90 120 180 270", 4), "l.ies");
    EXPECT_EQ(lamp.horizontal, (Floats{0, 60, 90, 120, 180, 270, 360}));
    EXPECT_EQ(planes(lamp), (Floats{2000, 1000, 0, 1000, 2000, 3000, 2000}));
    EXPECT_EQ(lamp.at(1, 1), 1001);
    lamp = io::read_ies(numbered("0 180", 2, "0 90 200 360", 4), "l.ies");
    EXPECT_EQ(planes(lamp), (Floats{0, 1000, 2000, 3000}));
    EXPECT_EQ(lamp.at(2, 1), 2001);
}

TEST(Ies, MissingPlanesAreFilledIn) {
    // Symmetric about 90 and 270 degrees, without a plane at 180: what 0 and 360 are.
    auto lamp = io::read_ies(numbered("0 90", 2, "90 130 230 270", 4), "l.ies");
    EXPECT_EQ(lamp.horizontal, (Floats{0, 50, 90, 130, 230, 270, 310, 360}));
    EXPECT_EQ(planes(lamp), (Floats{1500, 1000, 0, 1000, 2000, 3000, 2000, 1500}));
    // One that stops short of 360 goes on with its first plane.
    lamp = io::read_ies(numbered("0 90", 2, "0 120 240", 3), "l.ies");
    EXPECT_EQ(lamp.horizontal, (Floats{0, 120, 240, 360}));
    EXPECT_EQ(planes(lamp), (Floats{0, 1000, 2000, 0}));
}

TEST(Ies, TiltIsReadAndNotUsed) {
    std::string const text = numbered("0 90", 2, "0", 1);
    std::string tilted = text;
    tilted.replace(tilted.find("NONE"), 4, "INCLUDE\n2\n3\n0 45, 90\n1 0.9\n0.8");
    EXPECT_EQ(io::read_ies(tilted, "l.ies").candela, io::read_ies(text, "l.ies").candela);
}

TEST(Ies, LineEndsAndSeparators) {
    std::string const text = numbered("0 45 90", 3, "0 90", 2);
    scene::Photometry const lamp = io::read_ies(text, "l.ies");
    for (std::string const end : {"\r\n", "\r", "\n\n"}) {
        std::string other;
        for (char c : text) c == '\n' ? other += end : c == ' ' ? other += " ,\t" : other += c;
        EXPECT_EQ(io::read_ies(other + "\x1a", "l.ies").candela, lamp.candela);
    }
}

TEST(Ies, AbsolutePhotometryHasNoLumens) {
    std::string text = numbered("0 90", 2, "0", 1);
    text.replace(text.find("1000"), 4, "-1");
    EXPECT_EQ(io::read_ies(text, "l.ies").lamp_lumens, -1);
}

TEST(Ies, BadFilesAreRefusedWithTheirMessage) {
    int const count = weft::testing::expect_refusals(
        ".ies",
        [](std::string const& bytes, std::string const& name) { io::read_ies(bytes, name); });
    EXPECT_GE(count, 20);
}

/// Whatever is cut off or exchanged, there is a lamp or a message.
TEST(Ies, MutationsAreReadOrRefused) {
    std::string const text = weft::testing::read_bytes(kFolder + "lm63_1995.ies");
    int refused = 0;
    Rng rng(7);
    for (int i = 0; i < 20'000; ++i) {
        std::string bytes = text;
        for (int k = 0; k <= int(rng.next() * 3); ++k) {
            size_t const at = std::min(size_t(rng.next() * float(bytes.size())), bytes.size() - 1);
            switch (int(rng.next() * 4)) {
            case 0:
                bytes[at] = char(rng.next() * 128);
                break;
            case 1:
                bytes[at] = "0123456789.-e \n,"[int(rng.next() * 16)];
                break;
            case 2:
                bytes.erase(at, 1 + size_t(rng.next() * 8));
                break;
            default:
                bytes.insert(at, 1, "0123456789.-e \n,"[int(rng.next() * 16)]);
            }
            if (bytes.empty()) bytes = " ";
        }
        try {
            scene::Photometry const lamp = io::read_ies(bytes, "m.ies");
            ASSERT_EQ(lamp.candela.size(), lamp.vertical.size() * lamp.horizontal.size());
            ASSERT_GE(lamp.vertical.size(), 2u);
            ASSERT_TRUE(std::is_sorted(lamp.horizontal.begin(), lamp.horizontal.end()));
            ASSERT_TRUE(lamp.horizontal.size() == 1 ||
                        (lamp.horizontal.front() == 0 && lamp.horizontal.back() == 360));
            for (float c : lamp.candela) ASSERT_GE(c, 0);
        } catch (InputError const& e) {
            ++refused;
            ASSERT_EQ(std::string(e.what()).find("m.ies"), 0u) << e.what();
        }
    }
    EXPECT_GT(refused, 1000);
}

} // namespace
