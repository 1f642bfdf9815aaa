#include "shading/image_lookup.h"

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

} // namespace weft::shading
