#include "image/compare.h"

#include <algorithm>
#include <cmath>

#include "image/layers.h"

namespace weft::image {

namespace {

/// The channels that hold the colour.
std::vector<int> color_channels(Image const& image) {
    if (auto const found = find_colors(image.names)) return {found->begin(), found->end()};
    if (image.channels >= 3) return {0, 1, 2};
    return {0};
}

std::string describe(Image const& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels of " +
           std::to_string(color_channels(image).size()) + " colour channels";
}

void check_comparable(Image const& a, Image const& b) {
    if (a.width != b.width || a.height != b.height ||
        color_channels(a).size() != color_channels(b).size())
        throw InputError("images differ in shape: expected " + describe(b) + ", found " +
                         describe(a));
}

/// Adds up differences, and makes means of them.
class Sums {
  public:
    void add(double a, double b) {
        if (!std::isfinite(a) || !std::isfinite(b)) {
            bool const same = a == b || (std::isnan(a) && std::isnan(b));
            if (!same || !allow_same_) ++d_.non_finite;
            return;
        }
        double const e = a - b;
        d_.mse += e * e;
        d_.rel_mse += e * e / (b * b + 0.01);
        d_.mae += std::abs(e);
        d_.me += e;
        d_.max = std::max(d_.max, std::abs(e));
        ++count_;
    }
    Difference means() {
        if (count_ > 0)
            for (double* sum : {&d_.mse, &d_.rel_mse, &d_.mae, &d_.me}) *sum /= double(count_);
        return d_;
    }
    /// `allow_same`: infinity is no mistake where both have it, as depths of the sky.
    explicit Sums(bool allow_same) : allow_same_(allow_same) {}

  private:
    Difference d_;
    size_t count_ = 0;
    bool allow_same_;
};

void add_channel(Image const& a, int of_a, Image const& b, int of_b, Sums& sums) {
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            sums.add(double(a.at(x, y, of_a)), double(b.at(x, y, of_b)));
}

/// Names of the channels, by their places; numbers where an image has no names.
std::vector<std::string> names_of(Image const& image) {
    if (!image.names.empty()) return image.names;
    std::vector<std::string> names;
    for (int i = 0; i < image.channels; ++i) names.push_back("channel " + std::to_string(i));
    return names;
}

} // namespace

Difference compare(Image const& image, Image const& reference) {
    check_comparable(image, reference);
    std::vector<int> const of_a = color_channels(image), of_b = color_channels(reference);
    Sums sums(false);
    for (size_t i = 0; i < of_a.size(); ++i) add_channel(image, of_a[i], reference, of_b[i], sums);
    return sums.means();
}

std::vector<ChannelDifference> compare_channels(Image const& image, Image const& reference,
                                                bool colors) {
    if (image.width != reference.width || image.height != reference.height)
        throw InputError("images differ in shape: expected " + describe(reference) + ", found " +
                         describe(image));
    std::vector<std::string> const names_a = names_of(image), names_b = names_of(reference);
    auto const left_out = [&](Image const& of, int channel) {
        std::vector<int> const c = color_channels(of);
        return !colors && std::find(c.begin(), c.end(), channel) != c.end();
    };
    std::vector<ChannelDifference> result;
    for (int b = 0; b < reference.channels; ++b) {
        if (left_out(reference, b)) continue;
        auto const found = std::find(names_a.begin(), names_a.end(), names_b[size_t(b)]);
        ChannelDifference c{names_b[size_t(b)], found != names_a.end(), true, {}};
        if (c.in_image) {
            Sums sums(true);
            add_channel(image, int(found - names_a.begin()), reference, b, sums);
            c.difference = sums.means();
        }
        result.push_back(c);
    }
    for (int a = 0; a < image.channels; ++a)
        if (!left_out(image, a) &&
            std::find(names_b.begin(), names_b.end(), names_a[size_t(a)]) == names_b.end())
            result.push_back({names_a[size_t(a)], true, false, {}});
    return result;
}

Image difference_image(Image const& image, Image const& reference) {
    check_comparable(image, reference);
    std::vector<int> const of_a = color_channels(image), of_b = color_channels(reference);
    int const colors = int(of_a.size());
    Image result = make_image(image.width, image.height, colors);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < colors; ++c)
                result.at(x, y, c) =
                    image.at(x, y, of_a[size_t(c)]) - reference.at(x, y, of_b[size_t(c)]);
    return result;
}

} // namespace weft::image
