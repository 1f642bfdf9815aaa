#include "post/network.h"

#include <dnnl.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "post/exposure.h"
#include "post/tiling.h"
#include "post/unet.h"

namespace weft::post {

namespace {

constexpr float kMostLight = 65504; ///< the largest half

/// The curve's pieces: linear up to kY0, a power up to kY1, then logarithmic.
constexpr float kA = 1.41283765e+03f, kB = 1.64593172e+00f, kC = 4.31384981e-01f,
                kD = -2.94139609e-03f, kE = 1.92653254e-01f, kF = 6.26026094e-03f,
                kG = 9.98620152e-01f;
constexpr float kY0 = 1.57945760e-06f, kY1 = 3.22087631e-02f;
constexpr float kX0 = 2.23151711e-03f, kX1 = 3.70974749e-01f;
constexpr float kLargest = 3.13511904f; ///< what the curve gives for kMostLight

/// The network takes what is beyond the edges for black, which shows along them. So the picture is
/// continued by its mirror image, and that cut off again.
constexpr int kMargin = 32;

/// `x` in [-kMargin, ...) mirrored at the edges into [0, size), as often as it takes.
int mirrored(int x, int size) {
    int const period = 2 * size;
    x = (x % period + period) % period;
    return x < size ? x : period - 1 - x;
}

struct Picture {
    DenoiseInput input;
    int channels;
    float exposure;
};

/// What the network sees of the pixel.
void encode_pixel(Picture const& p, int x, int y, float* to) {
    for (int c = 0; c < 3; ++c)
        *to++ = encode_hdr(std::min(sane(p.input.color->at(x, y, c) * p.exposure), kMostLight));
    if (p.channels >= 6)
        for (int c = 0; c < 3; ++c) *to++ = std::min(sane(p.input.albedo->at(x, y, c)), 1.f);
    if (p.channels >= 9)
        for (int c = 0; c < 3; ++c) {
            float const n = p.input.normal->at(x, y, c);
            *to++ = std::isfinite(n) ? 0.5f + 0.5f * std::clamp(n, -1.f, 1.f) : 0.5f;
        }
}

/// Windows are places in the picture with its margins.
void fill_window(Picture const& p, int x0, int y0, int width, int height, float* to) {
    image::Image const& color = *p.input.color;
    tbb::parallel_for(0, height, [&](int y) {
        float* row = to + size_t(y) * size_t(width) * size_t(p.channels);
        for (int x = 0; x < width; ++x, row += p.channels)
            encode_pixel(p, mirrored(x0 + x - kMargin, color.width),
                         mirrored(y0 + y - kMargin, color.height), row);
    });
}

/// The least and the largest light of each channel in the window around each pixel of a row. The
/// network is trained not to leave them, and does so where bright lights end: a hundredth of
/// its code is a sixth of the light there.
struct Limits {
    std::vector<float> least, most; ///< 3 * (x - x0) + c
};

Limits limits_of_row(image::Image const& color, int y, int x0, int x1) {
    constexpr int kRadius = 5;
    int const from = std::max(x0 - kRadius, 0), to = std::min(x1 + kRadius, color.width);
    std::vector<float> least(size_t(3 * (to - from)), kMostLight * 1e30f), most(least.size(), 0.f);
    for (int v = std::max(y - kRadius, 0); v <= std::min(y + kRadius, color.height - 1); ++v)
        for (int x = from; x < to; ++x)
            for (int c = 0; c < 3; ++c) {
                size_t const i = size_t(3 * (x - from) + c);
                float const light = sane(color.at(x, v, c));
                least[i] = std::min(least[i], light);
                most[i] = std::max(most[i], light);
            }
    Limits limits{std::vector<float>(size_t(3 * (x1 - x0))),
                  std::vector<float>(size_t(3 * (x1 - x0)))};
    for (int x = x0; x < x1; ++x)
        for (int c = 0; c < 3; ++c) {
            size_t const i = size_t(3 * (x - x0) + c);
            auto of_column = [&](int u) { return size_t(3 * (u - from) + c); };
            limits.least[i] = least[of_column(x)];
            limits.most[i] = most[of_column(x)];
            for (int u = std::max(x - kRadius, from); u < std::min(x + kRadius + 1, to); ++u) {
                limits.least[i] = std::min(limits.least[i], least[of_column(u)]);
                limits.most[i] = std::max(limits.most[i], most[of_column(u)]);
            }
        }
    return limits;
}

void take_window(Picture const& p, Window const& wx, Window const& wy, int width, float const* from,
                 image::Image& to) {
    auto first = [](Window const& w) { return std::max(w.from - kMargin, 0); };
    auto last = [](Window const& w, int size) { return std::min(w.to - kMargin, size); };
    tbb::parallel_for(first(wy), last(wy, to.height), [&](int y) {
        int const x0 = first(wx), x1 = last(wx, to.width);
        Limits const limits = limits_of_row(*p.input.color, y, x0, x1);
        for (int x = x0; x < x1; ++x) {
            float const* pixel = from + (size_t(y + kMargin - wy.begin) * size_t(width) +
                                         size_t(x + kMargin - wx.begin)) *
                                            3;
            for (int c = 0; c < 3; ++c) {
                size_t const i = size_t(3 * (x - x0) + c);
                float const light = std::min(decode_hdr(sane(pixel[c])), kMostLight) / p.exposure;
                to.at(x, y, c) = std::clamp(light, limits.least[i], limits.most[i]);
            }
        }
    });
}

Tiling tiling_for(int width, int height, int channels, int memory) {
    return tile_picture(width + 2 * kMargin, height + 2 * kMargin, {kUnetAlignment, kUnetReach},
                        size_t(memory) << 20,
                        [&](int w, int h) { return unet_memory(channels, w, h); });
}

} // namespace

int tile_count(int width, int height, int channels, int memory) {
    Tiling const tiling = tiling_for(width, height, channels, memory);
    return int(tiling.x.windows.size() * tiling.y.windows.size());
}

std::string weights_file(DenoiseInput const& input) {
    if (!input.albedo) return "rt_hdr.tza";
    return input.normal ? "rt_hdr_alb_nrm.tza" : "rt_hdr_alb.tza";
}

float encode_hdr(float y) {
    float const x = y <= kY0   ? kA * y
                    : y <= kY1 ? kB * std::pow(y, kC) + kD
                               : kE * std::log(y + kF) + kG;
    return x / kLargest;
}

float decode_hdr(float code) {
    float const x = code * kLargest;
    if (x <= kX0) return x / kA;
    return x <= kX1 ? std::pow((x - kD) / kB, 1 / kC) : std::exp((x - kG) / kE) - kF;
}

image::Image denoise_network(DenoiseInput const& input, std::string const& weights, int memory) {
    image::Image const& color = *input.color;
    Picture const picture{input, input.albedo ? (input.normal ? 9 : 6) : 3, auto_exposure(color)};
    Tiling const tiling = tiling_for(color.width, color.height, picture.channels, memory);
    if (tiling.x.windows.empty())
        throw InputError("denoising expects more memory than " + std::to_string(memory) +
                         " MB for its smallest tiles");
    image::Image result = image::make_image(color.width, color.height, 3);
    try {
        Unet network(read_weights(weights), weights, picture.channels, tiling.x.size,
                     tiling.y.size);
        for (Window const& wy : tiling.y.windows)
            for (Window const& wx : tiling.x.windows) {
                fill_window(picture, wx.begin, wy.begin, tiling.x.size, tiling.y.size,
                            network.input());
                network.run();
                take_window(picture, wx, wy, tiling.x.size, network.output(), result);
            }
    } catch (dnnl::error const& e) {
        throw InputError(std::string("oneDNN cannot evaluate the network: ") + e.what());
    }
    return result;
}

} // namespace weft::post
