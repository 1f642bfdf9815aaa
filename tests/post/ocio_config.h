// A small OpenColorIO configuration for tests, of transforms that the library has built in.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace weft::testing {

/// Its linear Rec. 709 space is called `linear_name`; the scene's reference is ACES2065-1.
inline std::string ocio_config_text(std::string const& linear_name, bool interchange) {
    std::string const roles = interchange
                                  ? "  aces_interchange: ACES2065-1\n  scene_linear: ACEScg\n"
                                  : "  scene_linear: " + linear_name + "\n";
    return "ocio_profile_version: 2\n"
           "roles:\n" +
           roles +
           "  default: Raw\n"
           "displays:\n"
           "  sRGB:\n"
           "    - !<View> {name: ACES SDR, view_transform: SDR, display_colorspace: sRGB screen}\n"
           "    - !<View> {name: Raw, colorspace: Raw}\n"
           "  Projector:\n"
           "    - !<View> {name: ACES SDR, view_transform: SDR, display_colorspace: P3 screen}\n"
           "active_displays: [sRGB, Projector]\n"
           "active_views: [ACES SDR, Raw]\n"
           "view_transforms:\n"
           "  - !<ViewTransform>\n"
           "    name: SDR\n"
           "    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - "
           "ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}\n"
           "display_colorspaces:\n"
           "  - !<ColorSpace>\n"
           "    name: sRGB screen\n"
           "    from_display_reference: !<BuiltinTransform> {style: DISPLAY - "
           "CIE-XYZ-D65_to_sRGB}\n"
           "  - !<ColorSpace>\n"
           "    name: P3 screen\n"
           "    from_display_reference: !<BuiltinTransform> {style: DISPLAY - "
           "CIE-XYZ-D65_to_G2.6-P3-D65}\n"
           "colorspaces:\n"
           "  - !<ColorSpace> {name: ACES2065-1}\n"
           "  - !<ColorSpace>\n"
           "    name: ACEScg\n"
           "    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}\n"
           "  - !<ColorSpace>\n"
           "    name: " +
           linear_name +
           "\n"
           "    from_scene_reference: !<GroupTransform>\n"
           "      children:\n"
           "        - !<MatrixTransform> {matrix: [0.4396329819, 0.3829886982, 0.1773783199, 0, "
           "0.0897764430, 0.8134394287, 0.0967841283, 0, 0.0175411704, 0.1115465533, "
           "0.8709122763, 0, 0, 0, 0, 1], direction: inverse}\n"
           "  - !<ColorSpace> {name: Raw, isdata: true}\n";
}

/// The file of that configuration, in the tests' temporary folder.
inline std::string write_ocio_config(std::string const& linear_name, bool interchange) {
    std::string const path =
        ::testing::TempDir() + "weft_" + linear_name + (interchange ? "_aces" : "") + ".ocio";
    std::ofstream(path) << ocio_config_text(linear_name, interchange);
    return path;
}

} // namespace weft::testing
