// How much noise is left: scenes that ship, at 32 samples per pixel, against references that Weft
// rendered with 2048 (tests/post/references; its README says how to make them anew).
#include <gtest/gtest.h>

#include <iostream>
#include <optional>

#include "image/compare.h"
#include "post/denoise.h"
#include "post/weights.h"
#include "session/render.h"
#include "tests/support/scenes.h"

namespace weft::post {
namespace {

struct QualityCase {
    char const* name;
    char const* scene;
    double network, nlm;            ///< what may be left of the mean square error
    double network_relative = 0.25; ///< and of the relative one
};

// In `demo` half of the error are lamps of three pixels out of focus, which few of 32 samples hit:
// no denoiser knows which of those pixels are right. `swatch` has little noise to begin with, and a
// weave of threads as wide as a pixel that looks like it.
constexpr QualityCase kCases[] = {
    {"demo", "demo.xml", 0.45, 0.6},
    {"swatch", "swatch.xml", 0.45, 0.6, 0.4},
    {"fabrics", "figures/fabrics.xml", 0.35, 0.6},
    {"roughness", "figures/roughness.xml", 0.35, 0.6},
    {"shader_sheet", "figures/shader_sheet.xml", 0.35, 0.6},
    {"bounce_cards", "figures/bounce_cards.xml", 0.35, 0.6},
};

class Quality : public ::testing::TestWithParam<QualityCase> {
  protected:
    /// The scene's picture at 160 x 120 and 32 samples per pixel, by another integrator where asked
    /// for.
    image::Image render(std::optional<scene::Integrator> integrator = {}) const {
        std::string const path = std::string(WEFT_SOURCE_DIR) + "/scenes/" + GetParam().scene;
        io::RenderJob job = io::read_scene_file(path).jobs.at(0);
        if (integrator) job.integrator = *integrator;
        auto const world = world::World::commit(job.scene, {"", {160, 120}});
        session::RenderOptions options;
        options.spp = 32;
        return session::render(*world, job, options).image;
    }
};

TEST_P(Quality, LittleNoiseIsLeft) {
    image::Image const reference = image::read_image(
        std::string(WEFT_SOURCE_DIR) + "/tests/post/references/" + GetParam().name + ".exr");
    scene::NormalIntegrator normals;
    normals.remap = false;
    image::Image const noisy = render(), albedo = render(scene::AlbedoIntegrator{}),
                       normal = render(normals);
    image::Difference const before = image::compare(noisy, reference);
    ASSERT_LT(std::abs(before.me), 0.1 * std::sqrt(before.mse))
        << "the reference is of another picture: render it anew";
    for (Backend backend : {Backend::network, Backend::nlm}) {
        DenoiseInput const input{&noisy, &albedo, &normal};
        bool const network = backend == Backend::network;
        if (network && find_weights("rt_hdr_alb_nrm.tza", weight_folders()).empty()) {
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
        EXPECT_LT(ratio, network ? GetParam().network : GetParam().nlm);
        EXPECT_LT(after.rel_mse / before.rel_mse, network ? GetParam().network_relative : 0.5);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Quality, ::testing::ValuesIn(kCases),
                         [](auto const& tested) { return std::string(tested.param.name); });

} // namespace
} // namespace weft::post
