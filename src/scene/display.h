// How a picture is shown: the way from scene-linear radiance to the numbers of a screen.
//
// The chain has one order: exposure, white balance, view. The view is a tone curve and the
// screen's encoding: one of Weft's own, or any view of an OpenColorIO configuration. It applies
// where a picture is written for a screen (PNG, JPEG, TIFF); EXR and HDR files stay scene-linear.
#pragma once

#include <string>

#include "base/color.h"
#include "schema/describe.h"

namespace weft::scene {

struct Display {
    static constexpr schema::TypeInfo info{
        .category = "display",
        .type = "",
        .help = "How a picture is shown where it is written as PNG, JPEG or TIFF: exposure, then "
                "white balance, then the view. EXR and HDR files stay scene-linear.",
        .example = "<image id=\"picture\"><display exposure=\"0.5\" temperature=\"3200\" "
                   "view=\"agx\"/></image>"};
    float exposure = 0;
    float temperature = 0;
    float tint = 0;
    Color neutral{1};
    std::string view;
    schema::FileName ocio;
    std::string display;
    std::string input_space;

    template <class F>
    constexpr void describe(F&& f) {
        f("exposure", exposure,
          {.unit = "stops",
           .min = -64,
           .max = 64,
           .soft_max = 8,
           .help = "Light times 2^exposure."});
        f("temperature", temperature,
          {.unit = "K",
           .min = 0,
           .max = 40000,
           .soft_max = 12000,
           .help = "White balance: the light of a black body of this temperature becomes neutral "
                   "grey (Bradford adaptation). At least 1500; 0 is none."});
        f("tint", tint,
          {.min = -150,
           .max = 150,
           .help = "How far the light that `temperature` names lies beside the black bodies: "
                   "positive is greener, so that the picture becomes more magenta. In steps of "
                   "1/3000 of the CIE 1960 (u, v) plane, as in raw converters; D65 is 6504 K with "
                   "a tint of 9.6."});
        f("neutral", neutral,
          {.min = 0,
           .help = "White balance by a colour of the picture (scene-linear) that should be grey; "
                   "its brightness does not matter. Only without `temperature`."});
        f("view", view,
          {.help = "`standard` (clipped at 1; the default), `agx` (a film-like curve that keeps "
                   "colours from turning garish as they brighten) or `aces` (contrast of the ACES "
                   "output transform); with `ocio` or $OCIO a view of that configuration, by "
                   "default the display's first."});
        f("ocio", ocio,
          {.help = "An OpenColorIO configuration, whose views are then meant. Without it, $OCIO "
                   "is asked for views that Weft does not have."});
        f("display", display,
          {.help = "The configuration's display; by default its first. Weft's own views are for "
                   "sRGB."});
        f("inputSpace", input_space,
          {.help = "The configuration's name for linear light with Rec. 709 primaries, where it "
                   "is none of the usual; otherwise found."});
    }
};

} // namespace weft::scene
