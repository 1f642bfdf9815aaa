#include "post/unet.h"

#include <dnnl.hpp>

#include <algorithm>
#include <array>
#include <cstring>

#include "base/error.h"

namespace weft::post {

namespace {

using dnnl::memory;

/// The pictures that flow through the network: the input, the results of its layers, and those made
/// smaller.
enum Tensors {
    kInput,
    kEnc0,
    kEnc1,
    kPool1,
    kEnc2,
    kPool2,
    kEnc3,
    kPool3,
    kEnc4,
    kPool4,
    kEnc5a,
    kEnc5b,
    kDec4a,
    kDec4b,
    kDec3a,
    kDec3b,
    kDec2a,
    kDec2b,
    kDec1a,
    kDec1b,
    kDec0,
    kTensors
};

/// One layer. With weights it is a convolution, without it takes the maxima of 2x2 pixels. Where
/// there is a second input, the first one is half as large and repeated, and the second stacked on
/// it.
struct Layer {
    char const* weights;
    int to, from, skip = -1;
};

constexpr std::array<Layer, 20> kLayers{
    {{"enc_conv0", kEnc0, kInput},   {"enc_conv1", kEnc1, kEnc0},
     {nullptr, kPool1, kEnc1},       {"enc_conv2", kEnc2, kPool1},
     {nullptr, kPool2, kEnc2},       {"enc_conv3", kEnc3, kPool2},
     {nullptr, kPool3, kEnc3},       {"enc_conv4", kEnc4, kPool3},
     {nullptr, kPool4, kEnc4},       {"enc_conv5a", kEnc5a, kPool4},
     {"enc_conv5b", kEnc5b, kEnc5a}, {"dec_conv4a", kDec4a, kEnc5b, kPool3},
     {"dec_conv4b", kDec4b, kDec4a}, {"dec_conv3a", kDec3a, kDec4b, kPool2},
     {"dec_conv3b", kDec3b, kDec3a}, {"dec_conv2a", kDec2a, kDec3b, kPool1},
     {"dec_conv2b", kDec2b, kDec2a}, {"dec_conv1a", kDec1a, kDec2b, kInput},
     {"dec_conv1b", kDec1b, kDec1a}, {"dec_conv0", kDec0, kDec1b}}};

/// A picture within the network: `level` times halved.
struct Shape {
    int channels = 0, level = 0;
    size_t bytes(int width, int height) const {
        return sizeof(float) * size_t(channels) * size_t(width >> level) * size_t(height >> level);
    }
};
using Shapes = std::array<Shape, kTensors>;

/// `channels_of(layer)`: what its convolution gives.
template <class F>
Shapes shapes_of(int channels, F const& channels_of) {
    Shapes shapes;
    shapes[kInput] = {channels, 0};
    for (Layer const& l : kLayers) {
        Shape const& from = shapes[size_t(l.from)];
        if (!l.weights)
            shapes[size_t(l.to)] = {from.channels, from.level + 1};
        else
            shapes[size_t(l.to)] = {channels_of(l), from.level - (l.skip >= 0 ? 1 : 0)};
    }
    return shapes;
}

/// Where in one block of memory each picture lies: those that are needed at the same time do not
/// overlap. The largest are placed first, each as low as it can be.
struct Arena {
    std::array<size_t, kTensors> offsets{};
    size_t size = 0;
};

Arena plan(Shapes const& shapes, int width, int height) {
    constexpr size_t kAlign = 64;
    std::array<int, kTensors> first{}, last{}, order{};
    for (int i = 0; i < int(kLayers.size()); ++i) {
        Layer const& l = kLayers[size_t(i)];
        first[size_t(l.to)] = last[size_t(l.to)] = i;
        last[size_t(l.from)] = i;
        if (l.skip >= 0) last[size_t(l.skip)] = i;
    }
    auto bytes = [&](int t) {
        return (shapes[size_t(t)].bytes(width, height) + kAlign - 1) / kAlign * kAlign;
    };
    for (int t = 0; t < kTensors; ++t) order[size_t(t)] = t;
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return bytes(a) > bytes(b); });
    Arena arena;
    std::vector<int> placed;
    for (int t : order) {
        size_t offset = 0;
        auto clash = [&](int other) {
            return first[size_t(t)] <= last[size_t(other)] &&
                   first[size_t(other)] <= last[size_t(t)] &&
                   offset < arena.offsets[size_t(other)] + bytes(other) &&
                   arena.offsets[size_t(other)] < offset + bytes(t);
        };
        for (auto it = placed.begin(); it != placed.end();) {
            if (clash(*it)) {
                offset = arena.offsets[size_t(*it)] + bytes(*it);
                it = placed.begin();
            } else {
                ++it;
            }
        }
        arena.offsets[size_t(t)] = offset;
        arena.size = std::max(arena.size, offset + bytes(t));
        placed.push_back(t);
    }
    return arena;
}

