#include "shading/noise.h"

#include "base/hash.h"

namespace weft::shading {

namespace {

/// The whole number below x, and what is left. Beyond 1e9 floats have no fraction to tell apart.
struct Cell {
    int32_t i;
    float f;
    explicit Cell(float x) {
        float const below = std::floor(std::clamp(x, -1e9f, 1e9f));
        i = int32_t(below);
        f = std::clamp(x - below, 0.f, 1.f);
    }
};

uint32_t cell_hash(int32_t x, uint32_t rest) { return hash32(uint32_t(x) + rest); }

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Dot product with one of the 12 edges of a cube, 4 of them twice.
float gradient(uint32_t hash, float x, float y, float z) {
    uint32_t const h = hash & 15;
    float const u = h < 8 ? x : y;
    float const v = h < 4 ? y : h == 12 || h == 14 ? x : z;
    return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

/// Dot product with one of 8 directions: (+-1, +-2) and (+-2, +-1).
float gradient(uint32_t hash, float x, float y) {
    uint32_t const h = hash & 7;
    float const u = h < 4 ? x : y, v = 2 * (h < 4 ? y : x);
    return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

} // namespace

float perlin_noise(Vec2 p) {
    Cell const x(p.x), y(p.y);
    float const u = fade(x.f), v = fade(y.f);
    auto row = [&](int j) {
        uint32_t const rest = hash32(uint32_t(y.i + j));
        float const dy = y.f - float(j);
        return lerp(gradient(cell_hash(x.i, rest), x.f, dy),
                    gradient(cell_hash(x.i + 1, rest), x.f - 1, dy), u);
    };
    return 0.6616f * lerp(row(0), row(1), v);
}

float perlin_noise(Vec3 const& p) {
    Cell const x(p.x), y(p.y), z(p.z);
    float const u = fade(x.f), v = fade(y.f), w = fade(z.f);
    auto row = [&](uint32_t slice, int j, float dz) {
        uint32_t const rest = cell_hash(y.i + j, slice);
        float const dy = y.f - float(j);
        return lerp(gradient(cell_hash(x.i, rest), x.f, dy, dz),
                    gradient(cell_hash(x.i + 1, rest), x.f - 1, dy, dz), u);
    };
    auto slice = [&](int k) {
        uint32_t const rest = hash32(uint32_t(z.i + k));
        float const dz = z.f - float(k);
        return lerp(row(rest, 0, dz), row(rest, 1, dz), v);
    };
    return 0.9820f * lerp(slice(0), slice(1), w);
}

float cell_noise(Vec2 p) {
    return to_unit_float(cell_hash(Cell(p.x).i, hash32(uint32_t(Cell(p.y).i))));
}

float cell_noise(Vec3 const& p) {
    return to_unit_float(
        cell_hash(Cell(p.x).i, cell_hash(Cell(p.y).i, hash32(uint32_t(Cell(p.z).i)))));
}

namespace {

/// Keeps the two least of squared distances.
struct Nearest {
    float first = kInfinity, second = kInfinity;
    void add(float d2) {
        second = std::min(second, std::max(first, d2));
        first = std::min(first, d2);
    }
    WorleyDistances distances() const { return {std::sqrt(first), std::sqrt(second)}; }
};

/// Where along an axis the point of a cell is; another constant for each axis.
float place(uint32_t hash, uint32_t axis, float jitter) {
    return 0.5f + jitter * (to_unit_float(hash32(hash ^ axis)) - 0.5f);
}

} // namespace

WorleyDistances worley_noise(Vec2 p, float jitter) {
    Cell const x(p.x), y(p.y);
    Nearest nearest;
    for (int j = -1; j <= 1; ++j) {
        uint32_t const rest = hash32(uint32_t(y.i + j));
        for (int i = -1; i <= 1; ++i) {
            uint32_t const h = cell_hash(x.i + i, rest);
            float const dx = float(i) + place(h, 1, jitter) - x.f,
                        dy = float(j) + place(h, 2, jitter) - y.f;
            nearest.add(dx * dx + dy * dy);
        }
    }
    return nearest.distances();
}

WorleyDistances worley_noise(Vec3 const& p, float jitter) {
    Cell const x(p.x), y(p.y), z(p.z);
    Nearest nearest;
    for (int k = -1; k <= 1; ++k) {
        uint32_t const slice = hash32(uint32_t(z.i + k));
        for (int j = -1; j <= 1; ++j) {
            uint32_t const rest = cell_hash(y.i + j, slice);
            for (int i = -1; i <= 1; ++i) {
                uint32_t const h = cell_hash(x.i + i, rest);
                Vec3 const d(float(i) + place(h, 1, jitter) - x.f,
                             float(j) + place(h, 2, jitter) - y.f,
                             float(k) + place(h, 3, jitter) - z.f);
                nearest.add(length_squared(d));
            }
        }
    }
    return nearest.distances();
}

} // namespace weft::shading
