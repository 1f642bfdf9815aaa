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

/// Makes the chain that `display` describes. Throws InputError, at `where`, for what
/// white_balance.h and ocio_view.h refuse, for a view that is neither Weft's nor in the
/// configuration (`display.ocio` or $OCIO), and for a display where there is no configuration.
DisplayChain make_display_chain(scene::Display const& display, SourceLocation const& where);

/// What to do with colours that are premultiplied by an alpha: divide by it and keep it, or show
/// them as they are, over black, and drop it.
enum class Alpha { keep, drop };

/// Shows a linear image. The result `is_srgb_encoded`: numbers for a screen in [0, 1], colours not
/// premultiplied. It has the channels Y, YA, RGB or RGBA; grey remains grey unless the chain gives
/// it a colour (white balance, OpenColorIO). Of an image with other channels, the colours of
/// image::find_colors and their alpha are shown, or Y; throws InputError where more than four have
/// none of these names.
image::Image show(DisplayChain const& chain, image::Image const& image, Alpha alpha);

/// Writes a picture. Files for screens get what the chain makes of it, and the chain's description
/// in their header ("ImageDescription"); all others are written as `image::write_image` does.
void write_picture(std::string const& path, image::Image const& image, DisplayChain const& chain,
                   image::Metadata metadata);

} // namespace weft::post
