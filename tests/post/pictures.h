// Pictures and networks for the tests of the denoiser.
#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "base/hash.h"
#include "image/image.h"
#include "post/unet.h"
#include "post/weights.h"

namespace weft::testing {

inline image::Image constant_picture(int width, int height, float value) {
    image::Image image = image::make_image(width, height, 3);
    for (float& x : image.pixels) x = value;
    return image;
}

inline image::Image picture_of(int width, int height,
                               std::function<float(int x, int y, int c)> const& value) {
    image::Image image = image::make_image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = value(x, y, c);
    return image;
}

/// Light in [0, 4) that changes slowly, with edges, times noise of mean 1.
inline image::Image noisy_picture(int width, int height, uint64_t seed = 1) {
    Rng rng(seed);
    return picture_of(width, height, [&](int x, int y, int c) {
        float const base =
            0.3f + 0.2f * std::sin(0.03f * float(x + 7 * c)) + ((x / 37 + y / 29) % 2 ? 0.5f : 0.f);
        return base * -std::log(1 - 0.999f * float(rng.next_uint()) / 4294967296.f);
    });
}

/// A noisy picture, a tenth of whose values no light can have.
inline image::Image unfit_picture(int width, int height, uint64_t seed) {
    constexpr float limits[] = {std::numeric_limits<float>::quiet_NaN(),
                                std::numeric_limits<float>::infinity(),
                                -std::numeric_limits<float>::infinity(),
                                3e38f,
                                -3e38f,
                                1e-45f};
    image::Image image = noisy_picture(width, height);
    Rng rng(seed);
    for (float& x : image.pixels)
        if (uint32_t const n = rng.next_uint() % 60; n < 6) x = limits[n];
    return image;
}

/// The bytes of a file of weights; `half` writes 16-bit floats (of values that have a few bits).
inline std::string weights_bytes(post::Weights const& weights, bool half = false) {
    std::string bytes;
    auto put = [&](auto value) {
        bytes.append(reinterpret_cast<char const*>(&value), sizeof(value));
    };
    put(uint16_t(0x41d7));
    put(uint8_t(2));
    put(uint8_t(0));
    put(uint64_t(0)); // the table's offset, set below
    std::map<std::string, uint64_t> offsets;
    for (auto const& [name, tensor] : weights) {
        offsets[name] = bytes.size();
        for (float value : tensor.values) {
            uint32_t bits;
            std::memcpy(&bits, &value, sizeof(bits));
            if (!half)
                put(bits);
            else if (bits << 1 == 0)
                put(uint16_t(bits >> 16));
            else
                put(uint16_t((bits >> 16 & 0x8000) |
                             (((bits >> 23 & 0xff) - 112) << 10 | (bits >> 13 & 0x3ff))));
        }
    }
    uint64_t const table = bytes.size();
    std::memcpy(bytes.data() + 4, &table, sizeof(table));
    put(uint32_t(weights.size()));
    for (auto const& [name, tensor] : weights) {
        put(uint16_t(name.size()));
        bytes += name;
        put(uint8_t(tensor.dims.size()));
        for (int64_t d : tensor.dims) put(uint32_t(d));
        bytes += tensor.dims.size() == 1 ? "x" : "oihw";
        put(half ? 'h' : 'f');
        put(offsets[name]);
    }
    return bytes;
}

/// A layer's name, its outputs and inputs.
struct LayerShape {
    char const* name;
    int out, in;
};

/// The layers of a network of this size with fewer channels, for `channels` inputs.
inline std::vector<LayerShape> small_network(int channels, post::UnetSize size) {
    if (size == post::UnetSize::large)
        return {{"enc_conv1a", 4, channels},
                {"enc_conv1b", 4, 4},
                {"enc_conv2a", 5, 4},
                {"enc_conv2b", 5, 5},
                {"enc_conv3a", 6, 5},
                {"enc_conv3b", 6, 6},
                {"enc_conv4a", 7, 6},
                {"enc_conv4b", 7, 7},
                {"enc_conv5a", 8, 7},
                {"enc_conv5b", 8, 8},
                {"dec_conv4a", 9, 8 + 6},
                {"dec_conv4b", 9, 9},
                {"dec_conv3a", 8, 9 + 5},
                {"dec_conv3b", 8, 8},
                {"dec_conv2a", 6, 8 + 4},
                {"dec_conv2b", 6, 6},
                {"dec_conv1a", 6, 6 + channels},
                {"dec_conv1b", 5, 6},
                {"dec_conv1c", 3, 5}};
    return {{"enc_conv0", 4, channels}, {"enc_conv1", 4, 4},
            {"enc_conv2", 5, 4},        {"enc_conv3", 6, 5},
            {"enc_conv4", 7, 6},        {"enc_conv5a", 8, 7},
            {"enc_conv5b", 8, 8},       {"dec_conv4a", 9, 8 + 6},
            {"dec_conv4b", 9, 9},       {"dec_conv3a", 8, 9 + 5},
            {"dec_conv3b", 8, 8},       {"dec_conv2a", 6, 8 + 4},
            {"dec_conv2b", 6, 6},       {"dec_conv1a", 6, 6 + channels},
            {"dec_conv1b", 5, 6},       {"dec_conv0", 3, 5}};
}

/// Its weights: value(layer, output, input, dy, dx) and no bias, unless `bias` gives one.
inline post::Weights
make_weights(int channels,
             std::function<float(LayerShape const&, int out, int in, int dy, int dx)> const& value,
             std::function<float(LayerShape const&, int out)> const& bias = {},
             post::UnetSize size = post::UnetSize::base) {
    post::Weights weights;
    for (LayerShape const& layer : small_network(channels, size)) {
        post::Tensor w{{layer.out, layer.in, 3, 3}, {}}, b{{layer.out}, {}};
        for (int o = 0; o < layer.out; ++o) {
            for (int i = 0; i < layer.in; ++i)
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) w.values.push_back(value(layer, o, i, dy, dx));
            b.values.push_back(bias ? bias(layer, o) : 0.f);
        }
        weights[std::string(layer.name) + ".weight"] = std::move(w);
        weights[std::string(layer.name) + ".bias"] = std::move(b);
    }
    return weights;
}

/// Values of both signs that keep the size of what goes through, all layers in use.
inline post::Weights random_weights(int channels, uint64_t seed,
                                    post::UnetSize size = post::UnetSize::base) {
    Rng rng(seed);
    auto number = [&] { return float(rng.next_uint()) / 2147483648.f - 1; };
    return make_weights(
        channels,
        [&](LayerShape const& layer, int, int, int, int) {
            return number() * std::sqrt(2.f / float(layer.in)) * 0.6f;
        },
        [&](LayerShape const&, int) { return 0.1f * number(); }, size);
}

/// A network whose output is its first three inputs.
inline post::Weights identity_weights(int channels) {
    return make_weights(channels, [&](LayerShape const& layer, int out, int in, int dy, int dx) {
        std::string const name = layer.name;
        if (dy != 0 || dx != 0 || out >= 3) return 0.f;
        // The input comes in behind what is below it.
        if (name == "dec_conv1a") return in == out + layer.in - channels ? 1.f : 0.f;
        return (name == "dec_conv1b" || name == "dec_conv0") && in == out ? 1.f : 0.f;
    });
}

} // namespace weft::testing
