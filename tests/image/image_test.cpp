// Files written and read again, files that are damaged, and writes that fail half way.
#include "base/color.h"
#include "base/hash.h"
#include "image/atomic_file.h"
#include "image/image.h"
#include "image/write.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace weft;
using namespace weft::image;
namespace fs = std::filesystem;

namespace {

/// A folder of its own for each test, removed at its end.
class ImageFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        auto const* const test = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() /
                  ("weft_image_" + std::string(test->name()) + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(std::string const& name) const { return (folder_ / name).string(); }
    size_t count_files() const {
        return size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

std::string read_bytes(std::string const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(std::string const& path, std::string const& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

Image noise(int width, int height, int channels) {
    Image image = make_image(width, height, channels);
    Rng rng(7);
    for (float& x : image.pixels) x = rng.next();
    return image;
}

/// A ramp that is smooth once encoded, which JPEG keeps well.
Image ramp(int width, int height) {
    Image image = make_image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) =
                    srgb_to_linear(float(x + y + 8 * c) / float(width + height + 16));
    return image;
}

std::string input_error(std::string const& path) {
    try {
        read_image(path);
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

TEST_F(ImageFiles, ExrKeepsEveryBitOfAFloat) {
    for (int channels : {1, 2, 3, 4}) {
        Image image = noise(37, 101, channels);
        image.pixels[0] = std::numeric_limits<float>::quiet_NaN();
        image.pixels[1] = kInfinity;
        image.pixels[2] = -1e-40f;
        image.pixels[3] = 3e38f;
        write_exr(path("a.exr"), image);
        Image const back = read_image(path("a.exr"));
        ASSERT_EQ(back.width, 37);
        ASSERT_EQ(back.height, 101);
        ASSERT_EQ(back.channels, channels);
        EXPECT_FALSE(back.is_srgb_encoded);
        for (size_t i = 0; i < image.pixels.size(); ++i)
            ASSERT_EQ(std::bit_cast<uint32_t>(image.pixels[i]),
                      std::bit_cast<uint32_t>(back.pixels[i]))
                << i;
    }
}

TEST_F(ImageFiles, ExrHalfRoundsToElevenBits) {
    Image const image = noise(16, 16, 3);
    write_exr(path("a.exr"), image, {}, Precision::half);
    Image const back = read_image(path("a.exr"));
    for (size_t i = 0; i < image.pixels.size(); ++i)
        EXPECT_NEAR(back.pixels[i], image.pixels[i], image.pixels[i] * 0x1p-11f + 0x1p-25f);
}

TEST_F(ImageFiles, ExrLayersComeFromAnywhereInMemory) {
    Image const beauty = noise(70, 130, 3);
    std::vector<float> depth(70 * 130);
    for (size_t i = 0; i < depth.size(); ++i) depth[i] = float(i);
    std::vector<Channel> const channels{{"R", beauty.pixels.data(), 3},
                                        {"G", beauty.pixels.data() + 1, 3},
                                        {"B", beauty.pixels.data() + 2, 3},
                                        {"direct.R", beauty.pixels.data() + 2, 3},
                                        {"Z", depth.data(), 1}};
    write_exr(path("a.exr"), 70, 130, channels);
    Image const back = read_image(path("a.exr"));
    ASSERT_EQ(back.channels, 5);
    for (int c = 0; c < 5; ++c) {
        std::string const& name = back.names[size_t(c)];
        for (int y = 0; y < 130; ++y)
            for (int x = 0; x < 70; ++x) {
                float const expected = name == "Z"          ? depth[size_t(y * 70 + x)]
                                       : name == "R"        ? beauty.at(x, y, 0)
                                       : name == "G"        ? beauty.at(x, y, 1)
                                       : name == "B"        ? beauty.at(x, y, 2)
                                       : name == "direct.R" ? beauty.at(x, y, 2)
                                                            : -1;
                ASSERT_EQ(back.at(x, y, c), expected) << name;
            }
    }
    // An image read with names is written with them.
    write_exr(path("b.exr"), back);
    EXPECT_EQ(read_image(path("b.exr")).names, back.names);
}

TEST_F(ImageFiles, MoreThanFourChannelsMustBeNamed) {
    EXPECT_THROW(write_exr(path("a.exr"), noise(4, 4, 5)), InputError);
    EXPECT_EQ(count_files(), 0u);
}

TEST_F(ImageFiles, MetadataComesBack) {
    Metadata const metadata{{"weft:scene", "bunny.xml"}, {"weft:samples", "64"}};
    for (char const* name : {"a.exr", "a.png"}) {
        write_image(path(name), noise(8, 8, 3), metadata);
        Metadata const back = read_metadata(path(name));
        for (auto const& [key, value] : metadata) {
            ASSERT_TRUE(back.count(key)) << name << " " << key;
            EXPECT_EQ(back.at(key), value);
        }
    }
}

TEST_F(ImageFiles, ExrHeadersPlaceAndDescribe) {
    ExrHeader header;
    header.texts = {{"weft:camera", "<camera type=\"thinlens\"/>"}};
    header.chromaticities = kRec709;
    header.world_to_camera = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1};
    header.x = 30;
    header.y = 70;
    header.full_width = 200;
    header.full_height = 150;
    Image const image = noise(90, 75, 3); // more than one strip of lines
    write_described_exr(path("a.exr"), image, header);
    EXPECT_EQ(read_image(path("a.exr")).pixels, image.pixels);
    EXPECT_EQ(read_metadata(path("a.exr")).at("weft:camera"), header.texts.at("weft:camera"));
    auto const input = OIIO::ImageInput::open(path("a.exr"));
    ASSERT_TRUE(input);
    OIIO::ImageSpec const& spec = input->spec();
    EXPECT_EQ(spec.x, 30);
    EXPECT_EQ(spec.y, 70);
    EXPECT_EQ(spec.width, 90);
    EXPECT_EQ(spec.full_x, 0);
    EXPECT_EQ(spec.full_width, 200);
    EXPECT_EQ(spec.full_height, 150);
    auto const* const colors = spec.find_attribute("chromaticities");
    ASSERT_TRUE(colors && colors->type().basevalues() == 8);
    EXPECT_EQ(colors->get_float_indexed(2), 0.30f);
    auto const* const matrix = spec.find_attribute("worldtocamera");
    ASSERT_TRUE(matrix);
    EXPECT_EQ(static_cast<float const*>(matrix->data())[13], 3);
}

TEST_F(ImageFiles, EqualInputGivesEqualBytes) {
    for (std::string e : {".exr", ".hdr", ".png", ".jpg", ".tif"})
        write_image(path("a" + e), ramp(40, 30));
    // Dates count in seconds: the next files are made in a later one.
    for (auto const then = std::time(nullptr); std::time(nullptr) <= then + 1;) ::usleep(10000);
    for (std::string e : {".exr", ".hdr", ".png", ".jpg", ".tif"}) {
        write_image(path("b" + e), ramp(40, 30));
        EXPECT_TRUE(read_bytes(path("a" + e)) == read_bytes(path("b" + e))) << e;
    }
}

TEST_F(ImageFiles, PngIsEncodedClippedAndRounded) {
    Image image = make_image(5, 1, 1);
    image.pixels = {-1, 0.5f, 2, std::numeric_limits<float>::quiet_NaN(), 0.001f};
    write_png(path("a.png"), image);
    Image const back = read_image(path("a.png"));
    EXPECT_TRUE(back.is_srgb_encoded);
    // 0.5 encodes to 187.516, and 0.001 to 12.92 * 0.255 = 3.29.
    std::vector<float> const expected{0, 188 / 255.f, 1, 0, 3 / 255.f};
    for (size_t i = 0; i < 5; ++i) EXPECT_NEAR(back.pixels[i], expected[i], 1e-6f) << i;
}

TEST_F(ImageFiles, PngHoldsColoursNotPremultiplied) {
    Image image = make_image(3, 1, 4);
    image.pixels = {0.25f, 0.5f, 0, 0.5f, 0, 0, 0, 0, 1, 1, 1, 1};
    for (char const* name : {"a.png", "a.tif"}) {
        write_image(path(name), image);
        Image const back = read_image(path(name));
        ASSERT_EQ(back.channels, 4);
        std::vector<float> const expected{188 / 255.f, 1, 0, 128 / 255.f, 0, 0, 0, 0, 1, 1, 1, 1};
        for (size_t i = 0; i < 12; ++i)
            EXPECT_NEAR(back.pixels[i], expected[i], 1e-6f) << name << " " << i;
    }
}

TEST_F(ImageFiles, DisplayFormatsComeBackWithinTheirPrecision) {
    Image const image = ramp(64, 48);
    struct Case {
        char const* name;
        float tolerance; ///< of the encoded number
    };
    for (Case const& c :
         {Case{"a.png", 0.501f / 255}, Case{"a.tiff", 0.501f / 255}, Case{"a.jpg", 6.f / 255}}) {
        write_image(path(c.name), image);
        Image const back = read_image(path(c.name));
        ASSERT_EQ(back.channels, 3) << c.name;
        EXPECT_TRUE(back.is_srgb_encoded) << c.name;
        for (size_t i = 0; i < image.pixels.size(); ++i)
            ASSERT_NEAR(back.pixels[i], linear_to_srgb(image.pixels[i]), c.tolerance) << c.name;
    }
}

TEST_F(ImageFiles, HdrSharesAnExponent) {
    Image image = ramp(64, 48);
    for (float& x : image.pixels) x *= 1000;
    write_image(path("a.hdr"), image);
    Image const back = read_image(path("a.hdr"));
    EXPECT_FALSE(back.is_srgb_encoded);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            float const most = std::max({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(back.at(x, y, c), image.at(x, y, c), most / 127) << x << " " << y;
        }
}

TEST_F(ImageFiles, DamagedFilesAreRefused) {
    for (std::string e : {".exr", ".hdr", ".png", ".jpg", ".tif"}) {
        write_image(path("whole" + e), noise(64, 64, 3));
        std::string const bytes = read_bytes(path("whole" + e));
        for (double part : {0.9, 0.5, 0.2}) {
            write_bytes(path("part" + e), bytes.substr(0, size_t(double(bytes.size()) * part)));
            std::string const message = input_error(path("part" + e));
            EXPECT_NE(message.find("part" + e + ": "), std::string::npos) << message;
            EXPECT_NE(message.find("expected"), std::string::npos) << e << part << message;
            EXPECT_NE(message.find("found"), std::string::npos) << e << part << message;
        }
        write_bytes(path("empty" + e), "");
        EXPECT_NE(input_error(path("empty" + e)).find("expected"), std::string::npos) << e;
        write_bytes(path("text" + e), "This is not an image, whatever its name says.\n");
        EXPECT_NE(input_error(path("text" + e)).find("expected"), std::string::npos) << e;
    }
    EXPECT_EQ(input_error(path("none.png")),
              path("none.png") + ": cannot open the image: No such file or directory");
}

TEST_F(ImageFiles, ATruncatedPngIsOneMessage) {
    // The PNG library would say something on stderr by itself.
    write_image(path("whole.png"), noise(64, 48, 3));
    std::string const bytes = read_bytes(path("whole.png"));
    for (size_t kept : {size_t(8), size_t(20), size_t(60), bytes.size() / 2, bytes.size() - 13}) {
        write_bytes(path("cut.png"), bytes.substr(0, kept));
        ::testing::internal::CaptureStderr();
        std::string const message = input_error(path("cut.png"));
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << kept;
        EXPECT_EQ(message, path("cut.png") +
                               ": truncated: expected the last chunk of a PNG, found "
                               "none in " +
                               std::to_string(kept) + " bytes");
    }
}

TEST_F(ImageFiles, AFailedWriteLeavesTheOldFile) {
    // A limit on the size of files stands in for a full disk. The signal that comes with it is
    // ignored, as it is where a disk is full.
    auto const previous = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    for (std::string e : {".exr", ".hdr", ".png", ".jpg", ".tif"}) {
        std::string const file = path("a" + e);
        write_image(file, ramp(16, 16));
        std::string const before = read_bytes(file);
        for (rlim_t limit : {rlim_t(0), rlim_t(1000), rlim_t(20000)}) {
            rlimit tight = old_limit;
            tight.rlim_cur = limit;
            ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
            EXPECT_THROW(write_image(file, noise(256, 256, 3)), IoError) << e << " " << limit;
            ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
            EXPECT_TRUE(read_bytes(file) == before) << e;
            EXPECT_EQ(count_files(), 1u) << e;
        }
        // The last byte counts too: it is written while the file is closed.
        write_image(file, noise(64, 64, 3));
        rlimit tight = old_limit;
        tight.rlim_cur = fs::file_size(file) - 1;
        write_image(file, ramp(16, 16));
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
        EXPECT_THROW(write_image(file, noise(64, 64, 3)), IoError) << e;
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
        EXPECT_TRUE(read_bytes(file) == before) << e;
        fs::remove(file);
    }
    std::signal(SIGXFSZ, previous);
}

TEST_F(ImageFiles, AWriteKeepsThePermissionsOfTheOldFile) {
    write_image(path("a.exr"), ramp(4, 4));
    fs::permissions(path("a.exr"), fs::perms(0640));
    write_image(path("a.exr"), ramp(8, 8));
    EXPECT_EQ(fs::status(path("a.exr")).permissions(), fs::perms(0640));
    EXPECT_EQ(read_image(path("a.exr")).width, 8);
    EXPECT_EQ(count_files(), 1u);
}

/// Writes `text` as one step, calling `half_way` in its middle.
void replace_text(std::string const& file, std::string const& text, auto half_way) {
    replace_file(file, [&](int descriptor, std::string const&) {
        size_t const half = text.size() / 2;
        ASSERT_EQ(::write(descriptor, text.data(), half), ssize_t(half));
        half_way();
        ASSERT_EQ(::write(descriptor, text.data() + half, text.size() - half),
                  ssize_t(text.size() - half));
    });
}

/// Runs `f` in a process of its own.
pid_t start_process(auto f) {
    pid_t const pid = ::fork();
    if (pid != 0) return pid;
    f();
    ::_exit(::testing::Test::HasFailure());
}

TEST_F(ImageFiles, AWriteRemovesWhatAKilledOneLeft) {
    std::string const file = path("a.checkpoint");
    for (int k = 0; k < 3; ++k) {
        pid_t const pid =
            start_process([&] { replace_text(file, "killed", [] { ::raise(SIGKILL); }); });
        int status = 0;
        ASSERT_EQ(::waitpid(pid, &status, 0), pid);
        ASSERT_TRUE(WIFSIGNALED(status));
        EXPECT_EQ(count_files(), size_t(k > 0) + 1) << "its temporary file, and no other's";
        probe_folder(file);
        EXPECT_EQ(count_files(), size_t(k > 0));
        replace_text(file, "whole", [] {});
        EXPECT_EQ(count_files(), 1u);
        EXPECT_EQ(read_bytes(file), "whole");
    }
}

TEST_F(ImageFiles, AWriteHarmsNoLivingOne) {
    std::string const file = path("a.checkpoint");
    int ready[2], go[2];
    ASSERT_EQ(::pipe(ready) | ::pipe(go), 0);
    pid_t const pid = start_process([&] {
        replace_text(file, "the other process", [&] {
            char c = 0;
            ASSERT_EQ(::write(ready[1], &c, 1), 1);
            ASSERT_EQ(::read(go[0], &c, 1), 1);
        });
    });
    char c = 0;
    ASSERT_EQ(::read(ready[0], &c, 1), 1);
    for (int k = 0; k < 3; ++k) replace_text(file, "this process", [] {});
    EXPECT_EQ(read_bytes(file), "this process");
    EXPECT_EQ(count_files(), 2u);
    ASSERT_EQ(::write(go[1], &c, 1), 1);
    int status = -1;
    ASSERT_EQ(::waitpid(pid, &status, 0), pid);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(read_bytes(file), "the other process");
    EXPECT_EQ(count_files(), 1u);
    for (int d : {ready[0], ready[1], go[0], go[1]}) ::close(d);
}

TEST_F(ImageFiles, ManyWritersAtOnceAllSucceed) {
    std::string const file = path("a.checkpoint");
    std::vector<pid_t> writers;
    for (char letter = 'a'; letter < 'g'; ++letter)
        writers.push_back(start_process([&] {
            for (int k = 0; k < 100; ++k) {
                replace_text(file, std::string(1000, letter), [] {});
                std::string const found = read_bytes(file);
                EXPECT_EQ(found, std::string(1000, found.at(0)));
            }
        }));
    for (pid_t const pid : writers) {
        int status = -1;
        EXPECT_EQ(::waitpid(pid, &status, 0), pid);
        EXPECT_EQ(status, 0);
    }
    EXPECT_EQ(count_files(), 1u);
}

TEST_F(ImageFiles, AWriteLeavesLinksAndFoldersAlone) {
    std::string const file = path("a.checkpoint");
    write_bytes(path("precious"), "precious");
    fs::create_symlink("precious", path(".a.part-0.checkpoint"));
    fs::create_directory(path(".a.part-1.checkpoint"));
    replace_text(file, "whole", [] {});
    EXPECT_EQ(read_bytes(path("precious")), "precious");
    EXPECT_EQ(read_bytes(file), "whole");
    EXPECT_TRUE(fs::is_symlink(path(".a.part-0.checkpoint")));
    EXPECT_TRUE(fs::is_directory(path(".a.part-1.checkpoint")));
}

TEST_F(ImageFiles, CheckWritableTellsWhyNot) {
    auto message = [](std::string const& file) -> std::string {
        try {
            check_writable(file);
        } catch (InputError const& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(message(path("a.exr")), "");
    EXPECT_EQ(count_files(), 0u);
    EXPECT_EQ(message(path("none/a.exr")),
              path("none/a.exr") + ": cannot make a file in its folder: No such file or directory");
    EXPECT_EQ(message(path("a.gif")),
              path("a.gif") + ": expected an image file's extension (.exr, .hdr, .png, .jpg, "
                              ".tiff), found '.gif'");
    fs::create_directory(path("b.png"));
    EXPECT_EQ(message(path("b.png")), path("b.png") + ": expected a file to write, found a folder");
    EXPECT_THROW(write_image(path("b.png"), ramp(4, 4)), IoError);
    EXPECT_EQ(count_files(), 1u);
    EXPECT_THROW(write_png(path("a.exr"), ramp(4, 4)), InputError);
}

} // namespace
