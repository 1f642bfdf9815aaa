#include "shading/textures.h"

namespace weft::shading {

Textures::Textures(std::vector<scene::Texture> const& textures,
                   std::vector<std::shared_ptr<image::Image const>> const& images) {
    for (scene::Texture const& texture : textures) {
        std::visit(Overloaded{
                       [&](scene::ConstantTexture const& t) {
                           lookups_.emplace_back(ConstantLookup{t.value});
                       },
                       [&](scene::ImageTexture const& t) {
                           lookups_.emplace_back(
                               ImageLookup{images[size_t(t.filename.resource)], t.exposure,
                                           t.border == scene::TextureBorder::clamp,
                                           t.filter == scene::TextureFilter::nearest});
                       },
                       [&](scene::Checkerboard const& t) {
                           lookups_.emplace_back(CheckerboardLookup{t.color0, t.color1, t.scale});
                       },
                   },
                   texture);
    }
}

Vec2i Textures::resolution(scene::TextureId id) const {
    return match(
        lookups_[size_t(id.index)],
        Overloaded{[](ImageLookup const& l) { return Vec2i(l.image->width, l.image->height); },
                   [](CheckerboardLookup const&) { return Vec2i(512, 256); },
                   [](ConstantLookup const&) { return Vec2i(1, 1); }});
}

} // namespace weft::shading
