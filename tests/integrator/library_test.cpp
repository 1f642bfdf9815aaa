// The materials that ship: each loads, is what its file's name says, and makes no light.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

std::set<std::filesystem::path> library() {
    std::set<std::filesystem::path> files;
    for (auto const& entry :
         std::filesystem::directory_iterator(WEFT_SOURCE_DIR "/scenes/materials"))
        if (entry.path().extension() == ".xml") files.insert(entry.path());
    return files;
}

/// The ball of the swatches in an even light of radiance 1.
TestScene furnace(std::filesystem::path const& material) {
    return make_scene(
        R"(<camera type="perspective" width="24" height="24" fov="20"><transform><lookat origin="0.03,-0.16,0.08" target="0,0,0.024" up="0,0,-1"/></transform></camera>
           <light type="envmap"><texture type="constant" value="1"/></light>
           <include filename="scenes/materials/)" +
            material.filename().string() + R"("/>
           <instance><shape type="mesh" filename="scenes/swatch/ball.ply"/><ref id=")" +
            material.stem().string() + R"("/></instance>)",
        "type=\"path\" depth=\"64\"", WEFT_SOURCE_DIR);
}

TEST(MaterialLibrary, MakesNoLight) {
    auto const files = library();
    ASSERT_GE(files.size(), 24u);
    // Blocks of 2 x 2 pixels in three colours. What dims the layers below a lobe is its tabulated
    // albedo, which tests/lobes/layers.cpp holds to 0.001; the rest is for sums of floats.
    constexpr double tolerance = 0.001 + 1e-5;
    double const level = sidak(1e-3, int(files.size()) * 3 * 12 * 12);
    for (auto const& file : files) {
        TestScene const scene = furnace(file);
        double darkest = 1;
        for (Estimate const& e : block_estimates(scene, 128, 2, 11)) {
            ASSERT_TRUE(std::isfinite(e.mean)) << file;
            darkest = std::min(darkest, e.mean);
            double const above = e.mean - 1 - tolerance;
            if (above > 0) {
                EXPECT_GT(normal_tail(above / std::sqrt(e.variance)) / 2, level)
                    << file << ": " << e.mean << " +- " << std::sqrt(e.variance);
            }
        }
        bool const clear = file.stem() == "glass" || file.stem() == "water" ||
                           file.stem() == "soap_film" || file.stem() == "frosted_glass";
        if (!clear) {
            EXPECT_LT(darkest, 0.99) << file << " is not to be seen";
        }
    }
}

} // namespace
} // namespace weft::integrator
