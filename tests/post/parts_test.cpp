// Pictures that sum to one, and the layers of a file.
#include <gtest/gtest.h>

#include "post/denoise_parts.h"
#include "post/layers.h"
#include "tests/post/pictures.h"

namespace weft::post {
namespace {

using namespace weft::testing;

TEST(DenoisedParts, SumToTheDenoisedWhole) {
    std::vector<image::Image> parts{noisy_picture(90, 70, 1), noisy_picture(90, 70, 2),
                                    noisy_picture(90, 70, 3), constant_picture(90, 70, 0)};
    for (float& x : parts[1].pixels) x *= 300;
    for (float& x : parts[2].pixels) x *= 1e-3f;
    image::Image const albedo = constant_picture(90, 70, 0.5f);
    image::Image sum = constant_picture(90, 70, 0);
    for (auto const& part : parts)
        for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += part.pixels[i];
    for (Backend backend : {Backend::nlm, Backend::automatic}) {
        DenoiseOptions options;
        options.backend = backend;
        auto const result = denoise_parts(parts, {nullptr, &albedo}, options);
        EXPECT_EQ(result.whole.pixels, denoise({&sum, &albedo}, options).image.pixels);
        ASSERT_EQ(result.parts.size(), parts.size());
        for (size_t i = 0; i < sum.pixels.size(); ++i) {
            double total = 0;
            for (auto const& part : result.parts) total += double(part.pixels[i]);
            double const whole = double(result.whole.pixels[i]);
            ASSERT_NEAR(total, whole, 1e-6 * whole);
        }
        for (float x : result.parts[3].pixels) EXPECT_EQ(x, 0);
        // The parts are still what they were: the small one is no copy of the large one.
        double small = 0, before = 0;
        for (size_t i = 0; i < sum.pixels.size(); ++i) {
            small += double(result.parts[2].pixels[i]);
            before += double(parts[2].pixels[i]);
        }
        EXPECT_NEAR(small / before, 1, 0.3);
    }
}

TEST(DenoisedParts, OfBlackAreBlack) {
    std::vector<image::Image> const parts{constant_picture(8, 8, 0), constant_picture(8, 8, 0)};
    DenoiseOptions options;
    options.backend = Backend::nlm;
    for (auto const& part : denoise_parts(parts, {}, options).parts)
        for (float x : part.pixels) EXPECT_EQ(x, 0);
}

TEST(Layers, AreFoundByTheirNames) {
    std::vector<std::string> const channels{"A",        "B",        "G",     "R",   "albedo.B",
                                            "albedo.G", "albedo.R", "N.X",   "N.Y", "N.Z",
                                            "depth.Z",  "half.R",   "half.G"};
    EXPECT_EQ(find_layer(channels, ""), (ChannelTriple{3, 2, 1}));
    EXPECT_EQ(find_layer(channels, "albedo"), (ChannelTriple{6, 5, 4}));
    EXPECT_EQ(find_layer(channels, "N"), (ChannelTriple{7, 8, 9}));
    EXPECT_FALSE(find_layer(channels, "half"));
    EXPECT_FALSE(find_layer(channels, "depth"));
    EXPECT_EQ(layer_names(channels), (std::vector<std::string>{"albedo", "N"}));
    EXPECT_EQ(find_albedo_layer(channels), "albedo");
    EXPECT_EQ(find_normal_layer(channels), "N");
    EXPECT_FALSE(find_layer({"x", "y", "z"}, ""));

    auto with = [](std::string const& layer, std::string const& components) {
        std::vector<std::string> names{"R", "G", "B"};
        for (char c : components) names.push_back(layer + "." + c);
        return names;
    };
    for (char const* name : {"ViewLayer.Denoising Albedo", "denoise_albedo", "Albedo"})
        EXPECT_EQ(find_albedo_layer(with(name, "RGB")), name);
    for (char const* name :
         {"ViewLayer.Denoising Normal", "Ns", "normal", "sh_normal", "Normals"}) {
        EXPECT_EQ(find_normal_layer(with(name, "XYZ")), name);
        EXPECT_EQ(find_normal_layer(with(name, "rgb")), name);
    }
    EXPECT_EQ(find_albedo_layer({"albedo.R", "albedo.G", "albedo.B", "denoise_albedo.R",
                                 "denoise_albedo.G", "denoise_albedo.B"}),
              "denoise_albedo");
    EXPECT_EQ(find_kept_layer(with("x.denoise_kept", "RGB")), "x.denoise_kept");
    EXPECT_EQ(find_kept_layer(with("emission", "RGB")), "") << "which may be out of focus";
    EXPECT_EQ(find_albedo_layer(with("diffuse", "RGB")), "");
    EXPECT_EQ(find_normal_layer({"R", "G", "B"}), "");
}

TEST(Layers, AreTakenAndPutBack) {
    image::Image all = image::make_image(2, 1, 4);
    all.pixels = {1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_EQ(take_channels(all, {3, 0, 1}).pixels, (std::vector<float>{4, 1, 2, 8, 5, 6}));
    image::Image three = image::make_image(2, 1, 3);
    three.pixels = {-1, -2, -3, -4, -5, -6};
    put_channels(three, {2, 1, 3}, all);
    EXPECT_EQ(all.pixels, (std::vector<float>{1, -2, -1, -3, 5, -5, -4, -6}));
}

} // namespace
} // namespace weft::post
