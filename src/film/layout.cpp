#include "film/layout.h"

#include <algorithm>

namespace weft::film {

namespace {

/// Returns the names of an AOV's channels, or of one of its pictures, in that layer of the file.
std::vector<std::string> names_in(std::string const& layer, std::string_view letters) {
    if (letters.empty()) return {layer};
    std::vector<std::string> names;
    for (char c : letters) names.push_back(layer.empty() ? std::string(1, c) : layer + "." + c);
    return names;
}

/// Returns the names of the channels of one picture per name.
std::vector<std::string> names_per(std::vector<std::string> const& all,
                                   scene::AovInfo const& info) {
    std::vector<std::string> names;
    for (std::string const& one : all)
        for (std::string& n : names_in(std::string(info.layer) + one, info.letters))
            names.push_back(std::move(n));
    return names;
}

/// Two ranks of a Cryptomatte share a layer of four channels.
std::vector<std::string> cryptomatte_names(scene::AovInfo const& info, int levels) {
    std::vector<std::string> names;
    for (int layer = 0; 2 * layer < levels; ++layer) {
        std::string const number = (layer < 10 ? "0" : "") + std::to_string(layer);
        for (std::string& n : names_in(std::string(info.layer) + number, "RGBA"))
            names.push_back(std::move(n));
    }
    return names;
}

std::vector<std::string> names_of(Aov aov, LayoutOptions const& options) {
    scene::AovInfo const& info = info_of(aov);
    switch (info.how) {
    case Accumulation::Ids:
        return cryptomatte_names(info, options.cryptomatte_levels);
    case Accumulation::MeanPerLightGroup:
        return names_per(options.light_groups, info);
    case Accumulation::MeanPerLayer:
        return names_per(options.layers, info);
    case Accumulation::Beauty:
    case Accumulation::Mean:
    case Accumulation::Ratio:
    case Accumulation::Nearest:
    case Accumulation::SampleCount:
    case Accumulation::Variance:
        break;
    }
    return names_in(std::string(info.layer), info.letters);
}

} // namespace

Layout::Layout(std::span<Aov const> aovs, LayoutOptions options) : options_(std::move(options)) {
    offsets_.fill(-1);
    there_[size_t(Aov::beauty)] = true;
    for (Aov aov : aovs) there_[size_t(aov)] = true;
    options_.squares |= has(Aov::variance);
    there_[size_t(Aov::denoise_kept)] |= has(Aov::denoise_albedo) || has(Aov::denoise_normal);
    // What is not asked for leaves no trace: equal layouts are layouts of equal films.
    if (!has(Aov::light_groups)) options_.light_groups = {kDefaultGroup};
    if (!has(Aov::layers)) options_.layers = {kDefaultGroup};
    int const halves = options_.half_sums ? 2 : 1;
    first_recorded_ = 3 * halves * (options_.squares ? 2 : 1);
    sums_ = first_recorded_;
    offsets_[size_t(Aov::beauty)] = 0;
    for (Aov const aov : this->aovs()) {
        scene::AovInfo const& info = info_of(aov);
        has_light_ |= info.source == AovSource::Contribution;
        has_surface_ |= info.source == AovSource::FirstSurface || info.source == AovSource::Guides;
        has_nearest_ |= info.how == Accumulation::Nearest;
        has_cryptomatte_ |= info.how == Accumulation::Ids;
        if (aov == Aov::beauty || summed(aov) == 0) continue;
        offsets_[size_t(aov)] = sums_;
        sums_ += summed(aov);
    }
    if (!has_cryptomatte_) options_.cryptomatte_levels = LayoutOptions().cryptomatte_levels;
}

int Layout::summed(Aov aov) const {
    scene::AovInfo const& info = info_of(aov);
    switch (info.how) {
    case Accumulation::Beauty:
    case Accumulation::Mean:
        return info.channels();
    case Accumulation::MeanPerLightGroup:
        return info.channels() * int(options_.light_groups.size());
    case Accumulation::MeanPerLayer:
        return info.channels() * int(options_.layers.size());
    case Accumulation::Ratio:
        return 2 * info.channels();
    case Accumulation::Nearest:
    case Accumulation::Ids:
    case Accumulation::SampleCount:
    case Accumulation::Variance:
        break;
    }
    return 0;
}

std::vector<Aov> Layout::aovs() const {
    std::vector<Aov> there;
    for (size_t i = 0; i < kAovCount; ++i)
        if (has(Aov(i))) there.push_back(Aov(i));
    return there;
}

std::vector<std::string> Layout::channel_names() const {
    std::vector<std::string> names;
    for (Aov aov : aovs())
        for (std::string& n : names_of(aov, options_)) names.push_back(std::move(n));
    return names;
}

} // namespace weft::film
