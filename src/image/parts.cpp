#include "image/parts.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "image/layers.h"

namespace weft::image {

namespace {

/// Returns the part that is called as a picture is, or else the first whose colours have no layer
/// and are no guide of a denoiser.
size_t picture_part(FileParts const& parts) {
    for (size_t i = 0; i < parts.specs.size(); ++i)
        if (is_picture_name(parts.names[i]) && find_colors(parts.specs[i].channelnames)) return i;
    for (size_t i = 0; i < parts.specs.size(); ++i) {
        std::vector<std::string> const as_layer{parts.names[i] + ".R", parts.names[i] + ".G",
                                                parts.names[i] + ".B"};
        if (find_layer(parts.specs[i].channelnames, "") && find_albedo_layer(as_layer).empty() &&
            find_normal_layer(as_layer).empty())
            return i;
    }
    return 0;
}

std::vector<std::string> names_together(FileParts const& parts, size_t part) {
    std::vector<std::string> names = parts.specs[part].channelnames;
    if (part == parts.picture || parts.names[part].empty()) return names;
    for (std::string& name : names)
        if (name.find('.') == std::string::npos) name = parts.names[part] + "." + name;
    return names;
}

std::string listed(FileParts const& parts) {
    std::vector<std::string> layers;
    for (auto const& channels : parts.channels)
        for (std::string const& channel : channels) {
            std::string const layer = channel.substr(0, channel.rfind('.'));
            if (std::find(layers.begin(), layers.end(), layer) == layers.end())
                layers.push_back(layer);
        }
    std::string text;
    for (std::string const& layer : layers) text += (text.empty() ? "'" : ", '") + layer + "'";
    return text;
}

bool are_side_by_side(ChannelTriple const& t) { return t[1] == t[0] + 1 && t[2] == t[0] + 2; }

} // namespace

bool FileParts::joins(size_t part) const {
    OIIO::ImageSpec const &a = specs[part], &b = specs[picture];
    return !a.deep && a.width == b.width && a.height == b.height && a.x == b.x && a.y == b.y;
}

FileParts parts_of(OIIO::ImageInput& input) {
    FileParts parts;
    parts.specs.push_back(input.spec(0, 0));
    bool const exr = std::string_view(input.format_name()) == "openexr";
    for (int i = 1; exr && input.seek_subimage(i, 0); ++i) parts.specs.push_back(input.spec(i, 0));
    (void)input.geterror(); // of the part after the last
    for (OIIO::ImageSpec const& spec : parts.specs)
        parts.names.emplace_back(spec.get_string_attribute("oiio:subimagename"));
    for (size_t i = 1; i < parts.names.size(); ++i)
        if (parts.names[i].empty()) parts.names[i] = "part" + std::to_string(i + 1);
    if (parts.specs.size() > 1) parts.picture = picture_part(parts);
    for (size_t i = 0; i < parts.specs.size(); ++i)
        parts.channels.push_back(names_together(parts, i));
    return parts;
}

ChannelRange find_channels(FileParts const& parts, std::string const& layer,
                           std::string const& path) {
    for (size_t i = 0; i < parts.specs.size(); ++i) {
        if (layer.empty() && i != parts.picture) continue;
        auto const& names = parts.channels[i];
        auto const colors = layer.empty() ? find_colors(names) : find_layer(names, layer);
        if (colors && are_side_by_side(*colors)) return {int(i), (*colors)[0], 3};
        if (colors)
            throw InputError({path}, "expected the channels of '" + layer + "' side by side");
        auto const one = std::find_if(names.begin(), names.end(), [&](std::string const& name) {
            return layer.empty() ? name == "Y" && names.front() != "X"
                                 : name == layer || name.substr(0, name.rfind('.')) == layer;
        });
        if (one != names.end()) return {int(i), int(one - names.begin()), 1};
    }
    if (!layer.empty())
        throw InputError({path}, "expected a layer '" + layer + "', found " + listed(parts));
    OIIO::ImageSpec const& spec = parts.specs[parts.picture];
    bool const plain = std::all_of(spec.channelnames.begin(), spec.channelnames.end(),
                                   [](auto& n) { return n.find('.') == std::string::npos; });
    if (!plain)
        throw InputError({path}, "expected a picture, found the layers " + listed(parts) + "; '" +
                                     std::filesystem::path(path).filename().string() +
                                     ":NAME' takes one of them");
    return {int(parts.picture), 0, spec.nchannels >= 3 ? 3 : 1};
}

LayerPath split_layer(std::string const& path) {
    size_t const colon = path.rfind(':');
    if (colon == std::string::npos || std::filesystem::exists(path)) return {path, ""};
    std::string const file = path.substr(0, colon);
    std::string extension = std::filesystem::path(file).extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (extension != ".exr") return {path, ""};
    return {file, path.substr(colon + 1)};
}

} // namespace weft::image
