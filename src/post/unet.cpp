#include "post/unet.h"

#include <dnnl.hpp>

#include <algorithm>
#include <cstring>
#include <span>

#include "base/error.h"

namespace weft::post {

namespace {

using dnnl::memory;

/// One layer. Layer i makes picture i + 1 out of picture i; picture 0 is the input, the last one
/// the output. With weights it is a convolution, without it takes the maxima of 2x2 pixels. Where
/// there is a second input `skip`, the first one is half as large and repeated, and the second
/// stacked on it.
struct Layer {
    char const* weights;
    int channels = 0; ///< as published, from which the memory is estimated before weights are read
    int skip = -1;
};

constexpr Layer kBaseLayers[] = {
    {"enc_conv0", 32},   {"enc_conv1", 32},     {nullptr},          {"enc_conv2", 48},
    {nullptr},           {"enc_conv3", 64},     {nullptr},          {"enc_conv4", 80},
    {nullptr},           {"enc_conv5a", 96},    {"enc_conv5b", 96}, {"dec_conv4a", 112, 7},
    {"dec_conv4b", 112}, {"dec_conv3a", 96, 5}, {"dec_conv3b", 96}, {"dec_conv2a", 64, 3},
    {"dec_conv2b", 64},  {"dec_conv1a", 64, 0}, {"dec_conv1b", 32}, {"dec_conv0", 3}};

constexpr Layer kLargeLayers[] = {
    {"enc_conv1a", 64},    {"enc_conv1b", 64},     {nullptr},
    {"enc_conv2a", 96},    {"enc_conv2b", 96},     {nullptr},
    {"enc_conv3a", 128},   {"enc_conv3b", 128},    {nullptr},
    {"enc_conv4a", 192},   {"enc_conv4b", 192},    {nullptr},
    {"enc_conv5a", 256},   {"enc_conv5b", 256},    {"dec_conv4a", 192, 9},
    {"dec_conv4b", 192},   {"dec_conv3a", 128, 6}, {"dec_conv3b", 128},
    {"dec_conv2a", 96, 3}, {"dec_conv2b", 96},     {"dec_conv1a", 64, 0},
    {"dec_conv1b", 64},    {"dec_conv1c", 3}};

using Layers = std::span<Layer const>;

Layers layers_of(UnetSize size) {
    return size == UnetSize::large ? Layers(kLargeLayers) : Layers(kBaseLayers);
}

/// A picture within the network: `level` times halved.
struct Shape {
    int channels = 0, level = 0;
    size_t bytes(int width, int height) const {
        return sizeof(float) * size_t(channels) * size_t(width >> level) * size_t(height >> level);
    }
};
using Shapes = std::vector<Shape>; ///< of the input, and of what each layer makes

/// `channels_of(layer)`: what its convolution gives.
template <class F>
Shapes shapes_of(Layers layers, int channels, F const& channels_of) {
    Shapes shapes{{channels, 0}};
    for (Layer const& l : layers) {
        Shape const from = shapes.back();
        if (!l.weights)
            shapes.push_back({from.channels, from.level + 1});
        else
            shapes.push_back({channels_of(l), from.level - (l.skip >= 0 ? 1 : 0)});
    }
    return shapes;
}

/// Where in one block of memory each picture lies: those that are needed at the same time do not
/// overlap. The largest are placed first, each as low as it can be.
struct Arena {
    std::vector<size_t> offsets;
    size_t size = 0;
};

Arena plan(Layers layers, Shapes const& shapes, int width, int height) {
    constexpr size_t kAlign = 64;
    size_t const count = shapes.size();
    // The first and the last layer that touches each picture.
    std::vector<size_t> first(count), last(count), order(count);
    for (size_t i = 0; i < layers.size(); ++i) {
        first[i + 1] = last[i + 1] = last[i] = i;
        if (layers[i].skip >= 0) last[size_t(layers[i].skip)] = i;
    }
    auto bytes = [&](size_t t) {
        return (shapes[t].bytes(width, height) + kAlign - 1) / kAlign * kAlign;
    };
    for (size_t t = 0; t < count; ++t) order[t] = t;
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return bytes(a) > bytes(b); });
    Arena arena{std::vector<size_t>(count), 0};
    std::vector<size_t> placed;
    for (size_t t : order) {
        size_t offset = 0;
        auto clash = [&](size_t other) {
            return first[t] <= last[other] && first[other] <= last[t] &&
                   offset < arena.offsets[other] + bytes(other) &&
                   arena.offsets[other] < offset + bytes(t);
        };
        for (auto it = placed.begin(); it != placed.end();) {
            if (clash(*it)) {
                offset = arena.offsets[*it] + bytes(*it);
                it = placed.begin();
            } else {
                ++it;
            }
        }
        arena.offsets[t] = offset;
        arena.size = std::max(arena.size, offset + bytes(t));
        placed.push_back(t);
    }
    return arena;
}

