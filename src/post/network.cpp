#include "post/network.h"

#include <dnnl.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>

#include "base/color.h"
#include "post/exposure.h"
#include "post/tiling.h"
#include "post/weights.h"

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

/// One picture's way through one network.
struct Pass {
    int width, height, channels;
    std::function<void(int x, int y, float* to)> encode; ///< what the network sees of the pixel
    /// Takes the pixels [x0, x1) of row y: three values for each.
    std::function<void(int y, int x0, int x1, float const* from)> take_row;
};

void encode_albedo(image::Image const& albedo, int x, int y, float* to) {
    for (int c = 0; c < 3; ++c) to[c] = std::min(sane(albedo.at(x, y, c)), 1.f);
}

void encode_normal(image::Image const& normal, int x, int y, float* to) {
    for (int c = 0; c < 3; ++c) {
        float const n = normal.at(x, y, c);
        to[c] = std::isfinite(n) ? 0.5f + 0.5f * std::clamp(n, -1.f, 1.f) : 0.5f;
    }
}

/// Windows are places in the picture with its margins.
void fill_window(Pass const& pass, int x0, int y0, int width, int height, float* to) {
    tbb::parallel_for(0, height, [&](int y) {
        float* row = to + size_t(y) * size_t(width) * size_t(pass.channels);
        for (int x = 0; x < width; ++x, row += pass.channels)
            pass.encode(mirrored(x0 + x - kMargin, pass.width),
                        mirrored(y0 + y - kMargin, pass.height), row);
    });
}

void take_window(Pass const& pass, Window const& wx, Window const& wy, int width,
                 float const* from) {
    auto first = [](Window const& w) { return std::max(w.from - kMargin, 0); };
    auto last = [](Window const& w, int size) { return std::min(w.to - kMargin, size); };
    tbb::parallel_for(first(wy), last(wy, pass.height), [&](int y) {
        int const x0 = first(wx);
        float const* row =
            from +
            (size_t(y + kMargin - wy.begin) * size_t(width) + size_t(x0 + kMargin - wx.begin)) * 3;
        pass.take_row(y, x0, last(wx, pass.width), row);
    });
}

Tiling tiling_for(UnetSize size, int width, int height, int channels, int memory) {
    return tile_picture(width + 2 * kMargin, height + 2 * kMargin,
                        {kUnetAlignment, unet_reach(size)}, size_t(memory) << 20,
                        [&](int w, int h) { return unet_memory(size, channels, w, h); });
}

void run(Pass const& pass, std::string const& file, int memory) {
    Weights const weights = read_weights(file);
    Tiling const tiling =
        tiling_for(unet_size(weights), pass.width, pass.height, pass.channels, memory);
    if (tiling.x.windows.empty())
        throw InputError("denoising expects more memory than " + std::to_string(memory) +
                         " MB for its smallest tiles");
    try {
        Unet network(weights, file, pass.channels, tiling.x.size, tiling.y.size);
        for (Window const& wy : tiling.y.windows)
            for (Window const& wx : tiling.x.windows) {
                fill_window(pass, wx.begin, wy.begin, tiling.x.size, tiling.y.size,
                            network.input());
                network.run();
                take_window(pass, wx, wy, tiling.x.size, network.output());
            }
    } catch (dnnl::error const& e) {
        throw InputError(std::string("oneDNN cannot evaluate the network: ") + e.what());
    }
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

image::Image denoise_color(DenoiseInput const& input, std::string const& weights, int memory) {
    image::Image const& color = *input.color;
    bool const with_normal = input.albedo && input.normal;
    float const exposure = auto_exposure(color);
    image::Image result = image::make_image(color.width, color.height, 3);
    Pass const pass{
        color.width, color.height, input.albedo ? (with_normal ? 9 : 6) : 3,
        [&](int x, int y, float* to) {
            for (int c = 0; c < 3; ++c)
                to[c] = encode_hdr(std::min(sane(color.at(x, y, c) * exposure), kMostLight));
            if (input.albedo) encode_albedo(*input.albedo, x, y, to + 3);
            if (with_normal) encode_normal(*input.normal, x, y, to + 6);
        },
        [&](int y, int x0, int x1, float const* from) {
            Limits const limits = limits_of_row(color, y, x0, x1);
            float* const to = &result.at(x0, y, 0);
            for (size_t i = 0; i < size_t(3 * (x1 - x0)); ++i) {
                float const light = std::min(decode_hdr(sane(from[i])), kMostLight) / exposure;
                to[i] = std::clamp(light, limits.least[i], limits.most[i]);
            }
        }};
    run(pass, weights, memory);
    return result;
}

image::Image clean_albedo(image::Image const& albedo, std::string const& weights, int memory) {
    image::Image result = image::make_image(albedo.width, albedo.height, 3);
    Pass const pass{albedo.width, albedo.height, 3,
                    [&](int x, int y, float* to) {
                        encode_albedo(albedo, x, y, to);
                        for (int c = 0; c < 3; ++c) to[c] = linear_to_srgb(to[c]);
                    },
                    [&](int y, int x0, int x1, float const* from) {
                        float* const to = &result.at(x0, y, 0);
                        for (size_t i = 0; i < size_t(3 * (x1 - x0)); ++i)
                            to[i] = srgb_to_linear(std::min(sane(from[i]), 1.f));
                    }};
    run(pass, weights, memory);
    return result;
}

image::Image clean_normal(image::Image const& normal, std::string const& weights, int memory) {
    image::Image result = image::make_image(normal.width, normal.height, 3);
    Pass const pass{normal.width, normal.height, 3,
                    [&](int x, int y, float* to) { encode_normal(normal, x, y, to); },
                    [&](int y, int x0, int x1, float const* from) {
                        float* const to = &result.at(x0, y, 0);
                        for (size_t i = 0; i < size_t(3 * (x1 - x0)); ++i)
                            to[i] = 2 * std::min(sane(from[i]), 1.f) - 1;
                    }};
    run(pass, weights, memory);
    return result;
}

} // namespace

int tile_count(UnetSize size, int width, int height, int channels, int memory) {
    Tiling const tiling = tiling_for(size, width, height, channels, memory);
    return int(tiling.x.windows.size() * tiling.y.windows.size());
}

NetworkWeights weights_files(DenoiseInput const& input, Quality quality) {
    if (!input.albedo) return {"rt_hdr.tza", "", ""};
    if (!input.normal) return {"rt_hdr_alb.tza", "", ""};
    if (quality == Quality::balanced) return {"rt_hdr_alb_nrm.tza", "", ""};
    return {"rt_hdr_calb_cnrm_large.tza", "rt_alb.tza", "rt_nrm.tza"};
}

std::optional<NetworkWeights> find_weights(NetworkWeights const& files,
                                           std::vector<std::string> const& folders) {
    NetworkWeights paths;
    for (auto file : {&NetworkWeights::color, &NetworkWeights::albedo, &NetworkWeights::normal}) {
        if ((files.*file).empty()) continue;
        paths.*file = find_weights(files.*file, folders);
        if ((paths.*file).empty()) return std::nullopt;
    }
    return paths;
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

image::Image denoise_network(DenoiseInput const& input, NetworkWeights const& weights, int memory) {
    image::Image albedo, normal;
    DenoiseInput guided = input;
    if (!weights.albedo.empty()) {
        albedo = clean_albedo(*input.albedo, weights.albedo, memory);
        guided.albedo = &albedo;
    }
    if (!weights.normal.empty()) {
        normal = clean_normal(*input.normal, weights.normal, memory);
        guided.normal = &normal;
    }
    return denoise_color(guided, weights.color, memory);
}

} // namespace weft::post
