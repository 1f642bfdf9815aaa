// White materials in a white furnace: under even light of radiance 1 they send 1 everywhere, less
// what their tables and single-scattering lobes lose.
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace weft::integrator {
namespace {

using namespace weft::testing;

struct Case {
    std::string name, bsdf;
    double least, most; ///< radiance, by block
    int samples = 150;
};

TEST(MaterialFurnace, WhiteStaysWhite) {
    std::string const start =
        R"(<camera type="perspective" width="8" height="8" fov="20"><transform><translate z="-4"/></transform></camera>
        <light type="envmap"><texture type="constant" value="1"/></light><instance><shape type="sphere"/>)";
    std::string const metal = R"(<bsdf type="disney" baseColor="1" metallic="1" roughness="0.6")";
    std::string const matte = R"(<bsdf type="disney" baseColor="1" roughness="0.6")";
    std::vector<Case> const cases{
        {"disney matte", matte + "/>", 0.93, 1.01},
        {"disney metal", metal + "/>", 0.99, 1.01},
        {"disney clear glass",
         R"(<bsdf type="disney" baseColor="1" transmission="1" roughness="0"/>)", 0.99, 1.01},
        {"disney rough glass",
         R"(<bsdf type="disney" baseColor="1" transmission="1" roughness="0.6"/>)", 0.96, 1.02},
        {"coat", R"(<bsdf type="coat"><bsdf type="diffuse" albedo="1"/></bsdf>)", 0.97, 1.01},
        {"layered",
         R"(<bsdf type="layered"><layer opacity="0.4"><bsdf type="diffuse" albedo="1"/></layer><layer>)" +
             metal + "/></layer></bsdf>",
         0.99, 1.01},
    };
    int const tests = int(cases.size()) * 3 * 4 * 3 * 2;
    double const level = sidak(0.01, tests);
    for (Case const& c : cases)
        for (char const* strategy : {"mis", "nee", "bsdf"}) {
            auto const scene =
                make_scene(start + c.bsdf + "</instance>",
                           std::string("type=\"path\" depth=\"64\" strategy=\"") + strategy + "\"");
            for (Estimate const& e : block_estimates(scene, c.samples, 4, 5)) {
                std::string const what = c.name + ", " + strategy + ": " + std::to_string(e.mean);
                double const nearest = std::clamp(e.mean, c.least, c.most);
                EXPECT_GT(difference_p_value(e, {nearest, 0}), level) << what;
            }
        }
}

} // namespace
} // namespace weft::integrator