/// The published channels, from which the memory is estimated before weights are read.
int published_channels(Layer const& layer) {
    constexpr std::array<int, kTensors> channels{0,  32,  32,  0,  48, 0,  64, 0,  80, 0, 96,
                                                 96, 112, 112, 96, 96, 64, 64, 64, 32, 3};
    return channels[size_t(layer.to)];
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
    Arena arena;
    memory arena_memory;
    std::array<memory, kTensors> tensors;
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

    void add_pool(int from, int to) {
        dnnl::pooling_forward::desc const desc(
            dnnl::prop_kind::forward_inference, dnnl::algorithm::pooling_max,
            tensors[size_t(from)].get_desc(), tensors[size_t(to)].get_desc(), {2, 2}, {2, 2},
            {0, 0}, {0, 0});
        dnnl::pooling_forward::primitive_desc const primitive(desc, engine);
        steps.push_back(
            {dnnl::pooling_forward(primitive),
             {{DNNL_ARG_SRC, tensors[size_t(from)]}, {DNNL_ARG_DST, tensors[size_t(to)]}}});
    }

    /// `add`: to what is there already.
    void add_convolution(int from, int to, Tensor const& weights, Tensor const& bias, bool add) {
        dnnl::primitive_attr attributes;
        dnnl::post_ops after;
        if (add) after.append_sum();
        after.append_eltwise(1, dnnl::algorithm::eltwise_relu, 0, 0);
        attributes.set_post_ops(after);
        memory::desc const any(weights.dims, memory::data_type::f32, memory::format_tag::any);
        memory::desc const bias_desc(bias.dims, memory::data_type::f32, memory::format_tag::x);
        using Convolution = dnnl::convolution_forward;
        auto const source = tensors[size_t(from)].get_desc(),
                   target = tensors[size_t(to)].get_desc();
        auto const kind = dnnl::prop_kind::forward_inference;
        auto const direct = dnnl::algorithm::convolution_direct;
        memory::dims const one{1, 1};
        Convolution::desc const desc(kind, direct, source, any, bias_desc, target, one, one, one);
        Convolution::primitive_desc const primitive(desc, attributes, engine);
        steps.push_back({Convolution(primitive),
                         {{DNNL_ARG_SRC, tensors[size_t(from)]},
                          {DNNL_ARG_WEIGHTS, converted(weights, primitive.weights_desc())},
                          {DNNL_ARG_BIAS, converted(bias, bias_desc)},
                          {DNNL_ARG_DST, tensors[size_t(to)]}}});
    }

    /// Without bias: oneDNN would take as much memory again for it, and the convolution that adds
    /// to this has it.
    void add_enlarging(int from, int to, Tensor const& weights) {
        memory::desc const any(weights.dims, memory::data_type::f32, memory::format_tag::any);
        using Deconvolution = dnnl::deconvolution_forward;
        Deconvolution::desc const desc(dnnl::prop_kind::forward_inference,
                                       dnnl::algorithm::deconvolution_direct,
                                       tensors[size_t(from)].get_desc(), any,
                                       tensors[size_t(to)].get_desc(), {2, 2}, {1, 1}, {1, 1});
        Deconvolution::primitive_desc const primitive(desc, engine);
        steps.push_back({Deconvolution(primitive),
                         {{DNNL_ARG_SRC, tensors[size_t(from)]},
                          {DNNL_ARG_WEIGHTS, converted(weights, primitive.weights_desc())},
                          {DNNL_ARG_DST, tensors[size_t(to)]}}});
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
                                 "size: " +
                                     what);
    };
    if (w == all.end() || b == all.end()) fail("there is no layer '" + name + "'");
    auto const& d = w->second.dims;
    if (d.size() != 4 || d[2] != 3 || d[3] != 3 || b->second.dims != std::vector<int64_t>{d[0]})
        fail("the layer '" + name + "' has another shape");
    return {w->second, b->second};
}

} // namespace

