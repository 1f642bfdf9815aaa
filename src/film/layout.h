// Which channels a film has, what they are called, and where each lies in a pixel's record.
//
// All of it follows from the table of AOVs (scene/aov.h). A pixel's sums start with the beauty (3
// numbers); what else is asked for follows in the order of the table. Names follow OpenEXR's and
// the habits of Arnold and Cycles: R G B A, Z, P, N for what every program knows, LAYER.R or
// LAYER.X for the rest; docs/aovs.md has the list.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "scene/aov.h"

namespace weft::film {

using scene::Accumulation;
using scene::Aov;
using scene::AovSource;
using scene::kAovCount;
using scene::kDefaultGroup;

/// The AOVs that are Cryptomattes, in the order of the table.
inline constexpr auto kCryptomatteAovs = [] {
    std::array<Aov, scene::count_of(Accumulation::Ids)> aovs{};
    size_t i = 0;
    for (scene::AovInfo const& info : scene::kAovs)
        if (info.how == Accumulation::Ids) aovs[i++] = info.aov;
    return aovs;
}();
inline constexpr size_t kCryptomattes = kCryptomatteAovs.size();

/// Returns the place of a Cryptomatte in kCryptomatteAovs.
constexpr size_t cryptomatte_index(Aov aov) {
    size_t i = 0;
    while (kCryptomatteAovs[i] != aov) ++i;
    return i;
}

/// What a film keeps of the sample whose surface is nearest: the numbers of all AOVs of that kind,
/// in the order of the table. The first is the depth, by which surfaces are compared.
inline constexpr auto kNearestOffsets = [] {
    std::array<int, kAovCount + 1> offsets{};
    for (size_t i = 0; i < kAovCount; ++i) {
        scene::AovInfo const& info = scene::kAovs[i];
        offsets[i + 1] = offsets[i] + (info.how == Accumulation::Nearest ? info.channels() : 0);
    }
    return offsets;
}();
inline constexpr size_t kNearestNumbers = size_t(kNearestOffsets.back());
static_assert(kNearestOffsets[size_t(Aov::depth)] == 0);

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
    /// Beauty and `aovs`, in any order and number. `variance` brings squares, and a denoiser's
    /// guides bring `denoise_kept`.
    Layout(std::span<Aov const> aovs, LayoutOptions options);

    bool has(Aov aov) const { return there_[size_t(aov)]; }
    /// Returns whether samples bring more than beauty, in a SampleRecord.
    bool needs_record() const {
        return sums_ > first_recorded_ || has_nearest_ || has_cryptomatte_;
    }
    /// Returns whether the light of a path is told apart by where it came from and how.
    bool has_light() const { return has_light_; }
    /// Returns whether anything is asked of the surfaces that a path meets first.
    bool has_surface() const { return has_surface_; }
    bool has_nearest() const { return has_nearest_; }
    bool has_cryptomatte() const { return has_cryptomatte_; }

    /// Returns where the numbers of a summed AOV begin among a pixel's sums; -1 where it is not
    /// there or not summed.
    int offset(Aov aov) const { return offsets_[size_t(aov)]; }
    /// Returns how many numbers of an AOV are summed, those of all its pictures together.
    int summed(Aov aov) const;
    int half_offset() const { return options_.half_sums ? 3 : -1; }
    /// Returns where the sums of the squares of all samples begin; those of the even ones follow,
    /// where there are half sums.
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

} // namespace weft::film
