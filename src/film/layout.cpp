#include "film/layout.h"

#include <algorithm>

namespace weft::film {

namespace {

bool is_of_light(Aov aov) { return (aov >= Aov::emission && aov <= Aov::layers); }

bool is_nearest(Aov aov) { return aov == Aov::depth || aov == Aov::position || aov == Aov::uv; }

bool is_cryptomatte(Aov aov) {
    return aov == Aov::crypto_object || aov == Aov::crypto_material || aov == Aov::crypto_asset;
}

bool is_of_surface(Aov aov) {
    return is_nearest(aov) || is_cryptomatte(aov) || aov == Aov::alpha || aov == Aov::normal ||
           aov == Aov::normal_geometric || aov == Aov::albedo || aov == Aov::denoise_albedo ||
           aov == Aov::denoise_normal;
}

/// The names of an AOV's channels behind its layer's.
std::vector<std::string> names_of(std::string const& layer, std::string_view letters) {
    std::vector<std::string> names;
    for (char c : letters) names.push_back(layer + "." + c);
    return names;
}

/// One picture by each name.
std::vector<std::string> colors_of(std::string const& prefix,
                                   std::vector<std::string> const& layers) {
    std::vector<std::string> names;
    for (std::string const& layer : layers)
        for (std::string& n : names_of(prefix + layer, "RGB")) names.push_back(std::move(n));
    return names;
}

/// Two ranks of a Cryptomatte share a layer of four channels.
std::vector<std::string> cryptomatte_channels(std::string const& name, int levels) {
    std::vector<std::string> names;
    for (int layer = 0; 2 * layer < levels; ++layer) {
        std::string const number = (layer < 10 ? "0" : "") + std::to_string(layer);
        for (std::string& n : names_of(name + number, "RGBA")) names.push_back(std::move(n));
    }
    return names;
}

std::vector<std::string> channels_of(Aov aov, LayoutOptions const& options) {
    std::string const layer(scene::kAovs[size_t(aov)].name);
    switch (aov) {
    case Aov::beauty:
        return {"R", "G", "B"};
    case Aov::alpha:
        return {"A"};
    case Aov::depth:
        return {"Z"};
    case Aov::position:
        return names_of("P", "XYZ");
    case Aov::normal:
        return names_of("N", "XYZ");
    case Aov::normal_geometric:
        return names_of("Ng", "XYZ");
    case Aov::uv:
        return names_of("UV", "UV");
    case Aov::denoise_normal:
        return names_of(layer, "XYZ");
    case Aov::sample_count:
        return {layer};
    case Aov::crypto_object:
    case Aov::crypto_material:
    case Aov::crypto_asset:
        return cryptomatte_channels(cryptomatte_name(aov), options.cryptomatte_levels);
    case Aov::light_groups:
        return colors_of("light_", options.light_groups);
    case Aov::layers:
        return colors_of("layer_", options.layers);
    default:
        return names_of(layer, "RGB");
    }
}

} // namespace

int summed_numbers(Aov aov) {
    if (is_nearest(aov) || is_cryptomatte(aov)) return 0;
    if (aov == Aov::sample_count || aov == Aov::variance) return 0;
    if (aov == Aov::shadow_catcher) return 6; // the light with and without other instances
    return aov == Aov::alpha ? 1 : 3;
}

std::string cryptomatte_name(Aov aov) {
    switch (aov) {
    case Aov::crypto_object:
        return "CryptoObject";
    case Aov::crypto_material:
        return "CryptoMaterial";
    case Aov::crypto_asset:
        return "CryptoAsset";
    default:
        return "";
    }
}

Layout::Layout(std::span<Aov const> aovs, LayoutOptions options) : options_(std::move(options)) {
    offsets_.fill(-1);
    there_[size_t(Aov::beauty)] = true;
    for (Aov aov : aovs) there_[size_t(aov)] = true;
    options_.squares |= has(Aov::variance);
    // What is not asked for leaves no trace: equal layouts are layouts of equal films.
    if (!has(Aov::light_groups)) options_.light_groups = {kDefaultGroup};
    if (!has(Aov::layers)) options_.layers = {kDefaultGroup};
    int const halves = options_.half_sums ? 2 : 1;
    first_recorded_ = 3 * halves * (options_.squares ? 2 : 1);
    sums_ = first_recorded_;
    offsets_[size_t(Aov::beauty)] = 0;
    for (size_t i = 0; i < kAovCount; ++i) {
        Aov const aov = Aov(i);
        if (!has(aov)) continue;
        has_light_ |= is_of_light(aov);
        has_surface_ |= is_of_surface(aov);
        has_nearest_ |= is_nearest(aov);
        has_cryptomatte_ |= is_cryptomatte(aov);
        if (aov == Aov::beauty || summed_numbers(aov) == 0) continue;
        offsets_[i] = sums_;
        sums_ += summed(aov);
    }
    if (!has_cryptomatte_) options_.cryptomatte_levels = LayoutOptions().cryptomatte_levels;
}

int Layout::summed(Aov aov) const {
    size_t const pictures = aov == Aov::light_groups ? options_.light_groups.size()
                            : aov == Aov::layers     ? options_.layers.size()
                                                     : 1;
    return summed_numbers(aov) * int(pictures);
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
        for (std::string& n : channels_of(aov, options_)) names.push_back(std::move(n));
    return names;
}

} // namespace weft::film
