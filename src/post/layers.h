// Layers of an EXR file: channels whose names have a part in common, as "albedo.R", "albedo.G",
// "albedo.B" or "normal.X", "normal.Y", "normal.Z".
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"

namespace weft::post {

using ChannelTriple = std::array<int, 3>;

/// The channels LAYER.R, LAYER.G, LAYER.B or LAYER.X, LAYER.Y, LAYER.Z; for "" R, G, B alone.
/// Letters may be small or capital.
std::optional<ChannelTriple> find_layer(std::vector<std::string> const& channels,
                                        std::string const& layer);

/// The layer that is called what renderers call the guides of denoisers, or else the albedo or the
/// normals, in any case and whatever stands before it and a dot ("ViewLayer.Denoising Albedo"); ""
/// where there is none. In this order: "denoise_albedo", "denoising albedo", "albedo";
/// "denoise_normal", "denoising normal", "normal", "normals", "N", "Ns", "sh_normal".
std::string find_albedo_layer(std::vector<std::string> const& channels);
std::string find_normal_layer(std::vector<std::string> const& channels);

/// All layers of three channels, in the order of the file.
std::vector<std::string> layer_names(std::vector<std::string> const& channels);

image::Image take_channels(image::Image const& from, ChannelTriple const& channels);
/// The other way: of equal size.
void put_channels(image::Image const& three, ChannelTriple const& channels, image::Image& to);

} // namespace weft::post
