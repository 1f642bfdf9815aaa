// The picture while it is made: per pixel the sums of its samples, of all channels that the layout
// has, and their number. Sums are kept in double and every pixel adds its samples in their order,
// so the result does not depend on threads and tiles.
//
// Depth, position and texture coordinates are not averaged, for a mean of two surfaces lies on
// neither: they are those of the sample whose surface is nearest. Cryptomattes count samples by id.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "film/sample_record.h"
#include "image/image.h"

namespace weft::film {

/// A region of pixels: lower corner included, upper corner excluded.
struct Region {
    Vec2i from{0, 0}, to{0, 0};
    int width() const { return to.x - from.x; }
    int height() const { return to.y - from.y; }
    size_t pixels() const { return size_t(width()) * size_t(height()); }
    bool contains(Region const& r) const {
        return r.from.x >= from.x && r.from.y >= from.y && r.to.x <= to.x && r.to.y <= to.y;
    }
};

/// Stands in the depth channel where there is no surface, as in Cycles.
inline constexpr float kNoDepth = 1e10f;

class Film {
  public:
    Film() = default;
    explicit Film(Region const& region, Layout const& layout = {});

    Region const& region() const { return region_; }
    Layout const& layout() const { return layout_; }

    /// Adds sample number `index` of a pixel. `x`, `y` count from the corner of the whole picture.
    /// `record` is of the same layout, and finished; it may be null where the layout needs none.
    /// Different pixels may be added to at the same time.
    void add(int x, int y, uint32_t index, Color const& beauty, SampleRecord const* record) {
        size_t const i = pixel_index(x, y);
        double* const sums = &sums_[i * size_t(layout_.sums())];
        sums[0] += double(beauty.r);
        sums[1] += double(beauty.g);
        sums[2] += double(beauty.b);
        ++counts_[i].all;
        if (has_more_) add_more(i, index, beauty, record);
    }

    /// How many samples a pixel has, and how many of them have an even number (0 where the layout
    /// has no half sums).
    struct Counts {
        uint32_t all = 0, even = 0;
        friend bool operator==(Counts const&, Counts const&) = default;
    };
    Counts counts(int x, int y) const { return counts_[pixel_index(x, y)]; }
    /// Returns the number of samples of the pixel that has fewest.
    uint32_t least_samples() const;

    /// Return the mean of the beauty's samples, of those with even numbers, and of those with odd
    /// ones; black where there is none. The latter two need a layout with half sums.
    Color mean(int x, int y) const;
    Color even_mean(int x, int y) const;
    Color odd_mean(int x, int y) const;
    /// Returns the variance of the pixel's mean: s^2 / n of n samples, as if they were independent.
    /// That of stratified samples is smaller. 0 for fewer than 2 samples. Needs a layout with
    /// squares.
    Color variance(int x, int y) const;
    /// Estimates the error of the mean from its two halves, which see the effect of stratification:
    /// sum |mean - even mean| / sqrt(sum mean) over the channels (Dammertz et al. 2010, "A
    /// hierarchical automatic stopping condition for Monte Carlo global illumination"). 0 where
    /// there is an empty half. The estimate of a single pixel is noisy: take it over several.
    float error(int x, int y) const;

    /// Returns the beauty, RGB.
    image::Image mean() const;
    /// Returns all channels, called by layout().channel_names().
    image::Image image() const;

    /// Adds the samples of `part`, which are others than this film has. Throws InputError where the
    /// layouts differ or `part` has pixels outside of this film.
    void merge(Film const& part);

    /// Returns all that the film holds as bytes, of which `read_state` makes an equal film.
    std::string write_state() const;
    /// Makes a film of such bytes. Throws InputError where they are not what `write_state` wrote.
    static Film read_state(std::string_view bytes);

    /// Returns the bytes that a film of this layout takes for each pixel, Cryptomattes left out.
    static size_t bytes_per_pixel(Layout const& layout);

    friend bool operator==(Film const& a, Film const& b);

  private:
    /// The numbers of the sample whose surface is nearest to the camera (kNearestOffsets); the
    /// first, its depth, is infinite where there is none.
    struct Nearest {
        std::array<float, kNearestNumbers> numbers{std::numeric_limits<float>::infinity()};
        float depth() const { return numbers[0]; }
        friend bool operator==(Nearest const&, Nearest const&) = default;
    };
    struct IdCount {
        uint32_t id = 0, samples = 0;
        friend bool operator==(IdCount const&, IdCount const&) = default;
    };
    using IdCounts = std::vector<IdCount>;

    size_t pixel_index(int x, int y) const {
        return size_t(y - region_.from.y) * size_t(region_.width()) + size_t(x - region_.from.x);
    }
    void add_more(size_t pixel, uint32_t index, Color const& beauty, SampleRecord const* record);
    static void count_id(IdCounts& counts, uint32_t id, uint32_t samples);
    double const* sums(size_t pixel) const { return &sums_[pixel * size_t(layout_.sums())]; }
    Color variance(size_t pixel) const;
    void write_pixel(size_t pixel, float* to) const;
    float* write_aov(size_t pixel, Aov aov, float* to) const;
    float* write_cryptomatte(IdCounts const& counts, double samples, float* to) const;

    Region region_;
    Layout layout_;
    bool has_more_ = false; ///< than the beauty's sum
    std::vector<double> sums_;
    std::vector<Counts> counts_;
    std::vector<Nearest> nearest_;                         ///< empty where not wanted
    std::array<std::vector<IdCounts>, kCryptomattes> ids_; ///< likewise; by ascending id
};

} // namespace weft::film
