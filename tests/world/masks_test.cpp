// Named sets, and which objects which rays meet.
#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "world/set_names.h"

namespace weft::world {
namespace {

using namespace weft::testing;

std::string const kCamera = R"(<camera type="perspective" width="4" height="4"/>)";

std::string ball(std::string const& attributes) {
    return "<instance " + attributes + "><shape type=\"sphere\"/></instance>";
}

std::string error_of(std::string const& contents) {
    try {
        make_scene(kCamera + contents);
        return "no error";
    } catch (InputError const& e) {
        return e.what();
    }
}

TEST(Sets, AreBits) {
    SetNames names;
    EXPECT_EQ(names.declare("", {}), 0u);
    EXPECT_EQ(names.declare("hero  cast", {}), 3u);
    EXPECT_EQ(names.declare("cast\tprops", {}), 6u);
    Links const links = names.find("cast -hero", "illuminates", {});
    EXPECT_TRUE(links.accept(6));
    EXPECT_FALSE(links.accept(3));
    EXPECT_FALSE(links.accept(0));
    EXPECT_TRUE(names.find("-hero", "illuminates", {}).accept(0));
    EXPECT_FALSE(bool(names.find(" ", "illuminates", {})));
}

TEST(Sets, ThatDoNotExistAreErrors) {
    std::string const lamp = R"(<light type="point" illuminates="heroes"/>)";
    EXPECT_EQ(error_of(ball("sets=\"hero cast\"") + lamp),
              "test:1:170: 'illuminates' expects sets that instances name in 'sets', found "
              "'heroes' (did you mean 'hero'?)");
    EXPECT_NE(error_of(ball("") + R"(<light type="point" shadowedBy="-a"/>)")
                  .find("'shadowedBy' expects sets that instances name in 'sets', found 'a': no "
                        "instance names any"),
              std::string::npos);
    EXPECT_NE(error_of(ball("sets=\"-hero\"")).find("names that do not start with '-'"),
              std::string::npos);
    std::string many;
    for (int i = 0; i < 65; ++i) many += " s" + std::to_string(i);
    EXPECT_NE(error_of(ball("sets=\"" + many + "\""))
                  .find("expected at most 64 sets of instances, found another: 's64'"),
              std::string::npos);
    std::string lamps, sets;
    for (int i = 0; i < 25; ++i) {
        sets += " s" + std::to_string(i);
        lamps += "<light type=\"point\" shadowedBy=\"s" + std::to_string(i) + "\"/>";
    }
    EXPECT_NE(
        error_of(ball("sets=\"" + sets + "\"") + lamps)
            .find("expected at most 24 different lists in 'shadowedBy', found another: 's24'"),
        std::string::npos);
}

TEST(RayMasks, SayWhichObjectsAreMet) {
    // In a group and instanced several times, as well as alone.
    for (bool grouped : {false, true}) {
        std::string const one = ball("visibleToGlossy=\"false\" castShadows=\"false\"");
        auto const scene = make_scene(
            kCamera + (grouped
                           ? "<instance visibleToVolume=\"false\"><shape type=\"group\">" + one +
                                 "</shape><transform><scale x=\"2\"/></transform></instance>"
                           : one));
        Ray ray;
        ray.origin = {0, 0, -5};
        auto const meets = [&](RayMask mask) {
            ray.mask = mask;
            return bool(scene.world->intersect(ray));
        };
        EXPECT_TRUE(meets(mask_of(RayKind::camera)));
        EXPECT_TRUE(meets(mask_of(RayKind::diffuse)));
        EXPECT_FALSE(meets(mask_of(RayKind::glossy)));
        EXPECT_TRUE(meets(mask_of(RayKind::transmission)));
        EXPECT_EQ(meets(mask_of(RayKind::volume)), !grouped);
        EXPECT_TRUE(meets(kUnruledMask));
        ray.mask = kShadowMask;
        EXPECT_EQ(scene.world->visibility(ray), Color(1));
        ray.mask = kUnruledMask;
        EXPECT_EQ(scene.world->visibility(ray), Color(0));
    }
}

} // namespace
} // namespace weft::world
