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

/// Which view; an empty name is the configuration's default.
struct OcioChoice {
    std::string config; ///< path of a file
    std::string display, view;
    std::string input_space;
};

class OcioView {
  public:
    /// Throws InputError, with the nearest name, where the file, the display, the view or the
    /// colour space is not there, or what the view needs (a table in a file) is not.
    explicit OcioView(OcioChoice const& choice);

    /// `count` linear pixels of RGB, in place. Values that are not numbers give those of black.
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

/// What a configuration has, in its order, the default first.
struct OcioDisplay {
    std::string name;
    std::vector<std::string> views;
};
/// Throws InputError where the file cannot be read.
std::vector<OcioDisplay> ocio_displays(std::string const& config);

} // namespace weft::post
