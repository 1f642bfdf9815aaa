// Which channels a film has, what they are called, and where each lies in a pixel's record.
//
// A pixel's sums start with the beauty (3 numbers); what else is asked for follows in the order of
// `Aov`. Names follow OpenEXR's and the habits of Arnold and Cycles: R G B A, Z, P, N for what
// every program knows, LAYER.R or LAYER.X for the rest; docs/aovs.md has the list.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "scene/aov.h"

namespace weft::film {

using scene::Aov;
inline constexpr size_t kAovCount = scene::kAovs.size();

using scene::kDefaultGroup;

struct LayoutOptions {
    bool half_sums = false; ///< beauty of the even samples, for error estimates
    bool squares = false;   ///< of the beauty's samples
    int cryptomatte_levels = 6;
    std::vector<std::string> light_groups{kDefaultGroup}, layers{kDefaultGroup};

    friend bool operator==(LayoutOptions const&, LayoutOptions const&) = default;
};

class Layout {
  public:
    /// Beauty alone.
    Layout() : Layout({}, {}) {}
    /// Beauty and `aovs`, in any order and number. `variance` brings squares.
    Layout(std::span<Aov const> aovs, LayoutOptions options);

    bool has(Aov aov) const { return there_[size_t(aov)]; }
    /// Whether samples bring more than beauty, in a SampleRecord.
    bool needs_record() const {
        return sums_ > first_recorded_ || has_nearest_ || has_cryptomatte_;
    }
    /// Whether the light of a path is told apart by where it came from and how.
    bool has_light() const { return has_light_; }
    /// Whether anything is asked of the surfaces that a path meets first.
    bool has_surface() const { return has_surface_; }
    bool has_nearest() const { return has_nearest_; }
    bool has_cryptomatte() const { return has_cryptomatte_; }

    /// The first of a summed AOV's numbers in a record; -1 where it is not there or not summed.
    int offset(Aov aov) const { return offsets_[size_t(aov)]; }
    /// How many numbers it sums: those of each picture, where it has one per name.
    int summed(Aov aov) const;
    int half_offset() const { return options_.half_sums ? 3 : -1; }
    /// Of the squares of all samples; those of the even ones follow, where there are half sums.
    int squares_offset() const { return options_.squares ? (options_.half_sums ? 6 : 3) : -1; }
    /// Where the numbers begin that a SampleRecord hands over; what comes before is beauty's.
    int first_recorded() const { return first_recorded_; }
    int sums() const { return sums_; } ///< doubles per pixel
    LayoutOptions const& options() const { return options_; }
    std::vector<Aov> aovs() const; ///< in the order of `Aov`, beauty first

    /// Names in a file, in the order in which `Film::image` gives them.
    std::vector<std::string> channel_names() const;

    friend bool operator==(Layout const&, Layout const&) = default;

  private:
    LayoutOptions options_;
    std::array<bool, kAovCount> there_{};
    std::array<int, kAovCount> offsets_{};
    int sums_ = 0, first_recorded_ = 0;
    bool has_light_ = false, has_surface_ = false, has_nearest_ = false, has_cryptomatte_ = false;
};

/// How many numbers a summed AOV has, or each of its pictures by name; 0 where it is not summed.
int summed_numbers(Aov aov);

/// What a Cryptomatte AOV is called in a file, "CryptoObject"; "" for any other.
std::string cryptomatte_name(Aov aov);

} // namespace weft::film