Unet::Unet(Weights const& weights, std::string const& name, int channels, int width, int height)
    : data_(std::make_unique<Data>()) {
    Data& d = *data_;
    d.shapes = shapes_of(
        channels, [&](Layer const& l) { return int(find_layer(weights, name, l).bias.dims[0]); });
    for (Layer const& l : kLayers) {
        if (!l.weights) continue;
        int64_t const found = find_layer(weights, name, l).weights.dims[1];
        int64_t const expected = d.shapes[size_t(l.from)].channels +
                                 (l.skip >= 0 ? d.shapes[size_t(l.skip)].channels : 0);
        if (found != expected || d.shapes[kDec0].channels != 3)
            throw InputError({name}, "expected a network with " + std::to_string(channels) +
                                         " inputs and 3 outputs; its layer '" + l.weights +
                                         "' has " + std::to_string(found) + " inputs, not " +
                                         std::to_string(expected));
    }
    d.arena = plan(d.shapes, width, height);
    d.arena_memory =
        memory({{int64_t(d.arena.size)}, memory::data_type::u8, memory::format_tag::x}, d.engine);
    auto* const base = static_cast<char*>(d.arena_memory.get_data_handle());
    for (size_t t = 0; t < kTensors; ++t) {
        Shape const& s = d.shapes[t];
        d.tensors[t] = memory({{1, s.channels, height >> s.level, width >> s.level},
                               memory::data_type::f32,
                               memory::format_tag::nhwc},
                              d.engine, base + d.arena.offsets[t]);
    }
    for (Layer const& l : kLayers) {
        if (!l.weights) {
            d.add_pool(l.from, l.to);
            continue;
        }
        auto const [w, b] = find_layer(weights, name, l);
        if (l.skip < 0) {
            d.add_convolution(l.from, l.to, w, b, false);
            continue;
        }
        int64_t const below = d.shapes[size_t(l.from)].channels;
        d.add_enlarging(l.from, l.to, enlarging_kernel(input_slice(w, 0, below)));
        d.add_convolution(l.skip, l.to, input_slice(w, below, w.dims[1] - below), b, true);
    }
}

Unet::~Unet() = default;

float* Unet::input() { return static_cast<float*>(data_->tensors[kInput].get_data_handle()); }
float const* Unet::output() const {
    return static_cast<float const*>(data_->tensors[kDec0].get_data_handle());
}

void Unet::run() {
    for (Data::Step const& step : data_->steps)
        step.primitive.execute(data_->stream, step.arguments);
    data_->stream.wait();
}

size_t unet_memory(int channels, int width, int height) {
    // Weights twice (as read, and as the layers like them), and what oneDNN takes for itself.
    constexpr size_t kFixed = 48 << 20;
    return plan(shapes_of(channels, published_channels), width, height).size + kFixed;
}

} // namespace weft::post
