#include "image/layers.h"

#include <algorithm>
#include <cctype>
#include <span>

namespace weft::image {

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

bool is_picture_name(std::string const& layer) {
    static constexpr char const* names[] = {"combined", "beauty", "rgba",  "rgb",  "c",
                                            "ci",       "color",  "image", "main", "default"};
    std::string const last = lower(layer.substr(layer.rfind('.') + 1));
    return std::find(std::begin(names), std::end(names), last) != std::end(names);
}

std::optional<ChannelTriple> find_colors(std::vector<std::string> const& channels) {
    if (auto const plain = find_layer(channels, "")) return plain;
    for (std::string const& layer : layer_names(channels))
        if (is_picture_name(layer)) return find_layer(channels, layer);
    return std::nullopt;
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

Image colors_of(Image const& image) {
    if (auto const colors = find_colors(image.names)) return take_channels(image, *colors);
    if (image.channels >= 3) return take_channels(image, {0, 1, 2});
    Image result = make_image(image.width, image.height, 1);
    result.is_srgb_encoded = image.is_srgb_encoded;
    for (size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] = image.pixels[i * size_t(image.channels)];
    return result;
}

Image take_layer(Image const& image, std::string const& layer) {
    if (auto const three = find_layer(image.names, layer)) return take_channels(image, *three);
    std::vector<std::string> known;
    for (size_t i = 0; i < image.names.size(); ++i) {
        std::string const& name = image.names[i];
        std::string const of = split(name).layer;
        if (name == layer || of == layer) {
            Image one = make_image(image.width, image.height, 1);
            for (size_t k = 0; k < one.pixels.size(); ++k)
                one.pixels[k] = image.pixels[k * size_t(image.channels) + i];
            return one;
        }
        known.push_back(of.empty() ? name : of);
    }
    throw InputError("expected a layer '" + layer + "'" + suggestion(layer, known));
}

Image take_channels(Image const& from, ChannelTriple const& channels) {
    Image result = make_image(from.width, from.height, 3);
    result.is_srgb_encoded = from.is_srgb_encoded;
    result.is_converted = from.is_converted;
    for (int y = 0; y < from.height; ++y)
        for (int x = 0; x < from.width; ++x)
            for (int c = 0; c < 3; ++c) result.at(x, y, c) = from.at(x, y, channels[size_t(c)]);
    return result;
}

void put_channels(Image const& three, ChannelTriple const& channels, Image& to) {
    for (int y = 0; y < to.height; ++y)
        for (int x = 0; x < to.width; ++x)
            for (int c = 0; c < 3; ++c) to.at(x, y, channels[size_t(c)]) = three.at(x, y, c);
}

} // namespace weft::image
