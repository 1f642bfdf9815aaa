#include "bench/assets.h"

#include <array>
#include <filesystem>
#include <fstream>

#include "base/color.h"
#include "base/hash.h"
#include "bench/mesh_file.h"
#include "image/write.h"

namespace weft::bench {

namespace {

float smooth(float t) { return t * t * (3 - 2 * t); }

/// Value noise in [0, 1] that repeats after `period` cells.
float noise(Vec2 p, uint32_t period, uint32_t seed) {
    float const x = std::floor(p.x), y = std::floor(p.y);
    auto corner = [&](uint32_t i, uint32_t j) {
        uint32_t const cx = (uint32_t(int(x)) + i) % period, cy = (uint32_t(int(y)) + j) % period;
        return to_unit_float(hash_combine(hash_combine(seed, cx), cy));
    };
    float const s = smooth(p.x - x), t = smooth(p.y - y);
    return lerp(lerp(corner(0, 0), corner(1, 0), s), lerp(corner(0, 1), corner(1, 1), s), t);
}

/// Five octaves of noise over the unit square, which it tiles.
float fractal(Vec2 uv, uint32_t cells, uint32_t seed) {
    float sum = 0, amplitude = 0.5f;
    for (uint32_t octave = 0; octave < 5; ++octave, cells *= 2, amplitude *= 0.5f)
        sum += amplitude * noise(uv * float(cells), cells, seed + octave);
    return sum;
}

/// A torus knot whose tube is ribbed and twisted, within a ball of radius 1.7.
Vec3 knot(Vec2 uv) {
    auto centre = [](float t) {
        float const r = 1 + 0.4f * std::cos(3 * t);
        return Vec3(r * std::cos(2 * t), 0.55f * std::sin(3 * t), r * std::sin(2 * t));
    };
    float const t = 2 * kPi * uv.x, a = 2 * kPi * uv.y;
    Vec3 const c = centre(t), along = normalize(centre(t + 1e-3f) - c);
    Vec3 const side = normalize(cross(along, c)), up = cross(side, along);
    float const radius =
        0.2f + 0.03f * std::sin(5 * a + 40 * t) + 0.012f * std::sin(90 * t) * std::sin(9 * a);
    return c + (side * std::cos(a) + up * std::sin(a)) * radius;
}

/// A weathered ball of radius about 1.
Vec3 boulder(Vec2 uv) {
    float const phi = 2 * kPi * uv.x, theta = kPi * (1 - uv.y);
    Vec3 const d(std::sin(theta) * std::cos(phi), std::cos(theta),
                 -std::sin(theta) * std::sin(phi));
    Vec3 q = d * 2.f;
    float bump = 0, amplitude = 0.12f;
    for (int octave = 0; octave < 6; ++octave, amplitude *= 0.5f) {
        bump += amplitude * std::sin(q.x + 1.3f * std::sin(q.y)) *
                std::sin(q.y + 1.7f * std::sin(q.z)) * std::sin(q.z + float(octave));
        q = Vec3(q.y + 0.4f * q.z, q.z - 0.4f * q.x, q.x + 0.4f * q.y) * 1.9f;
    }
    return d * (1 + bump);
}

/// A fluted, twisted vase on a foot, from y = -1 to 1.
Vec3 vase(Vec2 uv) {
    float const h = uv.y, phi = 2 * kPi * uv.x, turn = phi + 2.5f * h;
    float const profile =
        0.42f + 0.2f * std::sin(2 * kPi * (0.9f * h + 0.55f)) + 0.08f * std::cos(14 * h);
    float const flutes =
        1 + 0.06f * std::sin(16 * turn) + 0.012f * std::sin(80 * turn) * std::sin(120 * h);
    float const closing = std::sqrt(std::max(0.f, 1 - std::pow(std::abs(2 * h - 1), 24.f)));
    float const r = profile * flutes * closing;
    return {r * std::cos(phi), 2 * h - 1, -r * std::sin(phi)};
}

/// Stone slabs with worn joints.
Color floor_color(Vec2 uv) {
    Vec2 const slab = uv * 8.f;
    float const x = slab.x - std::floor(slab.x), y = slab.y - std::floor(slab.y);
    uint32_t const id =
        hash_combine(uint32_t(int(std::floor(slab.x))), uint32_t(int(std::floor(slab.y))));
    float const joint = std::min(std::min(x, 1 - x), std::min(y, 1 - y));
    float const grain = fractal(uv, 16, 7),
                wear = std::clamp((joint - 0.015f - 0.02f * grain) * 60, 0.f, 1.f);
    Color const stone =
        lerp(Color(0.46f, 0.36f, 0.27f), Color(0.62f, 0.58f, 0.5f), to_unit_float(id));
    return lerp(Color(0.08f), stone * (0.55f + 0.7f * grain), wear);
}

/// Glazed bands of two colours.
Color glaze_color(Vec2 uv) {
    float const band = std::sin(2 * kPi * (6 * uv.y + 0.8f * fractal(uv, 6, 21)));
    Color const c = lerp(Color(0.05f, 0.16f, 0.32f), Color(0.75f, 0.45f, 0.12f),
                         smooth(std::clamp(2 * band + 0.5f, 0.f, 1.f)));
    return c * (0.7f + 0.5f * fractal(uv, 32, 22));
}

Color roughness(Vec2 uv) { return Color(std::clamp(0.1f + 0.7f * fractal(uv, 12, 41), 0.f, 1.f)); }

/// A clear sky over dark ground with a sun of 2 degrees, the top row at the zenith.
Color sky(Vec2 uv) {
    float const elevation = kPi * (0.5f - uv.y), azimuth = 2 * kPi * uv.x;
    auto towards = [](float e, float a) {
        return Vec3(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
    };
    float const to_sun = dot(towards(elevation, azimuth), towards(radians(38), radians(250)));
    if (to_sun > std::cos(radians(1))) return Color(5000, 4500, 3700);
    if (elevation < 0) return Color(0.12f, 0.1f, 0.08f);
    float const haze = std::exp(-5 * std::sin(elevation));
    Color const blue = lerp(Color(0.12f, 0.28f, 0.75f), Color(0.75f, 0.82f, 0.9f), haze);
    float const cloud = smooth(std::clamp(3 * fractal(uv, 5, 61) - 1.3f, 0.f, 1.f)) * (1 - haze);
    return lerp(blue, Color(0.9f), cloud) +
           Color(1, 0.85f, 0.6f) * (2 * std::pow(std::max(to_sun, 0.f), 60.f));
}

/// Rust over lacquer and the like: patches of two colours, other ones for every number.
Color patches(Vec2 uv, uint32_t number) {
    auto hue = [&](uint32_t i) {
        return Color(to_unit_float(hash_combine(number, 3 * i)),
                     to_unit_float(hash_combine(number, 3 * i + 1)),
                     to_unit_float(hash_combine(number, 3 * i + 2)));
    };
    float const mask = smooth(std::clamp(6 * fractal(uv, 5, 100 + number) - 2.5f, 0.f, 1.f));
    return lerp(hue(0) * 0.8f, hue(1) * 0.5f, mask) * (0.7f + 0.5f * fractal(uv, 24, number));
}

template <class F>
image::Image paint(int width, int height, F const& color) {
    image::Image im = image::make_image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Color const c =
                color({(float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height)});
            for (int channel = 0; channel < 3; ++channel) im.at(x, y, channel) = c[channel];
        }
    return im;
}

using Quads = std::vector<std::array<Vec3, 4>>;

/// The Cornell box as measured at Cornell University (Program of Computer Graphics), in
/// millimetres; corners counter-clockwise seen from the side that faces the room.
void write_cornell_box(std::string const& folder) {
    Quads white{
        {{{552.8f, 0, 0}, {0, 0, 0}, {0, 0, 559.2f}, {549.6f, 0, 559.2f}}},
        {{{556, 548.8f, 0}, {556, 548.8f, 559.2f}, {0, 548.8f, 559.2f}, {0, 548.8f, 0}}},
        {{{549.6f, 0, 559.2f}, {0, 0, 559.2f}, {0, 548.8f, 559.2f}, {556, 548.8f, 559.2f}}},
    };
    auto add_block = [&](std::array<Vec2, 4> const& base, float height) {
        auto corner = [&](size_t i, float y) { return Vec3(base[i % 4].x, y, base[i % 4].y); };
        white.push_back(
            {corner(0, height), corner(1, height), corner(2, height), corner(3, height)});
        for (size_t i = 0; i < 4; ++i)
            white.push_back(
                {corner(i, 0), corner(i + 1, 0), corner(i + 1, height), corner(i, height)});
    };
    add_block({{{130, 65}, {82, 225}, {240, 272}, {290, 114}}}, 165);
    add_block({{{423, 247}, {265, 296}, {314, 456}, {472, 406}}}, 330);
    write_quads(folder + "/cornell_white.ply", white);
    write_quads(folder + "/cornell_green.ply",
                {{{{0, 0, 559.2f}, {0, 0, 0}, {0, 548.8f, 0}, {0, 548.8f, 559.2f}}}});
    write_quads(folder + "/cornell_red.ply",
                {{{{552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0}}}});
}

} // namespace

void make_assets(std::string const& folder) {
    std::filesystem::create_directories(folder);
    write_grid(folder + "/knot.ply", 1200, 130, knot);
    write_grid(folder + "/boulder.ply", 600, 300, boulder);
    write_grid(folder + "/vase.ply", 500, 300, vase);
    write_grid(folder + "/million.ply", 1000, 500, boulder);
    write_cornell_box(folder);
    image::write_png(folder + "/floor.png", paint(2048, 2048, floor_color));
    image::write_png(folder + "/glaze.png", paint(2048, 1024, glaze_color));
    image::write_png(folder + "/roughness.png", paint(1024, 1024, roughness));
    image::write_exr(folder + "/sky.exr", paint(1024, 512, sky));
    for (uint32_t i = 0; i < 6; ++i) {
        std::string const number = std::to_string(i);
        image::write_png(folder + "/color_" + number + ".png",
                         paint(1024, 1024, [i](Vec2 uv) { return patches(uv, i); }));
        image::write_png(folder + "/mask_" + number + ".png", paint(1024, 1024, [i](Vec2 uv) {
                             return Color(
                                 smooth(std::clamp(4 * fractal(uv, 6, 200 + i) - 1.5f, 0.f, 1.f)));
                         }));
    }
}

} // namespace weft::bench
