// Smaller copies of an image (Williams 1983): each level has half the texels of the one before
// along either axis, rounded down, and holds means of linear values, encoded as the image is.
#pragma once

#include <span>
#include <vector>

#include "image/texel.h"

namespace weft::image {

/// The size of a level, and where its texels start in a block of memory.
struct MipLevel {
    int width = 0, height = 0;
    size_t offset = 0; ///< bytes
};

/// The size of the next smaller level.
constexpr int half_size(int size) { return size > 1 ? size / 2 : 1; }
/// Levels down to a single texel.
int level_count(int width, int height);

/// The mean of the linear values that each texel of the next smaller level covers (of an odd number
/// of texels the outer ones count in part). Rows are asked for and handed out one by one, so that
/// an image need not be in memory.
class LevelReducer {
  public:
    LevelReducer(TexelFormat format, int width, int height);

    int width() const { return half_size(width_); }
    int height() const { return half_size(height_); }
    /// Rows [first, end) of the larger level that row `y` of the smaller one is made of.
    int first_row(int y) const { return vertical_[size_t(y)].first; }
    int end_row(int y) const { return first_row(y) + vertical_[size_t(y)].count; }
    /// Writes row `y`; `row(i)` is a pointer to the texels of row `i` of the larger level. May be
    /// called by several threads at once.
    template <class Row>
    void reduce_row(int y, Row const& row, std::byte* out) const {
        Taps const& taps = vertical_[size_t(y)];
        std::byte const* rows[3];
        for (int k = 0; k < taps.count; ++k) rows[k] = row(taps.first + k);
        reduce(taps, rows, out);
    }

  private:
    struct Taps {
        int first = 0, count = 0;
        float weight[3] = {};
    };
    static std::vector<Taps> make_taps(int size);
    void reduce(Taps const& taps, std::byte const* const* rows, std::byte* out) const;
    void encode(float const* values, int count, std::byte* out) const;

    TexelFormat format_;
    int width_, height_;
    std::span<float const> table_;
    std::vector<Taps> horizontal_, vertical_;
};

} // namespace weft::image
