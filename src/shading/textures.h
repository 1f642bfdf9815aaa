// Textures as the render reads them: constants are already folded into their inputs, images are
// lookups (image_lookup.h).
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "base/match.h"
#include "scene/texture.h"
#include "shading/image_lookup.h"

namespace weft::shading {

struct CheckerboardLookup {
    Color color0, color1;
    Vec2 scale;

    Color at(Vec2 uv) const {
        float const cell = std::floor(uv.x * scale.x) + std::floor(uv.y * scale.y);
        return std::fmod(cell, 2.f) == 0 ? color0 : color1;
    }
};

struct ConstantLookup {
    Color value;
    Color at(Vec2) const { return value; }
};

class Textures {
  public:
    Textures() = default;
    Textures(std::vector<scene::Texture> const& textures,
             std::vector<std::shared_ptr<image::Image const>> const& images);

    Color at(scene::TextureId id, Vec2 uv) const {
        return match(lookups_[size_t(id.index)], [&](auto const& l) { return l.at(uv); });
    }
    Color at(scene::Input<Color> const& input, Vec2 uv) const {
        return input.texture ? at(input.texture, uv) : input.value;
    }
    float at(scene::Input<float> const& input, Vec2 uv) const {
        return input.texture ? average(at(input.texture, uv)) : input.value;
    }
    /// Pixels of an image texture as (width, height); (1, 1) for a constant.
    Vec2i resolution(scene::TextureId id) const;

  private:
    std::vector<std::variant<ConstantLookup, ImageLookup, CheckerboardLookup>> lookups_;
};

} // namespace weft::shading