/// Weights of the channels [from, from + count) of the inputs.
Tensor input_slice(Tensor const& w, int64_t from, int64_t count) {
    Tensor slice{{w.dims[0], count, w.dims[2], w.dims[3]}, {}};
    int64_t const kernel = w.dims[2] * w.dims[3];
    for (int64_t o = 0; o < w.dims[0]; ++o) {
        auto const begin = w.values.begin() + (o * w.dims[1] + from) * kernel;
        slice.values.insert(slice.values.end(), begin, begin + count * kernel);
    }
    return slice;
}

/// The 4x4 kernel whose transposed convolution with stride 2, out[2i + k - 1] += k4[k] in[i], is
/// the 3x3 convolution k3 of the picture made twice as large by repetition: along each axis k4 =
/// (k3[2], k3[1] + k3[2], k3[0] + k3[1], k3[0]).
Tensor enlarging_kernel(Tensor const& w) {
    // Which of the three taps add up in each of the four.
    constexpr bool kTaps[4][3] = {
        {false, false, true}, {false, true, true}, {true, true, false}, {true, false, false}};
    Tensor result{{w.dims[0], w.dims[1], 4, 4}, {}};
    result.values.resize(size_t(w.dims[0] * w.dims[1] * 16));
    for (size_t io = 0; io < size_t(w.dims[0] * w.dims[1]); ++io)
        for (size_t y = 0; y < 4; ++y)
            for (size_t x = 0; x < 4; ++x) {
                float sum = 0;
                for (size_t b = 0; b < 3; ++b)
                    for (size_t a = 0; a < 3; ++a)
                        if (kTaps[y][b] && kTaps[x][a]) sum += w.values[io * 9 + b * 3 + a];
                result.values[io * 16 + y * 4 + x] = sum;
            }
    return result;
}

} // namespace

struct Unet::Data {
    dnnl::engine engine{dnnl::engine::kind::cpu, 0};
    dnnl::stream stream{engine};
    Shapes shapes;
    memory arena_memory;
    std::vector<memory> tensors;
    struct Step {
        dnnl::primitive primitive;
        std::unordered_map<int, memory> arguments;
    };
    std::vector<Step> steps;

    /// The same tensor in the layout that a primitive likes best.
    memory converted(Tensor const& tensor, memory::desc const& wanted) {
        auto const tag = tensor.dims.size() == 1 ? memory::format_tag::x : memory::format_tag::oihw;
        memory plain({tensor.dims, memory::data_type::f32, tag}, engine);
        std::memcpy(plain.get_data_handle(), tensor.values.data(),
                    tensor.values.size() * sizeof(float));
        if (plain.get_desc() == wanted) return plain;
        memory result(wanted, engine);
        dnnl::reorder(plain, result).execute(stream, plain, result);
        stream.wait();
        return result;
    }

    void add_pool(size_t from, size_t to) {
        dnnl::pooling_forward::desc const desc(
            dnnl::prop_kind::forward_inference, dnnl::algorithm::pooling_max,
            tensors[from].get_desc(), tensors[to].get_desc(), {2, 2}, {2, 2}, {0, 0}, {0, 0});
        dnnl::pooling_forward::primitive_desc const primitive(desc, engine);
        steps.push_back({dnnl::pooling_forward(primitive),
                         {{DNNL_ARG_SRC, tensors[from]}, {DNNL_ARG_DST, tensors[to]}}});
    }

    /// `add`: to what is there already.
    void add_convolution(size_t from, size_t to, Tensor const& weights, Tensor const& bias,
                         bool add) {
        dnnl::primitive_attr attributes;
        dnnl::post_ops after;
        if (add) after.append_sum();
        after.append_eltwise(1, dnnl::algorithm::eltwise_relu, 0, 0);
        attributes.set_post_ops(after);
        memory::desc const any(weights.dims, memory::data_type::f32, memory::format_tag::any);
        memory::desc const bias_desc(bias.dims, memory::data_type::f32, memory::format_tag::x);
        using Convolution = dnnl::convolution_forward;
        auto const source = tensors[from].get_desc(), target = tensors[to].get_desc();
        auto const kind = dnnl::prop_kind::forward_inference;
        auto const direct = dnnl::algorithm::convolution_direct;
        memory::dims const one{1, 1};
        Convolution::desc const desc(kind, direct, source, any, bias_desc, target, one, one, one);
        Convolution::primitive_desc const primitive(desc, attributes, engine);
        steps.push_back({Convolution(primitive),
                         {{DNNL_ARG_SRC, tensors[from]},
                          {DNNL_ARG_WEIGHTS, converted(weights, primitive.weights_desc())},
                          {DNNL_ARG_BIAS, converted(bias, bias_desc)},
                          {DNNL_ARG_DST, tensors[to]}}});
    }

