// What all backends have in common, and which of them is taken.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "post/denoise.h"
#include "post/weights.h"
#include "tests/post/pictures.h"
#include "tests/support/scenes.h"

namespace weft::post {
namespace {

using namespace weft::testing;

std::string fake_oidn() { return std::string(WEFT_FAKE_OIDN_FOLDER) + "/libfake_oidn_newer.so"; }

/// Options under which neither the library nor weights are found, wherever the tests run.
DenoiseOptions nothing_there(TemporaryFolder const& folder) {
    setenv("WEFT_WEIGHTS", folder.path().c_str(), 1);
    setenv("XDG_DATA_HOME", folder.path().c_str(), 1);
    DenoiseOptions options;
    options.oidn_libraries = {"libnone.so.9"};
    return options;
}

std::string message(DenoiseInput const& input, DenoiseOptions const& options) {
    try {
        denoise(input, options);
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

class Backends : public ::testing::Test {
  protected:
    void SetUp() override {
        for (auto const& name : {"WEFT_WEIGHTS", "XDG_DATA_HOME"})
            if (char const* value = std::getenv(name)) saved_[name] = value;
    }
    void TearDown() override {
        for (auto const& name : {"WEFT_WEIGHTS", "XDG_DATA_HOME"})
            if (saved_.contains(name))
                setenv(name, saved_[name].c_str(), 1);
            else
                unsetenv(name);
    }

  private:
    std::map<std::string, std::string> saved_;
};

TEST_F(Backends, TheBestThatIsThereIsTaken) {
    TemporaryFolder const folder;
    image::Image const color = noisy_picture(20, 20);
    DenoiseOptions options = nothing_there(folder);
    EXPECT_EQ(denoise({&color}, options).backend, Backend::nlm);
    std::ofstream(folder / "rt_hdr.tza", std::ios::binary) << weights_bytes(identity_weights(3));
    EXPECT_EQ(denoise({&color}, options).backend, Backend::network);
    options.oidn_libraries.push_back(fake_oidn());
    EXPECT_EQ(denoise({&color}, options).backend, Backend::oidn);
    for (Backend backend : {Backend::oidn, Backend::network, Backend::nlm}) {
        options.backend = backend;
        EXPECT_EQ(denoise({&color}, options).backend, backend);
    }
}

TEST_F(Backends, WhatIsMissingIsExplained) {
    TemporaryFolder const folder;
    image::Image const color = noisy_picture(20, 20);
    DenoiseOptions options = nothing_there(folder);
    options.backend = Backend::oidn;
    std::string const oidn = message({&color}, options);
    EXPECT_EQ(oidn.find("the backend 'oidn' expects Intel Open Image Denoise to be installed: "
                        "libnone.so.9: cannot open shared object file"),
              0u)
        << oidn;
    options.backend = Backend::network;
    options.weights = "/nowhere";
    std::string const network = message({&color, &color, &color}, options);
    EXPECT_EQ(
        network.find(
            "the backend 'network' expects the file rt_hdr_calb_cnrm_large.tza in /nowhere, " +
            folder.path()),
        0u)
        << network;
    EXPECT_NE(network.find("found none: tools/setup denoise downloads it"), std::string::npos);
}

TEST(Denoise, RefusesPicturesThatDoNotGoTogether) {
    image::Image const color = noisy_picture(20, 10), wide = noisy_picture(21, 10),
                       grey = image::make_image(20, 10, 1);
    EXPECT_EQ(message({&grey}, {}), "the picture expects 3 channels, found 1");
    EXPECT_EQ(message({&color, &wide}, {}),
              "the albedo expects the size of the picture, 20 x 10, found 21 x 10");
    EXPECT_EQ(message({&color, nullptr, &grey}, {}), "the normal expects 3 channels, found 1");
}

TEST(Denoise, IsDoneForTheSmallestPictures) {
    for (Backend backend : {Backend::nlm, Backend::automatic}) {
        DenoiseOptions options;
        options.backend = backend;
        for (auto const& [width, height] : {std::pair(1, 1), {3, 1}, {2, 70}}) {
            image::Image const color = constant_picture(width, height, 0.5f);
            image::Image const result = denoise({&color, &color, &color}, options).image;
            ASSERT_EQ(result.pixels.size(), color.pixels.size());
            for (float x : result.pixels) EXPECT_NEAR(x, 0.5f, 0.05f);
        }
    }
}

TEST(Denoise, WhatIsKeptStaysAsItIs) {
    image::Image const noise = noisy_picture(48, 40);
    image::Image color = noise, kept = constant_picture(48, 40, 0);
    for (int y = 10; y < 20; ++y)
        for (int x = 15; x < 40; ++x)
            for (int c = 0; c < 3; ++c) color.at(x, y, c) += kept.at(x, y, c) = 700;
    DenoiseOptions options;
    options.backend = Backend::nlm;
    image::Image const without = denoise({&noise}, options).image,
                       with = denoise({&color, nullptr, nullptr, &kept}, options).image;
    for (size_t i = 0; i < with.pixels.size(); ++i)
        ASSERT_NEAR(with.pixels[i], without.pixels[i] + kept.pixels[i], 2e-3) << i;
    image::Image const narrow = constant_picture(47, 40, 0);
    EXPECT_EQ(message({&color, nullptr, nullptr, &narrow}, options),
              "the light to keep expects the size of the picture, 48 x 40, found 47 x 40");
}

TEST(Denoise, NormalsAreTakenAsDrawnOrAsTheyAre) {
    image::Image drawn = image::make_image(2, 1, 3);
    drawn.pixels = {0.5f, 1, 0.25f, 0, 0, 0};
    EXPECT_EQ(unpack_normals(drawn).pixels, (std::vector<float>{0, 1, -0.5f, 0, 0, 0}));
    image::Image const vectors = unpack_normals(drawn);
    EXPECT_EQ(unpack_normals(vectors).pixels, vectors.pixels);
}

} // namespace
} // namespace weft::post
