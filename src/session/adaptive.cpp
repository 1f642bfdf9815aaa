#include "session/adaptive.h"

#include <algorithm>
#include <cmath>

namespace weft::session {

namespace {

double brightness(Color const& c) { return (double(c.r) + double(c.g) + double(c.b)) / 3; }

template <class Visit>
void for_pixels(film::Region const& r, Visit const& visit) {
    for (int y = r.from.y; y < r.to.y; ++y)
        for (int x = r.from.x; x < r.to.x; ++x) visit(x, y);
}

/// The squares of the relative errors of the pixels of a block.
struct Squares {
    double sum = 0, of_squares = 0, pixels = 0;

    bool made_by_few() const { return sum * sum < kFew * pixels * of_squares; }
};

/// What the error of a pixel is divided by. Both are brightness.
double error_unit(double pixel, double typical) {
    double const b = std::max(pixel, kDarkest * typical);
    return std::max(b, std::sqrt(b * typical));
}

Squares squares_of(film::Film const& film, film::Region const& block, double typical) {
    Squares squares;
    squares.pixels = double(block.pixels());
    for_pixels(block, [&](int x, int y) {
        film::Film::Counts const n = film.counts(x, y);
        if (n.even == 0 || n.even == n.all) return;
        Color const even = film.even_mean(x, y), odd = film.odd_mean(x, y),
                    half = (even - odd) * 0.5f;
        double const absolute = brightness(half * half);
        double const unit = error_unit(std::min(brightness(even), brightness(odd)), typical);
        double const square = absolute > 0 ? absolute / (unit * unit) : 0;
        squares.sum += square;
        squares.of_squares += square * square;
    });
    return squares;
}

/// The mean square over the blocks at most `radius` blocks away, of those alone that few pixels
/// make.
double rare_mean(BlockGrid const& grid, std::vector<Squares> const& blocks, size_t middle,
                 int radius) {
    int const row = int(middle) / grid.columns, column = int(middle) % grid.columns;
    double sum = 0, pixels = 0;
    for (int r = std::max(0, row - radius); r <= std::min(grid.rows - 1, row + radius); ++r)
        for (int c = std::max(0, column - radius); c <= std::min(grid.columns - 1, column + radius);
             ++c) {
            Squares const& block = blocks[size_t(r * grid.columns + c)];
            if (block.made_by_few()) sum += block.sum;
            pixels += block.pixels;
        }
    return sum / pixels;
}

} // namespace

film::Region BlockGrid::block(size_t index) const {
    int const x = region.from.x + int(index % size_t(columns)) * kBlock,
              y = region.from.y + int(index / size_t(columns)) * kBlock;
    return {{x, y}, {std::min(x + kBlock, region.to.x), std::min(y + kBlock, region.to.y)}};
}

double typical_brightness(film::Film const& film, std::function<bool()> const& stop) {
    film::Region const& region = film.region();
    double sum = 0;
    for (int y = region.from.y; y < region.to.y; ++y) {
        if (stop()) return 0;
        for (int x = region.from.x; x < region.to.x; ++x)
            sum += std::sqrt(std::max(0.0, brightness(film.mean(x, y))));
    }
    double const mean = sum / double(region.pixels());
    return mean * mean;
}

std::vector<float> block_errors(film::Film const& film, std::function<bool()> const& stop) {
    double const typical = typical_brightness(film, stop);
    BlockGrid const grid(film.region());
    std::vector<float> errors(grid.size());
    std::vector<Squares> blocks;
    auto const stops_at = [&](size_t i) { return i % size_t(grid.columns) == 0 && stop(); };
    for (size_t i = 0; i < errors.size(); ++i) {
        if (stops_at(i)) return {};
        blocks.push_back(squares_of(film, grid.block(i), typical));
    }
    for (size_t i = 0; i < errors.size(); ++i) {
        if (stops_at(i)) return {};
        double square = blocks[i].sum / blocks[i].pixels;
        for (int radius : {1, 2, 4}) square = std::max(square, rare_mean(grid, blocks, i, radius));
        errors[i] = float(std::sqrt(square));
    }
    return errors;
}

std::vector<uint8_t> active_blocks(film::Film const& film, std::vector<float> const& errors,
                                   double noise, uint32_t limit) {
    BlockGrid const grid(film.region());
    std::vector<uint8_t> active(grid.size());
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            if (double(errors[size_t(row * grid.columns + column)]) <= noise) continue;
            for (int r = std::max(0, row - 1); r <= std::min(grid.rows - 1, row + 1); ++r)
                for (int c = std::max(0, column - 1); c <= std::min(grid.columns - 1, column + 1);
                     ++c)
                    active[size_t(r * grid.columns + c)] = 1;
        }
    for (size_t i = 0; i < active.size(); ++i) {
        Vec2i const corner = grid.block(i).from;
        if (film.counts(corner.x, corner.y).all >= limit) active[i] = 0;
    }
    return active;
}

double samples_needed(film::Film const& film, std::vector<float> const& errors, double noise,
                      uint32_t limit) {
    BlockGrid const grid(film.region());
    double needed = 0;
    for (size_t i = 0; i < errors.size(); ++i) {
        film::Region const block = grid.block(i);
        double const n = film.counts(block.from.x, block.from.y).all,
                     times = double(errors[i]) / noise;
        if (times > 1)
            needed += double(block.pixels()) *
                      std::min(n * (times * times - 1), std::max(0.0, limit - n));
    }
    return needed;
}

uint32_t adaptive_pass_end(uint32_t from, uint32_t limit) {
    uint32_t const to = from < kLeastSamples ? std::max(1u, 2 * from) : (from + from / 2 + 1) & ~1u;
    return std::min(to, limit);
}

} // namespace weft::session
