#include "post/convolve.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cassert>

namespace weft::post {

namespace {

OIIO::ImageBuf transformed(std::vector<float>& values, int width, int height) {
    OIIO::ImageBuf const in(OIIO::ImageSpec(width, height, 1, OIIO::TypeDesc::FLOAT),
                            values.data());
    OIIO::ImageBuf out = OIIO::ImageBufAlgo::fft(in);
    if (out.has_error()) throw std::runtime_error("Fourier transform: " + out.geterror());
    return out;
}

float* pixels_of(OIIO::ImageBuf& buffer) { return static_cast<float*>(buffer.localpixels()); }

/// Over the period of twice the size, with offset 0 at pixel 0.
std::vector<float> periodic(EvenKernel const& k) {
    int const width = 2 * k.width, height = 2 * k.height;
    std::vector<float> result(size_t(width) * size_t(height));
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            int const dx = x <= k.width ? x : width - x, dy = y <= k.height ? y : height - y;
            float const w = k.weights[size_t(dy) * size_t(k.width + 1) + size_t(dx)];
            result[size_t(y) * size_t(width) + size_t(x)] = w;
            sum += w;
        }
    for (float& w : result) w = float(w / sum);
    return result;
}

/// The picture and its mirror images to the right, below, and both.
std::vector<float> mirrored(std::vector<float> const& values, int width, int height) {
    std::vector<float> result(4 * values.size());
    for (int y = 0; y < 2 * height; ++y)
        for (int x = 0; x < 2 * width; ++x) {
            int const fx = x < width ? x : 2 * width - 1 - x;
            int const fy = y < height ? y : 2 * height - 1 - y;
            result[size_t(y) * size_t(2 * width) + size_t(x)] =
                values[size_t(fy) * size_t(width) + size_t(fx)];
        }
    return result;
}

} // namespace

void convolve(std::vector<float>& values, EvenKernel const& kernel) {
    int const w = kernel.width, h = kernel.height;
    assert(values.size() == size_t(w) * size_t(h));
    std::vector<float> weights = periodic(kernel), picture = mirrored(values, w, h);
    OIIO::ImageBuf response = transformed(weights, 2 * w, 2 * h);
    OIIO::ImageBuf spectrum = transformed(picture, 2 * w, 2 * h);
    // An even kernel's response is real. OpenImageIO scales each way by 1 / sqrt(pixels).
    double const scale = std::sqrt(4. * w * h);
    float* const s = pixels_of(spectrum);
    float const* const r = pixels_of(response);
    for (size_t i = 0; i < 8 * values.size(); i += 2) {
        float const factor = float(r[i] * scale);
        s[i] *= factor;
        s[i + 1] *= factor;
    }
    OIIO::ImageBuf result = OIIO::ImageBufAlgo::ifft(spectrum);
    if (result.has_error()) throw std::runtime_error("Fourier transform: " + result.geterror());
    int const channels = result.nchannels();
    float const* const p = pixels_of(result);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            values[size_t(y) * size_t(w) + size_t(x)] =
                p[(size_t(y) * size_t(2 * w) + size_t(x)) * size_t(channels)];
}

} // namespace weft::post
