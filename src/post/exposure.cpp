#include "post/exposure.h"

#include <algorithm>

namespace weft::post {

float auto_exposure(image::Image const& color) {
    constexpr int kBlock = 16;
    constexpr double kKey = 0.18, kBlack = 1e-8;
    int const columns = std::max(1, (color.width + kBlock / 2) / kBlock),
              rows = std::max(1, (color.height + kBlock / 2) / kBlock);
    auto bound = [](int i, int count, int size) { return int(int64_t(i) * size / count); };
    double logs = 0;
    int count = 0;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            int const x0 = bound(i, columns, color.width), x1 = bound(i + 1, columns, color.width);
            int const y0 = bound(j, rows, color.height), y1 = bound(j + 1, rows, color.height);
            double sum = 0;
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x) {
                    float const* p = &color.pixels[color.index(x, y, 0)];
                    sum += 0.2126 * double(sane(p[0])) + 0.7152 * double(sane(p[1])) +
                           0.0722 * double(sane(p[2]));
                }
            double const mean = sum / (double(x1 - x0) * (y1 - y0));
            if (!(mean > kBlack)) continue;
            logs += std::log2(mean);
            ++count;
        }
    return count > 0 ? float(kKey / std::exp2(logs / count)) : 1.f;
}

} // namespace weft::post
