#include "film/film.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"

namespace weft::film {

namespace {

Color mean_of(double const* sums, double samples) {
    if (samples == 0) return Color(0);
    double const scale = 1 / samples;
    return {float(sums[0] * scale), float(sums[1] * scale), float(sums[2] * scale)};
}

} // namespace

Film::Film(Region const& region, Layout const& layout) : region_(region), layout_(layout) {
    size_t const pixels = region.pixels();
    has_more_ = layout.needs_record() || layout.options().half_sums || layout.options().squares;
    sums_.resize(pixels * size_t(layout.sums()));
    counts_.resize(pixels);
    if (layout.has_nearest()) nearest_.resize(pixels);
    for (size_t i = 0; i < kCryptomattes; ++i)
        if (layout.has(kCryptomatteAovs[i])) ids_[i].resize(pixels);
}

size_t Film::bytes_per_pixel(Layout const& layout) {
    size_t bytes = size_t(layout.sums()) * sizeof(double) + sizeof(Counts);
    if (layout.has_nearest()) bytes += sizeof(Nearest);
    for (size_t i = 0; i < kCryptomattes; ++i)
        if (layout.has(kCryptomatteAovs[i])) bytes += sizeof(IdCounts);
    return bytes;
}

void Film::add_more(size_t pixel, uint32_t index, Color const& beauty, SampleRecord const* record) {
    double* const sums = &sums_[pixel * size_t(layout_.sums())];
    bool const even = layout_.options().half_sums && index % 2 == 0;
    if (even) {
        ++counts_[pixel].even;
        for (int c = 0; c < 3; ++c) sums[layout_.half_offset() + c] += double(beauty[c]);
    }
    if (layout_.options().squares)
        for (int c = 0; c < 3; ++c) {
            double const square = double(beauty[c]) * double(beauty[c]);
            sums[layout_.squares_offset() + c] += square;
            if (even) sums[layout_.squares_offset() + 3 + c] += square;
        }
    if (!record) return;
    double* to = sums + layout_.first_recorded();
    for (float const v : record->values()) *to++ += double(v);
    if (auto const* nearest = record->nearest();
        nearest && !nearest_.empty() && nearest->front() < nearest_[pixel].depth())
        nearest_[pixel].numbers = *nearest;
    for (size_t i = 0; i < kCryptomattes; ++i)
        if (!ids_[i].empty())
            if (uint32_t const id = record->cryptomatte_id(i); id != 0)
                count_id(ids_[i][pixel], id, 1);
}

void Film::count_id(IdCounts& counts, uint32_t id, uint32_t samples) {
    auto const at = std::lower_bound(counts.begin(), counts.end(), id,
                                     [](IdCount const& c, uint32_t i) { return c.id < i; });
    if (at != counts.end() && at->id == id)
        at->samples += samples;
    else
        counts.insert(at, {id, samples});
}

uint32_t Film::least_samples() const {
    auto const fewest =
        std::min_element(counts_.begin(), counts_.end(),
                         [](Counts const& a, Counts const& b) { return a.all < b.all; });
    return fewest == counts_.end() ? 0 : fewest->all;
}

Color Film::mean(int x, int y) const {
    size_t const i = pixel_index(x, y);
    return mean_of(sums(i), counts_[i].all);
}

Color Film::even_mean(int x, int y) const {
    size_t const i = pixel_index(x, y);
    return mean_of(sums(i) + layout_.half_offset(), counts_[i].even);
}

Color Film::odd_mean(int x, int y) const {
    size_t const i = pixel_index(x, y);
    double const *all = sums(i), *even = all + layout_.half_offset();
    double const odd[3]{all[0] - even[0], all[1] - even[1], all[2] - even[2]};
    return mean_of(odd, counts_[i].all - counts_[i].even);
}

Color Film::variance(int x, int y) const { return variance(pixel_index(x, y)); }

Color Film::variance(size_t pixel) const {
    double const n = counts_[pixel].all, *sum = sums(pixel),
                 *squares = sum + layout_.squares_offset();
    if (n < 2) return Color(0);
    auto const of = [&](int c) {
        double const mean = sum[c] / n;
        return float(std::max(0.0, squares[c] / n - mean * mean) / (n - 1));
    };
    return {of(0), of(1), of(2)};
}

float Film::error(int x, int y) const {
    Counts const counts = this->counts(x, y);
    if (counts.even == 0 || counts.even == counts.all) return 0;
    Color const all = mean(x, y), even = even_mean(x, y);
    float const off =
        std::abs(all.r - even.r) + std::abs(all.g - even.g) + std::abs(all.b - even.b);
    return off == 0 ? 0 : off / std::sqrt(all.r + all.g + all.b);
}

image::Image Film::mean() const {
    image::Image image = image::make_image(region_.width(), region_.height(), 3);
    for (size_t i = 0; i < counts_.size(); ++i) {
        Color const c = mean_of(sums(i), counts_[i].all);
        for (int k = 0; k < 3; ++k) image.pixels[3 * i + size_t(k)] = c[k];
    }
    return image;
}

image::Image Film::image() const {
    std::vector<std::string> names = layout_.channel_names();
    image::Image image = image::make_image(region_.width(), region_.height(), int(names.size()));
    image.names = std::move(names);
    for (size_t i = 0; i < counts_.size(); ++i)
        write_pixel(i, &image.pixels[i * size_t(image.channels)]);
    return image;
}

/// Writes all channels, in the order of Layout::channel_names.
void Film::write_pixel(size_t pixel, float* to) const {
    for (Aov aov : layout_.aovs()) to = write_aov(pixel, aov, to);
}

/// Writes the channels of one AOV and returns where the next one's begin.
float* Film::write_aov(size_t pixel, Aov aov, float* to) const {
    scene::AovInfo const& info = info_of(aov);
    double const n = counts_[pixel].all, scale = n > 0 ? 1 / n : 0;
    double const* const sum = sums(pixel) + std::max(0, layout_.offset(aov));
    switch (info.how) {
    case Accumulation::Beauty:
    case Accumulation::Mean:
    case Accumulation::MeanPerLightGroup:
    case Accumulation::MeanPerLayer:
        return std::transform(sum, sum + layout_.summed(aov), to,
                              [&](double s) { return float(s * scale); });
    case Accumulation::Ratio:
        return std::transform(
            sum, sum + info.channels(), sum + info.channels(), to,
            [](double all, double part) { return all > 0 ? float(part / all) : 1.f; });
    case Accumulation::Nearest: {
        auto const* const from = &nearest_[pixel].numbers[size_t(kNearestOffsets[size_t(aov)])];
        if (aov == Aov::depth)
            return std::copy_n(std::array{std::min(*from, kNoDepth)}.data(), 1, to);
        return std::copy_n(from, info.channels(), to);
    }
    case Accumulation::Ids:
        return write_cryptomatte(ids_[cryptomatte_index(aov)][pixel], n, to);
    case Accumulation::SampleCount:
        *to = float(n);
        return to + 1;
    case Accumulation::Variance:
        break;
    }
    Color const v = variance(pixel);
    return std::copy_n(std::array{v.r, v.g, v.b}.data(), 3, to);
}

/// Writes pairs of id and coverage, by falling coverage; ids decide between equal ones. Returns
/// where they end: layers hold two pairs each.
float* Film::write_cryptomatte(IdCounts const& counts, double samples, float* to) const {
    IdCounts ranked = counts;
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](IdCount const& a, IdCount const& b) { return a.samples > b.samples; });
    size_t const levels = std::min(ranked.size(), size_t(layout_.options().cryptomatte_levels));
    for (size_t i = 0; i < levels; ++i) {
        to[2 * i] = std::bit_cast<float>(ranked[i].id);
        to[2 * i + 1] = float(ranked[i].samples / samples);
    }
    return to + 2 * ((layout_.options().cryptomatte_levels + 1) / 2 * 2);
}

