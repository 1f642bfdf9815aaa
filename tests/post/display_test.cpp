// The display chain: curves, white balance, files.
#include "post/display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "base/blackbody.h"
#include "post/tone_curves.h"
#include "schema/schema.h"

using namespace weft;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

struct NamedView {
    char const* name;
    Color (*show)(Color const&);
};
constexpr NamedView kViews[] = {{"standard", [](Color const& c) { return post::standard_view(c); }},
                                {"agx", [](Color const& c) { return post::agx_view(c); }},
                                {"aces", [](Color const& c) { return post::aces_view(c); }}};

std::string message_of(scene::Display const& display, SourceLocation const& where = {}) {
    try {
        post::make_display_chain(display, where);
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

std::string bytes_of(std::string const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

image::Image test_image(int channels) {
    image::Image image = image::make_image(37, 11, channels);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = 0.37f * float((i * 7) % 31) - 0.3f;
    if (channels % 2 == 0)
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                image.at(x, y, channels - 1) = float((x + y) % 5) / 4;
    image.pixels[3] = kNan;
    image.pixels[5] = kInf;
    image.pixels[9] = -kInf;
    return image;
}

} // namespace

TEST(Views, GreyRampsRiseWithinRangeAndStayGrey) {
    for (NamedView const& view : kViews) {
        Color last(-1);
        for (float stops = -20; stops <= 20; stops += 0.01f) {
            Color const shown = view.show(Color(0.18f * std::exp2(stops)));
            EXPECT_GE(shown.g, last.g) << view.name << " at " << stops;
            EXPECT_GE(min_component(shown), 0) << view.name;
            EXPECT_LE(max_component(shown), 1) << view.name;
            EXPECT_NEAR(shown.r, shown.g, 2e-6) << view.name << " at " << stops;
            EXPECT_NEAR(shown.b, shown.g, 2e-6) << view.name << " at " << stops;
            last = shown;
        }
        EXPECT_GT(last.g, 0.999f) << view.name << ": what is bright enough is white";
        EXPECT_LT(view.show(Color(0)).g, 1e-6f) << view.name << ": black is black";
    }
}

TEST(Views, EveryNumberIsShown) {
    float const odd[] = {0, -0.f, -1, -kInf, kInf, kNan, 1e-38f, 3e38f, 65504, 1};
    for (NamedView const& view : kViews)
        for (float r : odd)
            for (float g : odd)
                for (float b : odd) {
                    Color const shown = view.show({r, g, b});
                    EXPECT_TRUE(is_finite(shown) && min_component(shown) >= 0 &&
                                max_component(shown) <= 1)
                        << view.name << " of " << r << " " << g << " " << b;
                }
}

/// The polynomial of sixth order that Wrensch (2023) fitted to AgX's curve; at 0 it is off by
/// 0.0023 itself.
TEST(Views, TheAgxSigmoidIsThePublishedOne) {
    double squares = 0;
    int const count = 1000;
    for (int i = 0; i <= count; ++i) {
        double const x = double(i) / count, x2 = x * x, x4 = x2 * x2;
        double const fit = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x +
                           0.4298 * x2 + 0.1191 * x - 0.00232;
        double const error = post::agx::sigmoid(float(x)) - fit;
        EXPECT_LT(std::abs(error), 0.01) << x;
        squares += error * error / (count + 1);
    }
    EXPECT_LT(std::sqrt(squares), 0.003);
    EXPECT_NEAR(post::agx::sigmoid(0), 0, 1e-6);
    EXPECT_NEAR(post::agx::sigmoid(1), 1, 1e-6);
    EXPECT_NEAR(post::agx::curve(0.18f), 0.5f, 1e-6);
}

/// What Hill's fit is a fit of: ACES' own reference puts middle grey at 10 % of a 48 nit cinema
/// screen's white (4.8 nits).
TEST(Views, AcesPutsMiddleGreyWhereAcesDoes) {
    EXPECT_NEAR(srgb_to_linear(post::aces_view(Color(0.18f)).g), 0.1, 0.01);
}

TEST(Views, BrightSaturatedLightFadesToWhiteInAgx) {
    Color const blue(0, 0, 200);
    EXPECT_GT(min_component(post::agx_view(blue)), 0.6f);
    EXPECT_NEAR(post::standard_view(blue).b, 1, 1e-6);
    EXPECT_EQ(post::standard_view(blue).r, 0);
}

TEST(WhiteBalance, TheGivenWhiteBecomesGrey) {
    auto expect_grey = [](Color const& shown, double y, double tolerance) {
        EXPECT_NEAR(shown.r, y, tolerance);
        EXPECT_NEAR(shown.g, y, tolerance);
        EXPECT_NEAR(shown.b, y, tolerance);
    };
    for (float kelvin : {1500.f, 1900.f, 2700.f, 3200.f, 4500.f, 6504.f, 12000.f, 40000.f}) {
        SCOPED_TRACE(kelvin);
        scene::Display display;
        display.temperature = kelvin;
        // Below 1900 K some of it is negative; the primaries and white of IEC 61966-2-1.
        Imath::V2d const xy = planck_chromaticity(kelvin);
        double const X = xy.x / xy.y, Z = (1 - xy.x - xy.y) / xy.y;
        Color const lit(float(3.2409699419 * X - 1.5373831776 - 0.4986107603 * Z),
                        float(-0.9692436363 * X + 1.8759675015 + 0.0415550574 * Z),
                        float(0.0556300797 * X - 0.2039769589 + 1.0569715142 * Z));
        expect_grey(post::white_balance(display) * lit, 1, 1e-5);
        if (kelvin >= 2700) // where the light's own table is as exact as the balance needs
            expect_grey(post::white_balance(display) * blackbody_color(kelvin), 1, 1e-3);
    }
    for (Color const& neutral :
         {Color(0.9f, 0.6f, 0.3f), Color(0.2f, 0.3f, 0.9f), Color(1, 0, 0)}) {
        scene::Display display;
        display.neutral = neutral;
        double const y = 0.212639 * neutral.r + 0.7151687 * neutral.g + 0.0721923 * neutral.b;
        expect_grey(post::white_balance(display) * neutral, y, 1e-6);
    }
}

TEST(WhiteBalance, D65IsWhereTheHelpSaysAndMovesNothing) {
    scene::Display display;
    display.temperature = 6504;
    display.tint = 9.6f;
    Color const shown = post::white_balance(display) * Color(1);
    EXPECT_NEAR(shown.r, 1, 2e-3);
    EXPECT_NEAR(shown.g, 1, 2e-3);
    EXPECT_NEAR(shown.b, 1, 2e-3);
    EXPECT_EQ(post::white_balance({}), post::ColorMatrix{});
}

TEST(WhiteBalance, TintGoesFromGreenToMagenta) {
    scene::Display display;
    display.temperature = 5000;
    Color const plain = post::white_balance(display) * Color(0.5f);
    display.tint = 30;
    Color const tinted = post::white_balance(display) * Color(0.5f);
    EXPECT_LT(tinted.g / (tinted.r + tinted.b), plain.g / (plain.r + plain.b));
    // Across the locus, at right angles: as far as it says.
    Imath::V2d const a = post::light_chromaticity(5000, 0), b = post::light_chromaticity(5000, 30);
    auto uv = [](Imath::V2d const& c) {
        double const d = -2 * c.x + 12 * c.y + 3;
        return Imath::V2d(4 * c.x / d, 6 * c.y / d);
    };
    EXPECT_NEAR((uv(b) - uv(a)).length(), 0.01, 1e-9);
}

TEST(Display, ThePlainChainWritesTheBitsOfThePlainWriter) {
    auto const chain = post::make_display_chain({}, {});
    EXPECT_EQ(chain.description, "view standard, display sRGB");
    for (int channels : {1, 2, 3, 4})
        for (char const* ending : {".png", ".tif"}) {
            std::string const a = ::testing::TempDir() + "weft_plain" + ending;
            std::string const b = ::testing::TempDir() + "weft_shown" + ending;
            image::Image const image = test_image(channels);
            image::write_image(a, image);
            post::write_picture(b, image, chain, {});
            image::Image const x = image::read_image(a), y = image::read_image(b);
            EXPECT_EQ(x.channels, y.channels);
            EXPECT_EQ(x.pixels, y.pixels) << channels << ending;
        }
    image::Image const image = test_image(4);
    std::string const a = ::testing::TempDir() + "weft_plain.jpg";
    std::string const b = ::testing::TempDir() + "weft_shown.jpg";
    image::write_image(a, image);
    post::write_picture(b, image, chain, {});
    EXPECT_EQ(image::read_image(a).pixels, image::read_image(b).pixels);
}

TEST(Display, LinearFilesAreLeftAlone) {
    scene::Display display;
    display.exposure = 3;
    display.view = "agx";
    auto const chain = post::make_display_chain(display, {});
    for (char const* ending : {".exr", ".hdr"}) {
        std::string const a = ::testing::TempDir() + "weft_plain" + ending;
        std::string const b = ::testing::TempDir() + "weft_shown" + ending;
        image::Image const image = test_image(3);
        image::write_image(a, image, {{"Software", "a test"}});
        post::write_picture(b, image, chain, {{"Software", "a test"}});
        EXPECT_EQ(bytes_of(a), bytes_of(b)) << ending;
    }
}

TEST(Display, FilesSayWhatTheyShow) {
    scene::Display display;
    display.exposure = -0.5f;
    display.temperature = 3200;
    display.view = "aces";
    auto const chain = post::make_display_chain(display, {});
    for (char const* ending : {".png", ".jpg", ".tif"}) {
        std::string const path = ::testing::TempDir() + "weft_says" + ending;
        post::write_picture(path, test_image(3), chain, {{"Software", "a test"}});
        auto const found = image::read_metadata(path);
        ASSERT_TRUE(found.contains("ImageDescription")) << ending;
        EXPECT_EQ(found.at("ImageDescription"),
                  "exposure -0.5 stops, white 3200 K, view aces, display sRGB");
    }
}

TEST(Display, ExposureIsInStops) {
    scene::Display display;
    display.exposure = 2;
    image::Image image = image::make_image(1, 1, 3);
    image.pixels = {0.1f, 0.2f, 0.05f};
    auto const shown = post::show(post::make_display_chain(display, {}), image, post::Alpha::keep);
    for (int c = 0; c < 3; ++c)
        EXPECT_FLOAT_EQ(shown.at(0, 0, c), linear_to_srgb(4 * image.at(0, 0, c)));
}

TEST(Display, LayersLeaveTheColoursToBeShown) {
    image::Image image = image::make_image(1, 1, 6);
    image.names = {"albedo.R", "B", "G", "R", "Z", "A"};
    image.pixels = {9, 0.1f, 0.2f, 0.3f, 9, 0.5f};
    auto const shown = post::show(post::make_display_chain({}, {}), image, post::Alpha::keep);
    ASSERT_EQ(shown.channels, 4);
    EXPECT_FLOAT_EQ(shown.at(0, 0, 0), linear_to_srgb(0.6f));
    EXPECT_FLOAT_EQ(shown.at(0, 0, 2), linear_to_srgb(0.2f));
    EXPECT_EQ(shown.at(0, 0, 3), 0.5f);
    image.names = {"a", "b", "c", "d", "e", "f"};
    EXPECT_THROW(post::show(post::make_display_chain({}, {}), image, post::Alpha::keep),
                 InputError);
}

TEST(Display, GreyTakesColourOnlyFromTheChain) {
    image::Image image = image::make_image(1, 1, 1);
    image.pixels = {0.4f};
    scene::Display display;
    display.view = "agx";
    EXPECT_EQ(post::show(post::make_display_chain(display, {}), image, post::Alpha::keep).channels,
              1);
    display.temperature = 3000;
    auto const shown = post::show(post::make_display_chain(display, {}), image, post::Alpha::keep);
    EXPECT_EQ(shown.channels, 3);
    EXPECT_GT(shown.at(0, 0, 2), shown.at(0, 0, 0));
}

TEST(Display, MistakesAreLocated) {
    ::unsetenv("OCIO");
    scene::Display display;
    display.view = "agxx";
    EXPECT_EQ(message_of(display, {"s.xml", 3, 7}),
              "s.xml:3:7: no view is called 'agxx' (did you mean 'agx'?); views of an OpenColorIO "
              "configuration need 'ocio' or $OCIO");
    display = {};
    display.display = "sRGB";
    EXPECT_EQ(message_of(display), "'display' expects an OpenColorIO configuration, found neither "
                                   "'ocio' nor $OCIO");
    display = {};
    display.temperature = 900;
    EXPECT_EQ(message_of(display),
              "'temperature' expects at least 1500, or 0 for no white balance, found '900'");
    display = {};
    display.tint = 5;
    EXPECT_NE(message_of(display).find("expected a temperature, found none"), std::string::npos);
    display = {};
    display.neutral = Color(0);
    EXPECT_NE(message_of(display).find("found black"), std::string::npos);
    display.neutral = {1, 0.5f, 0.2f};
    display.temperature = 3000;
    EXPECT_NE(message_of(display).find("found both"), std::string::npos);
}