    /// Without bias: oneDNN would take as much memory again for it, and the convolution that adds
    /// to this has it.
    void add_enlarging(size_t from, size_t to, Tensor const& weights) {
        memory::desc const any(weights.dims, memory::data_type::f32, memory::format_tag::any);
        using Deconvolution = dnnl::deconvolution_forward;
        Deconvolution::desc const desc(
            dnnl::prop_kind::forward_inference, dnnl::algorithm::deconvolution_direct,
            tensors[from].get_desc(), any, tensors[to].get_desc(), {2, 2}, {1, 1}, {1, 1});
        Deconvolution::primitive_desc const primitive(desc, engine);
        steps.push_back({Deconvolution(primitive),
                         {{DNNL_ARG_SRC, tensors[from]},
                          {DNNL_ARG_WEIGHTS, converted(weights, primitive.weights_desc())},
                          {DNNL_ARG_DST, tensors[to]}}});
    }
};

namespace {

/// A layer's kernels and biases, which must fit what comes in.
struct LayerWeights {
    Tensor const &weights, &bias;
};

LayerWeights find_layer(Weights const& all, std::string const& file, Layer const& layer) {
    std::string const name = layer.weights;
    auto const w = all.find(name + ".weight"), b = all.find(name + ".bias");
    auto fail = [&](std::string const& what) {
        throw InputError({file}, "expected the weights of an Open Image Denoise network of base "
                                 "or large size: " +
                                     what);
    };
    if (w == all.end() || b == all.end()) fail("there is no layer '" + name + "'");
    auto const& d = w->second.dims;
    if (d.size() != 4 || d[2] != 3 || d[3] != 3 || b->second.dims != std::vector<int64_t>{d[0]})
        fail("the layer '" + name + "' has another shape");
    return {w->second, b->second};
}

} // namespace

UnetSize unet_size(Weights const& weights) {
    return weights.contains("enc_conv1a.weight") ? UnetSize::large : UnetSize::base;
}

Unet::Unet(Weights const& weights, std::string const& name, int channels, int width, int height)
    : data_(std::make_unique<Data>()) {
    Data& d = *data_;
    Layers const layers = layers_of(unet_size(weights));
    d.shapes = shapes_of(layers, channels, [&](Layer const& l) {
        return int(find_layer(weights, name, l).bias.dims[0]);
    });
    for (size_t i = 0; i < layers.size(); ++i) {
        Layer const& l = layers[i];
        if (!l.weights) continue;
        int64_t const found = find_layer(weights, name, l).weights.dims[1];
        int64_t const expected =
            d.shapes[i].channels + (l.skip >= 0 ? d.shapes[size_t(l.skip)].channels : 0);
        if (found != expected || d.shapes.back().channels != 3)
            throw InputError({name}, "expected a network with " + std::to_string(channels) +
                                         " inputs and 3 outputs; its layer '" + l.weights +
                                         "' has " + std::to_string(found) + " inputs, not " +
                                         std::to_string(expected));
    }
    Arena const arena = plan(layers, d.shapes, width, height);
    d.arena_memory =
        memory({{int64_t(arena.size)}, memory::data_type::u8, memory::format_tag::x}, d.engine);
    auto* const base = static_cast<char*>(d.arena_memory.get_data_handle());
    for (size_t t = 0; t < d.shapes.size(); ++t) {
        Shape const& s = d.shapes[t];
        d.tensors.emplace_back(memory::desc({1, s.channels, height >> s.level, width >> s.level},
                                            memory::data_type::f32, memory::format_tag::nhwc),
                               d.engine, base + arena.offsets[t]);
    }
    for (size_t i = 0; i < layers.size(); ++i) {
        Layer const& l = layers[i];
        if (!l.weights) {
            d.add_pool(i, i + 1);
            continue;
        }
        auto const [w, b] = find_layer(weights, name, l);
        if (l.skip < 0) {
            d.add_convolution(i, i + 1, w, b, false);
            continue;
        }
        int64_t const below = d.shapes[i].channels;
        d.add_enlarging(i, i + 1, enlarging_kernel(input_slice(w, 0, below)));
        d.add_convolution(size_t(l.skip), i + 1, input_slice(w, below, w.dims[1] - below), b, true);
    }
}

Unet::~Unet() = default;

float* Unet::input() { return static_cast<float*>(data_->tensors.front().get_data_handle()); }
float const* Unet::output() const {
    return static_cast<float const*>(data_->tensors.back().get_data_handle());
}

void Unet::run() {
    for (Data::Step const& step : data_->steps)
        step.primitive.execute(data_->stream, step.arguments);
    data_->stream.wait();
}

size_t unet_memory(UnetSize size, int channels, int width, int height) {
    // Weights twice (as read, and as the layers like them), and what oneDNN takes for itself.
    size_t const fixed = size_t(size == UnetSize::large ? 128 : 48) << 20;
    Layers const layers = layers_of(size);
    auto const published = [](Layer const& l) { return l.channels; };
    return plan(layers, shapes_of(layers, channels, published), width, height).size + fixed;
}

} // namespace weft::post
