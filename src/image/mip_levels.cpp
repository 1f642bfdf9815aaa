#include "image/mip_levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace weft::image {

namespace {

/// The code whose number is nearest to `value`; of two the smaller. Tables grow.
size_t nearest_code(std::span<float const> table, float value) {
    auto const it = std::lower_bound(table.begin(), table.end(), value);
    if (it == table.begin()) return 0;
    size_t const i = size_t(it - table.begin());
    if (it == table.end()) return table.size() - 1;
    return value - table[i - 1] <= table[i] - value ? i - 1 : i;
}

} // namespace

int level_count(int width, int height) {
    int count = 1;
    for (; width > 1 || height > 1; ++count) {
        width = half_size(width);
        height = half_size(height);
    }
    return count;
}

LevelReducer::LevelReducer(TexelFormat format, int width, int height)
    : format_(format), width_(width), height_(height), table_(decode_table(format)),
      horizontal_(make_taps(width)), vertical_(make_taps(height)) {}

/// Texel i of n' = floor(n / 2) covers [i, i + 1) n / n' of the larger level.
std::vector<LevelReducer::Taps> LevelReducer::make_taps(int size) {
    int const smaller = half_size(size);
    std::vector<Taps> all(static_cast<size_t>(smaller));
    double const scale = double(size) / smaller;
    for (int i = 0; i < smaller; ++i) {
        double const from = i * scale, to = (i + 1) * scale;
        Taps& taps = all[size_t(i)];
        taps.first = int(from);
        int const end = std::min(size, int(std::ceil(to - 1e-9)));
        taps.count = std::min(end - taps.first, 3);
        for (int k = 0; k < taps.count; ++k)
            taps.weight[k] = float((std::min<double>(to, taps.first + k + 1) -
                                    std::max<double>(from, taps.first + k)) /
                                   scale);
    }
    return all;
}

void LevelReducer::reduce(Taps const& taps, std::byte const* const* rows, std::byte* out) const {
    std::vector<float> values(size_t(width()) * size_t(format_.channels));
    match_format(format_, [&]<TexelType type, int channels>() {
        for (int x = 0; x < width(); ++x) {
            Taps const& h = horizontal_[size_t(x)];
            decltype(load_texel<type, channels>(nullptr, nullptr)) sum{};
            for (int j = 0; j < taps.count; ++j)
                for (int i = 0; i < h.count; ++i)
                    sum += load_texel<type, channels>(
                               rows[j] + size_t(h.first + i) * format_.bytes(), table_.data()) *
                           (taps.weight[j] * h.weight[i]);
            if constexpr (channels == 1)
                values[size_t(x)] = sum;
            else
                for (int c = 0; c < 3; ++c) values[size_t(3 * x + c)] = sum[c];
        }
    });
    encode(values.data(), int(values.size()), out);
}

void LevelReducer::encode(float const* values, int count, std::byte* out) const {
    switch (format_.type) {
    case TexelType::u8: {
        auto* codes = reinterpret_cast<uint8_t*>(out);
        for (int i = 0; i < count; ++i) codes[i] = uint8_t(nearest_code(table_, values[i]));
        break;
    }
    case TexelType::u16: {
        auto* codes = reinterpret_cast<uint16_t*>(out);
        for (int i = 0; i < count; ++i) codes[i] = uint16_t(nearest_code(table_, values[i]));
        break;
    }
    case TexelType::f16: {
        auto* halves = reinterpret_cast<uint16_t*>(out);
        for (int i = 0; i < count; ++i) halves[i] = imath_float_to_half(values[i]);
        break;
    }
    case TexelType::f32:
        std::memcpy(out, values, size_t(count) * sizeof(float));
        break;
    }
}

} // namespace weft::image
