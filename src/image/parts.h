// The parts of an image file, and which of their channels are wanted.
//
// Programs write layers in two ways: as channels with names of their own ("albedo.R"), or as parts
// of a file that are called so. Here both are one: the channels of a part get its name, where they
// have no other and it is not the part of the picture itself.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

namespace weft::image {

struct FileParts {
    /// Of each part; other formats than EXR have one.
    std::vector<OIIO::ImageSpec> specs;
    std::vector<std::string> names;
    std::vector<std::vector<std::string>> channels; ///< of each part, as they are called together
    size_t picture = 0; ///< the part that holds the picture, or else the first

    /// Returns whether the part's pixels lie where those of the picture do, so that both are
    /// channels of one image.
    bool joins(size_t part) const;
};

FileParts parts_of(OIIO::ImageInput& input);

/// Channels of one part, side by side.
struct ChannelRange {
    int part = 0, first = 0, count = 0;
};

/// Returns the channels of the layer, three or one; for the layer "" those of the picture. Throws
/// InputError, with the layers that there are, where none is called so, or where it is not plain
/// which one is the picture.
ChannelRange find_channels(FileParts const& parts, std::string const& layer,
                           std::string const& path);

/// A file's name and that of a layer in it.
struct LayerPath {
    std::string file, layer;
};

/// Splits "picture.exr:albedo" where there is no file of the whole name. The layer of any other
/// path is "".
LayerPath split_layer(std::string const& path);

} // namespace weft::image