void Film::merge(Film const& part) {
    if (!(part.layout_ == layout_))
        throw InputError("expected a film with the same channels to merge with, found another");
    if (!region_.contains(part.region_))
        throw InputError("expected a film to merge with whose pixels are a part of this one's");
    size_t const width = size_t(layout_.sums());
    for (size_t i = 0; i < part.counts_.size(); ++i) {
        size_t const w = size_t(part.region_.width());
        size_t const to =
            pixel_index(part.region_.from.x + int(i % w), part.region_.from.y + int(i / w));
        counts_[to].all += part.counts_[i].all;
        counts_[to].even += part.counts_[i].even;
        for (size_t c = 0; c < width; ++c) sums_[to * width + c] += part.sums_[i * width + c];
        if (!nearest_.empty() && part.nearest_[i].depth() < nearest_[to].depth())
            nearest_[to] = part.nearest_[i];
        for (size_t k = 0; k < kCryptomattes; ++k)
            if (!ids_[k].empty())
                for (IdCount const& c : part.ids_[k][i]) count_id(ids_[k][to], c.id, c.samples);
    }
}

bool operator==(Film const& a, Film const& b) {
    return a.region_.from == b.region_.from && a.region_.to == b.region_.to &&
           a.layout_ == b.layout_ && a.sums_ == b.sums_ && a.counts_ == b.counts_ &&
           a.nearest_ == b.nearest_ && a.ids_ == b.ids_;
}

} // namespace weft::film
