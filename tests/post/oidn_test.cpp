// Open Image Denoise, found while the program runs: with stand-ins for the library, whose record of
// calls is compared with what its documentation asks for.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "post/oidn.h"
#include "tests/post/pictures.h"
#include "tests/support/scenes.h"

namespace weft::post {
namespace {

using namespace weft::testing;

std::string library_path(std::string const& kind) {
    return std::string(WEFT_FAKE_OIDN_FOLDER) + "/libfake_oidn_" + kind + ".so";
}

std::string take_calls(OidnLibrary const& library) {
    using Calls = char const*();
    return reinterpret_cast<Calls*>(library.function("fake_oidn_calls"))();
}

image::Image four_channels(image::Image const& image) {
    image::Image result = image::make_image(image.width, image.height, 4);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) result.at(x, y, c) = image.at(x, y, c);
    return result;
}

TEST(Oidn, IsCalledAsItsInterfaceSays) {
    image::Image color = noisy_picture(7, 5);
    color.at(2, 3, 1) = std::numeric_limits<float>::quiet_NaN();
    image::Image const wide = four_channels(color), normal = noisy_picture(7, 5, 3);
    for (char const* kind : {"newer", "older"}) {
        SCOPED_TRACE(kind);
        OidnLibrary const library({"libnone.so.9", library_path(kind)});
        ASSERT_TRUE(library) << library.problem();
        take_calls(library);
        image::Image const result =
            denoise_oidn(library, {&wide, &wide, &normal}, Quality::balanced, 300);
        EXPECT_EQ(take_calls(library), "device 1\ncommit device\nfilter RT\n"
                                       "color 3 7x5 0 12 0\nalbedo 3 7x5 0 16 0\n"
                                       "normal 3 7x5 0 12 0\noutput 3 7x5 0 12 0\n"
                                       "hdr 1\nmaxMemoryMB 300\ncommit\nexecute\n"
                                       "release filter\nrelease device\n");
        ASSERT_EQ(result.channels, 3);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 7; ++x)
                for (int c = 0; c < 3; ++c) {
                    float const light = color.at(x, y, c);
                    EXPECT_EQ(result.at(x, y, c), std::isfinite(light) ? light / 2 : 0);
                }
    }
}

TEST(Oidn, DenoisesItsGuidesFirst) {
    image::Image const color = noisy_picture(7, 5);
    OidnLibrary const library({library_path("newer")});
    take_calls(library);
    denoise_oidn(library, {&color, &color, &color}, Quality::high, 300);
    std::string const run = "maxMemoryMB 300\ncommit\nexecute\nrelease filter\n",
                      size = " 3 7x5 0 12 0\n";
    EXPECT_EQ(take_calls(library), "device 1\ncommit device\nfilter RT\nalbedo" + size + "output" +
                                       size + run + "filter RT\nnormal" + size + "output" + size +
                                       run + "filter RT\ncolor" + size + "albedo" + size +
                                       "normal" + size + "output" + size + "hdr 1\ncleanAux 1\n" +
                                       run + "release device\n");
}

TEST(Oidn, TakesNormalsOnlyBesideAlbedo) {
    image::Image const color = noisy_picture(7, 5);
    OidnLibrary const library({library_path("newer")});
    take_calls(library);
    denoise_oidn(library, {&color, nullptr, &color}, Quality::high, 300);
    EXPECT_EQ(take_calls(library).find("normal"), std::string::npos);
}

TEST(Oidn, TellsItsErrors) {
    TemporaryFolder const folder;
    image::Image const color = noisy_picture(7, 5);
    OidnLibrary const library({library_path("newer")});
    setenv("WEFT_FAKE_OIDN_ERROR", (folder / "step").c_str(), 1);
    for (char const* step : {"device", "commit-device", "commit", "execute"}) {
        std::ofstream(folder / "step") << step;
        try {
            denoise_oidn(library, {&color}, Quality::high, 300);
            ADD_FAILURE() << "no error at " << step;
        } catch (InputError const& e) {
            EXPECT_EQ(e.what(), "Open Image Denoise: cannot do " + std::string(step));
        }
        std::string const calls = take_calls(library);
        EXPECT_EQ(calls.ends_with("release device\n"), step != std::string("device")) << calls;
    }
    unsetenv("WEFT_FAKE_OIDN_ERROR");
}

TEST(Oidn, SaysWhyItIsNotThere) {
    OidnLibrary const library({"libnone.so.9", library_path("lacking")});
    EXPECT_FALSE(library);
    EXPECT_NE(library.problem().find("libnone.so.9: cannot open"), std::string::npos)
        << library.problem();
    EXPECT_NE(library.problem().find("libfake_oidn_lacking.so has no function oidnExecuteFilter"),
              std::string::npos)
        << library.problem();
}

} // namespace
} // namespace weft::post
