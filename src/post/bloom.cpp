#include "post/bloom.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "post/apply.h"
#include "schema/text.h"

namespace weft::post {

namespace {

/// Spencer et al.'s wide components, but for a common factor; `t` in degrees.
double scattered(double t) {
    double const d = t + 0.02;
    return 0.478 * 20.91 / (d * d * d) + 0.138 * 72.37 / (d * d);
}

/// How finely a pixel is divided for its mean: the spike in the middle is narrower than a pixel.
int subdivision(int distance) {
    if (distance == 0) return 64;
    return distance <= 3 ? 16 : distance <= 16 ? 4 : 1;
}

image::Image colors_of(image::Image const& image, int colors) {
    image::Image result = image::make_image(image.width, image.height, colors);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            bool finite = true;
            for (int c = 0; c < colors; ++c) finite &= std::isfinite(image.at(x, y, c));
            for (int c = 0; c < colors; ++c) result.at(x, y, c) = finite ? image.at(x, y, c) : 0;
        }
    return result;
}

/// Leaves of each pixel what its largest channel has beyond `threshold`.
void keep_bright(image::Image& image, float threshold) {
    for (size_t i = 0; i < image.pixels.size(); i += size_t(image.channels)) {
        auto const begin = image.pixels.begin() + std::ptrdiff_t(i), end = begin + image.channels;
        float const largest = *std::max_element(begin, end);
        float const part = largest > threshold ? (largest - threshold) / largest : 0;
        for (auto p = begin; p != end; ++p) *p = std::max(*p, 0.f) * part;
    }
}

void convolve_channels(image::Image& image, EvenKernel const& kernel) {
    std::vector<float> values(image.pixels.size() / size_t(image.channels));
    for (int c = 0; c < image.channels; ++c) {
        auto at = [&](size_t i) { return i * size_t(image.channels) + size_t(c); };
        for (size_t i = 0; i < values.size(); ++i) values[i] = image.pixels[at(i)];
        bool const positive =
            std::all_of(values.begin(), values.end(), [](float v) { return v >= 0; });
        convolve(values, kernel);
        // Of light alone there cannot come less than none, but for rounding.
        for (size_t i = 0; i < values.size(); ++i)
            image.pixels[at(i)] = positive ? std::max(values[i], 0.f) : values[i];
    }
}

} // namespace

EvenKernel glare_kernel(int width, int height, float fov) {
    EvenKernel kernel{width, height, {}};
    kernel.weights.resize(size_t(width + 1) * size_t(height + 1));
    double const degrees = double(fov) / width; // of a pixel
    tbb::parallel_for(tbb::blocked_range<int>(0, height + 1), [&](auto const& rows) {
        for (int y = rows.begin(); y != rows.end(); ++y)
            for (int x = 0; x <= width; ++x) {
                int const n = subdivision(std::max(x, y));
                double sum = 0;
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i)
                        sum += scattered(
                            degrees * std::hypot(x + (i + 0.5) / n - 0.5, y + (j + 0.5) / n - 0.5));
                kernel.weights[size_t(y) * size_t(width + 1) + size_t(x)] = float(sum / (n * n));
            }
    });
    return kernel;
}

EvenKernel gaussian_kernel(int width, int height, float sigma, int radius) {
    EvenKernel kernel{width, height, {}};
    kernel.weights.resize(size_t(width + 1) * size_t(height + 1));
    for (int y = 0; y <= std::min(height, radius); ++y)
        for (int x = 0; x <= std::min(width, radius); ++x)
            kernel.weights[size_t(y) * size_t(width + 1) + size_t(x)] =
                float(std::exp(-(double(x) * x + double(y) * y) / (2. * sigma * sigma)));
    return kernel;
}

image::Image apply_bloom(scene::Bloom const& bloom, image::Image const& image) {
    int const colors = image.channels >= 3 ? 3 : 1;
    bool const glare = bloom.kind == scene::BloomKind::glare;
    image::Image light = colors_of(image, colors);
    if (!glare) keep_bright(light, bloom.threshold);
    int const radius =
        bloom.radius > 0 ? bloom.radius : std::max(1, int(std::ceil(4 * bloom.sigma)));
    convolve_channels(light, glare
                                 ? glare_kernel(image.width, image.height, bloom.fov)
                                 : gaussian_kernel(image.width, image.height, bloom.sigma, radius));
    float const stays = glare ? 1 - bloom.strength : 1;
    float const added = glare ? bloom.strength : bloom.intensity;
    image::Image result = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < colors; ++c) {
                float& value = result.at(x, y, c);
                if (std::isfinite(value)) value = stays * value + added * light.at(x, y, c);
            }
    return result;
}

Applied apply(scene::Bloom const& bloom, Inputs const& inputs) {
    return {apply_bloom(bloom, inputs.colors(bloom.input)),
            "bloom (" + schema::TextForm<scene::BloomKind>::write(bloom.kind) + ")"};
}

} // namespace weft::post
