// How much noise is left: scenes that ship, at 32 samples per pixel, against references that Weft
// rendered with 2048 (tests/post/references; its README says how to make them anew).
#include <gtest/gtest.h>

#include <iostream>

#include "image/compare.h"
#include "image/layers.h"
#include "post/network.h"
#include "post/weights.h"
#include "session/render.h"
#include "tests/support/scenes.h"

namespace weft::post {
namespace {

struct QualityCase {
    char const* name;
    char const* scene;
    double network_relative = 0.25; ///< what the network may leave of the relative error
};

/// What may be left of the mean square error, and of the relative one.
constexpr double kNetworkLeaves = 0.35, kNlmLeaves = 0.6, kNlmRelative = 0.5;

constexpr QualityCase kCases[] = {
    {"demo", "demo.xml"},
    {"swatch", "swatch.xml", 0.3}, // threads as wide as a pixel, and little noise
    {"fabrics", "figures/fabrics.xml"},
    {"roughness", "figures/roughness.xml"},
    {"shader_sheet", "figures/shader_sheet.xml"},
    {"bounce_cards", "figures/bounce_cards.xml"},
    {"light_or_card", "figures/light_or_card.xml"}, // lamps in view
};

class DenoisingQuality : public ::testing::TestWithParam<QualityCase> {
  protected:
    /// The scene's picture at 160 x 120 and 32 samples per pixel, with the guides that
    /// `--aov denoise_albedo,denoise_normal` brings.
    image::Image render() const {
        std::string const path = std::string(WEFT_SOURCE_DIR) + "/scenes/" + GetParam().scene;
        scene::RenderJob const job = io::read_scene_file(path).jobs.at(0);
        auto const stage = lights::Stage::commit(job.scene, {"", {160, 120}});
        session::RenderOptions options;
        options.limits.spp = 32;
        options.picture.aovs = {film::Aov::denoise_albedo, film::Aov::denoise_normal};
        return session::render(*stage, job, options).film.image();
    }
};

TEST_P(DenoisingQuality, LittleNoiseIsLeft) {
    image::Image const reference = image::read_image(
        std::string(WEFT_SOURCE_DIR) + "/tests/post/references/" + GetParam().name + ".exr");
    image::Image const rendered = render();
    auto layer = [&](std::string const& name) {
        return image::take_channels(rendered, image::find_layer(rendered.names, name).value());
    };
    image::Image const noisy = layer(""), albedo = layer("denoise_albedo"),
                       normal = layer("denoise_normal"), kept = layer("denoise_kept");
    image::Difference const before = image::compare(noisy, reference);
    ASSERT_LT(std::abs(before.me), 0.1 * std::sqrt(before.mse))
        << "the reference is of another picture: render it anew";
    for (Backend backend : {Backend::network, Backend::nlm}) {
        DenoiseInput const input{&noisy, &albedo, &normal, &kept};
        bool const network = backend == Backend::network;
        if (network && !find_weights(weights_files(input, Quality::high), weight_folders())) {
            std::cout << "no weights here (tools/setup denoise): the network is not tested\n";
            continue;
        }
        DenoiseOptions options;
        options.backend = backend;
        image::Difference const after = image::compare(denoise(input, options).image, reference);
        EXPECT_EQ(after.non_finite, 0u);
        double const ratio = after.mse / before.mse;
        std::cout << GetParam().name << ", " << backend_name(backend) << ": " << ratio
                  << " of the mean square error is left, " << after.rel_mse / before.rel_mse
                  << " of the relative one\n";
        EXPECT_LT(ratio, network ? kNetworkLeaves : kNlmLeaves);
        EXPECT_LT(after.rel_mse / before.rel_mse,
                  network ? GetParam().network_relative : kNlmRelative);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DenoisingQuality, ::testing::ValuesIn(kCases),
                         [](auto const& tested) { return std::string(tested.param.name); });

} // namespace
} // namespace weft::post
