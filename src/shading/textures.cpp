#include "shading/textures.h"

namespace weft::shading {

namespace {

Color pixel(image::Image const& image, int x, int y) {
    float const* p =
        &image.pixels[(size_t(y) * size_t(image.width) + size_t(x)) * size_t(image.channels)];
    return image.channels >= 3 ? Color(p[0], p[1], p[2]) : Color(p[0]);
}

/// The pixel index that the border rule makes of any index.
int border_index(int i, int size, bool clamp) {
    if (unsigned(i) < unsigned(size)) [[likely]]
        return i; // a division costs more than the lookup
    if (clamp) return std::clamp(i, 0, size - 1);
    int const r = i % size;
    return r < 0 ? r + size : r;
}

/// floor() as an int; coordinates too large for one wrap around at a multiple that does no harm.
int floor_int(float x) { return int(std::floor(std::clamp(x, -1e9f, 1e9f))); }

} // namespace

Color ImageLookup::at(Vec2 uv) const {
    image::Image const& im = *image;
    float const x = uv.x * float(im.width), y = (1 - uv.y) * float(im.height);
    auto fetch = [&](int i, int j) {
        return pixel(im, border_index(i, im.width, clamp), border_index(j, im.height, clamp));
    };
    if (nearest) return exposure * fetch(floor_int(x), floor_int(y));
    float const fx = std::floor(x - 0.5f), fy = std::floor(y - 0.5f);
    int const i = floor_int(fx), j = floor_int(fy);
    float const s = x - 0.5f - fx, t = y - 0.5f - fy;
    Color const top = lerp(fetch(i, j), fetch(i + 1, j), s);
    Color const bottom = lerp(fetch(i, j + 1), fetch(i + 1, j + 1), s);
    return exposure * lerp(top, bottom, t);
}

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
