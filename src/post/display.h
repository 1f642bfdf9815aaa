// The display chain (scene/display.h), ready to be applied: exposure and white balance, both
// linear, and then the view.
//
// Left out: wide-gamut and HDR screens as targets of Weft's own views, 16-bit files, and dithering.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "base/error.h"
#include "image/write.h"
#include "post/ocio_view.h"
#include "post/white_balance.h"
#include "scene/display.h"

namespace weft::post {

struct StandardView {};
struct AgxView {};
struct AcesView {};
using View = std::variant<StandardView, AgxView, AcesView, OcioView>;

struct DisplayChain {
    float gain = 1;                     ///< 2^exposure
    std::optional<ColorMatrix> balance; ///< none where no white balance is asked for
    View view;
    std::string description; ///< "exposure 1 stops, view agx, display sRGB"
    std::string warning;     ///< "" where there is none
};

/// Throws InputError, at `where`, for what white_balance.h and ocio_view.h refuse, for a view that
/// is neither Weft's nor that of `display.ocio` or $OCIO, and for a display without a
/// configuration.
DisplayChain make_display_chain(scene::Display const& display, SourceLocation const& where);

/// What becomes of colours that are premultiplied by an alpha: they are shown by themselves and
/// the alpha is kept, or they are shown as they are, over black, and it is dropped.
enum class Alpha { keep, drop };

/// Shows a linear image. The result `is_srgb_encoded`: numbers for a screen in [0, 1], colours not
/// premultiplied. It has the channels Y, YA, RGB or RGBA; grey remains grey unless the chain gives
/// it a colour (white balance, OpenColorIO). Of an image with other channels, R, G, B and A are
/// shown; throws InputError where more than four have none of these names.
image::Image show(DisplayChain const& chain, image::Image const& image, Alpha alpha);

/// Writes through the chain where the file is for screens, with the chain's description in its
/// header ("ImageDescription"); and else as `image::write_image` does.
void write_picture(std::string const& path, image::Image const& image, DisplayChain const& chain,
                   image::Metadata metadata);

} // namespace weft::post
