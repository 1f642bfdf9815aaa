// Views of OpenColorIO configurations, against the library asked directly.
#include "post/ocio_view.h"

#include <OpenColorIO/OpenColorIO.h>
#include <gtest/gtest.h>

#include <limits>

#include "base/hash.h"
#include "post/display.h"
#include "tests/post/ocio_config.h"

using namespace weft;
namespace ocio = OCIO_NAMESPACE;

namespace {

std::vector<float> some_light(int count) {
    Rng rng(1);
    std::vector<float> rgb;
    for (int i = 0; i < 3 * count; ++i) rgb.push_back(std::exp2(-12 + 20 * rng.next()));
    return rgb;
}

std::string message_of(post::OcioChoice const& choice) {
    try {
        post::OcioView const view(choice);
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

/// `rgb` through the library alone.
std::vector<float> reference(std::string const& path, char const* from, char const* display,
                             char const* view, std::vector<float> rgb) {
    auto const config = ocio::Config::CreateFromFile(path.c_str());
    auto const cpu = config->getProcessor(from, display, view, ocio::TRANSFORM_DIR_FORWARD)
                         ->getDefaultCPUProcessor();
    for (size_t i = 0; i < rgb.size(); i += 3) cpu->applyRGB(&rgb[i]);
    return rgb;
}

} // namespace

TEST(Ocio, ViewsAreTheLibrarysOwn) {
    std::string const path = weft::testing::write_ocio_config("lin_rec709", true);
    std::vector<float> const light = some_light(1000);
    for (char const* display : {"sRGB", "Projector"}) {
        post::OcioView const view({path, display, "ACES SDR", ""});
        EXPECT_EQ(view.input_space(), "lin_rec709");
        std::vector<float> shown = light;
        view.apply(shown.data(), shown.size() / 3);
        std::vector<float> const expected =
            reference(path, "lin_rec709", display, "ACES SDR", light);
        for (size_t i = 0; i < shown.size(); ++i) EXPECT_NEAR(shown[i], expected[i], 1e-6) << i;
    }
}

TEST(Ocio, TheInterchangeRoleGivesTheSameView) {
    std::string const known = weft::testing::write_ocio_config("lin_rec709", true);
    std::string const unknown = weft::testing::write_ocio_config("house_linear", true);
    post::OcioView const view({unknown, "", "", ""});
    EXPECT_EQ(view.input_space(), "aces_interchange");
    EXPECT_EQ(view.warning(), "");
    std::vector<float> const light = some_light(1000);
    std::vector<float> shown = light;
    view.apply(shown.data(), shown.size() / 3);
    std::vector<float> const expected = reference(known, "lin_rec709", "sRGB", "ACES SDR", light);
    for (size_t i = 0; i < shown.size(); ++i) EXPECT_NEAR(shown[i], expected[i], 2e-5) << i;
}

TEST(Ocio, DefaultsAreTheConfigurations) {
    std::string const path = weft::testing::write_ocio_config("lin_rec709", true);
    post::OcioView const view({path, "", "", ""});
    EXPECT_EQ(view.display(), "sRGB");
    EXPECT_EQ(view.view(), "ACES SDR");
    auto const displays = post::ocio_displays(path);
    ASSERT_EQ(displays.size(), 2u);
    EXPECT_EQ(displays[0].views, (std::vector<std::string>{"ACES SDR", "Raw"}));
    EXPECT_EQ(displays[1].name, "Projector");
}

TEST(Ocio, AGuessedInputSpaceIsTold) {
    std::string const path = weft::testing::write_ocio_config("house_linear", false);
    post::OcioView const guessed({path, "", "", ""});
    EXPECT_NE(guessed.warning().find("scene_linear"), std::string::npos) << guessed.warning();
    EXPECT_EQ(post::OcioView({path, "", "", "house_linear"}).warning(), "");
}

TEST(Ocio, MistakesNameWhatMayHaveBeenMeant) {
    std::string const path = weft::testing::write_ocio_config("lin_rec709", true);
    EXPECT_EQ(
        message_of({path, "", "ACES SRD", ""}),
        path + ": no view of the display 'sRGB' is called 'ACES SRD' (did you mean 'ACES SDR'?)");
    EXPECT_EQ(message_of({path, "sRBG", "", ""}),
              path + ": no display is called 'sRBG' (did you mean 'sRGB'?)");
    EXPECT_EQ(message_of({path, "", "", "lin_rec907"}),
              path + ": no colour space is called 'lin_rec907' (did you mean 'lin_rec709'?)");
    EXPECT_EQ(message_of({path, "Projector", "Raw", ""}),
              path + ": no view of the display 'Projector' is called 'Raw'; known: ACES SDR");
    EXPECT_EQ(message_of({"missing.ocio", "", "", ""}),
              "missing.ocio: expected an OpenColorIO configuration, found no such file");
    std::string const bad = ::testing::TempDir() + "weft_bad.ocio";
    std::ofstream(bad) << "not: a configuration\n";
    EXPECT_NE(message_of({bad, "", "", ""}).find("expected an OpenColorIO configuration, found"),
              std::string::npos);
}

TEST(Ocio, WhatIsNoNumberIsShownAsBlack) {
    std::string const path = weft::testing::write_ocio_config("lin_rec709", true);
    post::OcioView const view({path, "", "", ""});
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const inf = std::numeric_limits<float>::infinity();
    std::vector<float> black{0, 0, 0}, odd{nan, nan, nan, inf, inf, inf, -inf, 0, nan};
    view.apply(black.data(), 1);
    view.apply(odd.data(), 3);
    EXPECT_EQ(odd[0], black[0]);
    for (float x : odd) EXPECT_TRUE(std::isfinite(x));
}

TEST(Ocio, TheVariableIsAskedForUnknownViewsAlone) {
    std::string const path = weft::testing::write_ocio_config("lin_rec709", true);
    ::setenv("OCIO", path.c_str(), 1);
    scene::Display display;
    EXPECT_TRUE(
        std::holds_alternative<post::StandardView>(post::make_display_chain(display, {}).view));
    display.view = "agx";
    EXPECT_TRUE(std::holds_alternative<post::AgxView>(post::make_display_chain(display, {}).view));
    display.view = "ACES SDR";
    EXPECT_EQ(post::make_display_chain(display, {}).description,
              "view ACES SDR, display sRGB (OpenColorIO)");
    display.view = "";
    display.display = "Projector";
    EXPECT_EQ(post::make_display_chain(display, {}).description,
              "view ACES SDR, display Projector (OpenColorIO)");
    ::unsetenv("OCIO");
    EXPECT_THROW(post::make_display_chain(display, {}), InputError);
}
