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

/// Mean square of the relative errors of the pixels of a block.
double mean_square_error(film::Film const& film, film::Region const& block, double darkest) {
    double sum = 0;
    for_pixels(block, [&](int x, int y) {
        film::Film::Counts const n = film.counts(x, y);
        if (n.even == 0 || n.even == n.all) return;
        Color const half = (film.even_mean(x, y) - film.odd_mean(x, y)) * 0.5f;
        double const square = brightness(half * half);
        double const base = std::max(brightness(film.mean(x, y)), darkest);
        if (square > 0) sum += square / (base * base);
    });
    return sum / double(block.pixels());
}

} // namespace

film::Region BlockGrid::block(size_t index) const {
    int const x = region.from.x + int(index % size_t(columns)) * kBlock,
              y = region.from.y + int(index / size_t(columns)) * kBlock;
    return {{x, y}, {std::min(x + kBlock, region.to.x), std::min(y + kBlock, region.to.y)}};
}

double typical_brightness(film::Film const& film) {
    double sum = 0;
    for_pixels(film.region(),
               [&](int x, int y) { sum += std::sqrt(std::max(0.0, brightness(film.mean(x, y)))); });
    double const mean = sum / double(film.region().pixels());
    return mean * mean;
}

std::vector<float> block_errors(film::Film const& film) {
    double const darkest = kDarkest * typical_brightness(film);
    BlockGrid const grid(film.region());
    std::vector<float> errors(grid.size());
    for (size_t i = 0; i < errors.size(); ++i)
        errors[i] = float(std::sqrt(mean_square_error(film, grid.block(i), darkest)));
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
