// A view of an OpenColorIO configuration (v1 or v2), applied on the CPU.
//
// The picture's linear Rec. 709 light enters by the configuration's colour space for it, where one
// has a usual name or alias ("lin_rec709", "Utility - Linear - sRGB", "Linear Rec.709", ...); else
// by the role `aces_interchange` after a matrix to ACES2065-1; else by the role `scene_linear`,
// which is then a guess that `warning` tells of. Numbers come out as the display wants them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/color.h"
#include "base/error.h"

namespace weft::post {

/// Names a view; an empty name is the configuration's default.
struct OcioChoice {
    std::string config; ///< path of a file
    std::string display, view;
    std::string input_space;
};

class OcioView {
  public:
    /// Throws InputError, with the nearest name, where there is no such file, display, view or
    /// colour space, or where a file is missing that the view needs.
    explicit OcioView(OcioChoice const& choice);

    /// Shows `count` linear pixels of RGB, in place. A value that is not a number is taken for 0.
    void apply(float* rgb, size_t count) const;

    std::string const& display() const { return display_; }
    std::string const& view() const { return view_; }
    std::string const& input_space() const { return input_space_; } ///< a colour space or a role
    std::string const& warning() const { return warning_; }         ///< "" where there is none

  private:
    struct Processor;
    std::shared_ptr<Processor const> processor_;
    std::string display_, view_, input_space_, warning_;
};

/// A display that a configuration has, and its views in the configuration's order, the default
/// first.
struct OcioDisplay {
    std::string name;
    std::vector<std::string> views;
};
/// Returns the displays of a configuration, the default first. Throws InputError where the file
/// cannot be read.
std::vector<OcioDisplay> ocio_displays(std::string const& config);

} // namespace weft::post
