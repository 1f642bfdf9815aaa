// Layers of an EXR file: channels whose names have a part in common, as "albedo.R", "albedo.G",
// "albedo.B" or "normal.X", "normal.Y", "normal.Z". Parts of a file are layers, too (parts.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"

namespace weft::image {

using ChannelTriple = std::array<int, 3>;

/// Returns the channels LAYER.R, LAYER.G, LAYER.B or LAYER.X, LAYER.Y, LAYER.Z; for the layer ""
/// the channels R, G, B. Letters may be small or capital.
std::optional<ChannelTriple> find_layer(std::vector<std::string> const& channels,
                                        std::string const& layer);

/// Returns the layer that guides a denoiser, or "" where there is none. It is known by its name, in
/// small or capital letters, which may follow others and a dot ("ViewLayer.Denoising Albedo"). The
/// first of these that the file has is taken: "denoise_albedo", "denoising albedo", "albedo";
/// "denoise_normal", "denoising normal", "normal", "normals", "N", "Ns", "sh_normal".
std::string find_albedo_layer(std::vector<std::string> const& channels);
std::string find_normal_layer(std::vector<std::string> const& channels);
/// Returns the layer "denoise_kept", likewise: light that a denoiser leaves as it is.
std::string find_kept_layer(std::vector<std::string> const& channels);

/// Returns whether a layer or a part that is called so is the picture itself, in the words of other
/// programs: "Combined" of Blender, "rgba" of Nuke, "beauty", "C" of Houdini, "Ci" of RenderMan.
/// Other names and dots may stand before it.
bool is_picture_name(std::string const& layer);

/// Returns the colours of the picture that the channels are of: R, G and B, or else those of the
/// first layer that is called as a picture.
std::optional<ChannelTriple> find_colors(std::vector<std::string> const& channels);

/// Returns the names of all layers of three channels, in the order of the file.
std::vector<std::string> layer_names(std::vector<std::string> const& channels);

/// Returns the colours of a picture: the three channels of `find_colors`, or where there are none
/// the first three, or the first alone of one or two.
Image colors_of(Image const& image);

/// Returns a layer by its name: three channels, or one that is called so with a letter or without.
/// Throws InputError, with the nearest known name, where there is none.
Image take_layer(Image const& image, std::string const& layer);

Image take_channels(Image const& from, ChannelTriple const& channels);
/// Writes the three channels of a picture of equal size to those of `to`.
void put_channels(Image const& three, ChannelTriple const& channels, Image& to);

} // namespace weft::image
