// The networks of Intel Open Image Denoise, version 2, evaluated with oneDNN.
//
// A U-Net (Ronneberger et al. 2015; Chaitanya et al. 2017 for renderings) of 3x3 convolutions with
// ReLU: four times down by 2x2 maxima, four times up by repetition, where each time the pixels of
// that size on the way down come in again. There are two topologies, of sixteen convolutions
// ("base") and of nineteen ("large"); the numbers of channels come from the weights.
//
// What the layers compute is left as it is, how is our own: a convolution of a picture that was
// made larger by repetition is one transposed convolution with a 4x4 kernel (under half of the
// work, and the larger picture is never stored), and a convolution of two stacked pictures is the
// sum of two.
#pragma once

#include <cstddef>
#include <memory>

#include "post/weights.h"

namespace weft::post {

/// Sizes of pictures must be multiples of this.
inline constexpr int kUnetAlignment = 16;

enum class UnetSize { base, large };

/// Returns which topology the names of the layers belong to.
UnetSize unet_size(Weights const& weights);

/// Returns how many pixels away the input still changes an output; a multiple of the alignment.
constexpr int unet_reach(UnetSize size) { return size == UnetSize::large ? 112 : 96; }

class Unet {
  public:
    /// Prepares the network for pictures of this size in pixels. Throws InputError, naming `name`,
    /// where the weights are not those of such a network with `channels` inputs, and dnnl::error (a
    /// std::exception) where memory is short.
    Unet(Weights const& weights, std::string const& name, int channels, int width, int height);
    ~Unet();

    /// height x width x channels floats, in: `channels`, out: 3. Theirs is the memory of the
    /// network.
    float* input();
    float const* output() const;
    /// Computes the output; the input is lost.
    void run();

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// What such a network takes, weights and buffers, in bytes; roughly, and not less.
size_t unet_memory(UnetSize size, int channels, int width, int height);

} // namespace weft::post
