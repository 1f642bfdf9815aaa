// The picture while it is made: per pixel the sum of its samples and their number. Sums are kept
// in double and every pixel adds its samples in their order, so the result does not depend on
// who computes what when.
#pragma once

#include <cstdint>
#include <vector>

#include "base/color.h"
#include "base/vec.h"
#include "image/image.h"

namespace weft::film {

/// A region of pixels: lower corner included, upper corner excluded.
struct Region {
    Vec2i from{0, 0}, to{0, 0};
    int width() const { return to.x - from.x; }
    int height() const { return to.y - from.y; }
};

struct PixelSum {
    double r = 0, g = 0, b = 0;
    uint32_t samples = 0;

    void add(Color const& c) {
        r += double(c.r);
        g += double(c.g);
        b += double(c.b);
        ++samples;
    }
};

class Film {
  public:
    explicit Film(Region const& region)
        : region_(region), pixels_(size_t(region.width()) * size_t(region.height())) {}

    Region const& region() const { return region_; }
    /// `x`, `y` count from the corner of the whole picture.
    PixelSum& pixel(int x, int y) {
        return pixels_[size_t(y - region_.from.y) * size_t(region_.width()) +
                       size_t(x - region_.from.x)];
    }
    /// The number of samples of the pixel that has fewest.
    uint32_t least_samples() const;
    /// The mean of each pixel's samples, RGB; black where there is none yet.
    image::Image mean() const;

  private:
    Region region_;
    std::vector<PixelSum> pixels_;
};

} // namespace weft::film
