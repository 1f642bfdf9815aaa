// Textures made of numbers.
#pragma once

#include <cstring>
#include <memory>
#include <vector>

#include "image/texture.h"

namespace weft::testing {

/// Linear floats by rows from the top, channels interleaved, with all mip levels.
inline std::shared_ptr<image::Texture const> texture_of(int width, int height, int channels,
                                                        std::vector<float> const& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    auto texture =
        image::Texture::in_memory({image::TexelType::f32, channels, image::Transfer::linear}, width,
                                  height, std::move(bytes));
    texture.add_levels();
    return std::make_shared<image::Texture const>(std::move(texture));
}

} // namespace weft::testing
