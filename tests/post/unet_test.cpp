// The network against an evaluation written out in double precision, layer by layer.
#include <gtest/gtest.h>

#include "base/error.h"
#include "post/unet.h"
#include "tests/post/pictures.h"

using namespace weft;
using namespace weft::testing;

namespace {

/// Channels first.
struct Planes {
    int channels, width, height;
    std::vector<double> values;

    double& at(int c, int x, int y) {
        return values[(size_t(c) * size_t(height) + size_t(y)) * size_t(width) + size_t(x)];
    }
    double get(int c, int x, int y) const {
        if (x < 0 || y < 0 || x >= width || y >= height) return 0;
        return values[(size_t(c) * size_t(height) + size_t(y)) * size_t(width) + size_t(x)];
    }
};

Planes planes(int channels, int width, int height) {
    return {channels, width, height,
            std::vector<double>(size_t(channels) * size_t(width) * size_t(height))};
}

Planes convolved(post::Weights const& weights, std::string const& name, Planes const& in) {
    post::Tensor const &w = weights.at(name + ".weight"), &b = weights.at(name + ".bias");
    Planes out = planes(int(w.dims[0]), in.width, in.height);
    EXPECT_EQ(w.dims[1], in.channels) << name;
    for (int o = 0; o < out.channels; ++o)
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x) {
                double sum = double(b.values[size_t(o)]);
                for (int i = 0; i < in.channels; ++i)
                    for (int dy = 0; dy < 3; ++dy)
                        for (int dx = 0; dx < 3; ++dx)
                            sum +=
                                double(
                                    w.values[size_t(((o * in.channels + i) * 3 + dy) * 3 + dx)]) *
                                in.get(i, x + dx - 1, y + dy - 1);
                out.at(o, x, y) = std::max(0.0, sum);
            }
    return out;
}

Planes pooled(Planes const& in) {
    Planes out = planes(in.channels, in.width / 2, in.height / 2);
    for (int c = 0; c < out.channels; ++c)
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x)
                out.at(c, x, y) = std::max(
                    std::max(in.get(c, 2 * x, 2 * y), in.get(c, 2 * x + 1, 2 * y)),
                    std::max(in.get(c, 2 * x, 2 * y + 1), in.get(c, 2 * x + 1, 2 * y + 1)));
    return out;
}

/// The first made twice as large by repetition, the second stacked on it.
Planes enlarged(Planes const& below, Planes const& skip) {
    Planes out = planes(below.channels + skip.channels, skip.width, skip.height);
    for (int c = 0; c < out.channels; ++c)
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x)
                out.at(c, x, y) = c < below.channels ? below.get(c, x / 2, y / 2)
                                                     : skip.get(c - below.channels, x, y);
    return out;
}

Planes evaluate(post::Weights const& w, Planes const& input) {
    bool const large = post::unet_size(w) == post::UnetSize::large;
    auto level = [&](std::string const& name, Planes const& in) {
        return pooled(large ? convolved(w, name + "b", convolved(w, name + "a", in))
                            : convolved(w, name, in));
    };
    Planes const p1 = level("enc_conv1", large ? input : convolved(w, "enc_conv0", input));
    Planes const p2 = level("enc_conv2", p1);
    Planes const p3 = level("enc_conv3", p2);
    Planes const p4 = level("enc_conv4", p3);
    Planes x = convolved(w, "enc_conv5b", convolved(w, "enc_conv5a", p4));
    x = convolved(w, "dec_conv4b", convolved(w, "dec_conv4a", enlarged(x, p3)));
    x = convolved(w, "dec_conv3b", convolved(w, "dec_conv3a", enlarged(x, p2)));
    x = convolved(w, "dec_conv2b", convolved(w, "dec_conv2a", enlarged(x, p1)));
    x = convolved(w, "dec_conv1b", convolved(w, "dec_conv1a", enlarged(x, input)));
    return convolved(w, large ? "dec_conv1c" : "dec_conv0", x);
}

class UnetOfSize : public ::testing::TestWithParam<post::UnetSize> {};

TEST_P(UnetOfSize, ComputesWhatItsLayersSay) {
    int const width = 48, height = 32;
    for (int channels : {3, 6, 9}) {
        SCOPED_TRACE(channels);
        auto const weights = random_weights(channels, uint64_t(channels), GetParam());
        post::Unet network(weights, "test", channels, width, height);
        Planes input = planes(channels, width, height);
        Rng rng(7);
        for (int c = 0; c < channels; ++c)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    network.input()[(y * width + x) * channels + c] =
                        float(input.at(c, x, y) = double(float(rng.next_uint() >> 8) / 16777216.f));
        network.run();
        Planes const expected = evaluate(weights, input);
        double largest = 0, difference = 0;
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    double const e = expected.get(c, x, y);
                    largest = std::max(largest, e);
                    difference =
                        std::max(difference,
                                 std::abs(e - double(network.output()[(y * width + x) * 3 + c])));
                }
        EXPECT_GT(largest, 0.1) << "the test says nothing";
        EXPECT_LT(difference, 1e-5 * largest);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, UnetOfSize,
                         ::testing::Values(post::UnetSize::base, post::UnetSize::large));

TEST_P(UnetOfSize, SeesNoFurtherThanItsReach) {
    int const reach = post::unet_reach(GetParam()), width = 4 * reach;
    auto const weights = random_weights(3, 11, GetParam());
    post::Unet network(weights, "test", 3, width, post::kUnetAlignment);
    auto row = [&](float first) { // whose first 16 pixels are `first`
        for (int i = 0; i < 3 * width * post::kUnetAlignment; ++i)
            network.input()[i] = (i / 3) % width < 16 ? first : 0.5f;
        network.run();
        return std::vector<float>(network.output(), network.output() + 3 * width);
    };
    auto const a = row(0), b = row(1);
    int furthest = 0;
    for (int i = 0; i < 3 * width; ++i)
        if (a[size_t(i)] != b[size_t(i)]) furthest = i / 3 - 15;
    EXPECT_LE(furthest, reach);
}

TEST(Unet, RefusesOtherNetworks) {
    auto message = [](post::Weights const& weights, int channels) -> std::string {
        try {
            post::Unet const network(weights, "w.tza", channels, 16, 16);
        } catch (InputError const& e) {
            return e.what();
        }
        return "no error";
    };
    auto weights = random_weights(6, 1);
    EXPECT_EQ(message(weights, 6), "no error");
    EXPECT_EQ(message(weights, 9),
              "w.tza: expected a network with 9 inputs and 3 outputs; its layer 'enc_conv0' has 6 "
              "inputs, not 9");
    auto lacking = weights;
    lacking.erase("dec_conv2b.bias");
    EXPECT_EQ(message(lacking, 6), "w.tza: expected the weights of an Open Image Denoise network "
                                   "of base or large size: there is "
                                   "no layer 'dec_conv2b'");
    auto other = weights;
    other["enc_conv3.weight"].dims = {6, 5, 9};
    EXPECT_EQ(message(other, 6), "w.tza: expected the weights of an Open Image Denoise network of "
                                 "base or large size: the layer "
                                 "'enc_conv3' has another shape");
}

} // namespace
