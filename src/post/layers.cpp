#include "post/layers.h"

#include <algorithm>
#include <cctype>
#include <span>

namespace weft::post {

namespace {

std::string lower(std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// "a.b.R" is the layer "a.b" and the component "r".
struct SplitName {
    std::string layer, component;
};
SplitName split(std::string const& channel) {
    size_t const dot = channel.rfind('.');
    if (dot == std::string::npos) return {"", lower(channel)};
    return {channel.substr(0, dot), lower(channel.substr(dot + 1))};
}

std::string find_named(std::vector<std::string> const& channels,
                       std::span<char const* const> names) {
    auto const layers = layer_names(channels);
    for (char const* name : names)
        for (std::string const& layer : layers)
            if (lower(layer.substr(layer.rfind('.') + 1)) == name) return layer;
    return "";
}

} // namespace

std::optional<ChannelTriple> find_layer(std::vector<std::string> const& channels,
                                        std::string const& layer) {
    for (char const* components : {"rgb", "xyz"}) {
        ChannelTriple found{-1, -1, -1};
        for (size_t i = 0; i < channels.size(); ++i) {
            SplitName const name = split(channels[i]);
            for (size_t c = 0; c < 3; ++c)
                if (name.layer == layer && name.component == std::string(1, components[c]))
                    found[c] = int(i);
        }
        if (std::all_of(found.begin(), found.end(), [](int i) { return i >= 0; })) return found;
        if (layer.empty()) break;
    }
    return std::nullopt;
}

std::vector<std::string> layer_names(std::vector<std::string> const& channels) {
    std::vector<std::string> layers;
    for (std::string const& channel : channels) {
        std::string const layer = split(channel).layer;
        if (!layer.empty() && std::find(layers.begin(), layers.end(), layer) == layers.end() &&
            find_layer(channels, layer))
            layers.push_back(layer);
    }
    return layers;
}

std::string find_albedo_layer(std::vector<std::string> const& channels) {
    static constexpr char const* names[] = {"denoise_albedo", "denoising albedo", "albedo"};
    return find_named(channels, names);
}

std::string find_normal_layer(std::vector<std::string> const& channels) {
    static constexpr char const* names[] = {
        "denoise_normal", "denoising normal", "normal", "normals", "n", "ns", "sh_normal"};
    return find_named(channels, names);
}

std::string find_kept_layer(std::vector<std::string> const& channels) {
    static constexpr char const* names[] = {"denoise_kept"};
    return find_named(channels, names);
}

image::Image take_channels(image::Image const& from, ChannelTriple const& channels) {
    image::Image result = image::make_image(from.width, from.height, 3);
    for (int y = 0; y < from.height; ++y)
        for (int x = 0; x < from.width; ++x)
            for (int c = 0; c < 3; ++c) result.at(x, y, c) = from.at(x, y, channels[size_t(c)]);
    return result;
}

void put_channels(image::Image const& three, ChannelTriple const& channels, image::Image& to) {
    for (int y = 0; y < to.height; ++y)
        for (int x = 0; x < to.width; ++x)
            for (int c = 0; c < 3; ++c) to.at(x, y, channels[size_t(c)]) = three.at(x, y, c);
}

} // namespace weft::post
