#include "shading/image_lookup.h"

#include <bit>

#include "base/feature.h"

namespace weft::shading {

namespace {

using image::Texel;

/// A coordinate in texels whose floor is an int. Those beyond a billion, and NaN, become a billion.
float bounded(float x) { return std::min(std::max(-1e9f, x), 1e9f); } // NaN: max gives the first

/// i modulo size, in [0, size). In double precision, which is exact here: an integer division costs
/// more than the lookup.
int wrapped(int i, int size) {
    if (unsigned(i) < unsigned(size)) [[likely]]
        return i;
    int const r = i - size * int(std::floor(double(i) / size));
    return r < 0 ? r + size : r >= size ? r - size : r;
}

int border_index(int i, int size, bool clamp) {
    return clamp ? std::clamp(i, 0, size - 1) : wrapped(i, size);
}

/// The two texels around a coordinate along one axis, and the weight of the second.
struct Pair {
    int first, second;
    float t;
};

/// Inlined by force: as a call it would put its result together in memory, and to read that back
/// costs more than all of the arithmetic.
[[gnu::always_inline]] inline Pair texels_around(float x, int size, bool clamp) {
    x = bounded(x);
    float const f = std::floor(x - 0.5f);
    int const i = int(f), first = border_index(i, size, clamp);
    int const second = clamp ? std::clamp(i + 1, 0, size - 1) : first + 1 < size ? first + 1 : 0;
    return {first, second, x - 0.5f - f};
}

Color to_color(float v) { return Color(v); }
Color to_color(Texel const& v) { return {v[0], v[1], v[2]}; }

template <class T>
[[gnu::always_inline]] inline T mix(T const& a, T const& b, float t) {
    return a + (b - a) * t;
}

/// A texel format, and whether texels are in tiles, known at compile time, so that all happens in
/// registers. Values are a float or a Texel.
template <image::TexelType type, int channels, bool tiled>
struct Reader {
    ImageLookup const& lookup;
    image::Texture const& im = *lookup.image;

    auto load(std::byte const* p) const { return image::load_texel<type, channels>(p, im.table()); }

    auto bilinear(int level, Vec2 uv) const {
        image::MipLevel const& size = im.level(level);
        Pair const x = texels_around(uv.x * float(size.width), size.width, lookup.clamp_u),
                   y = texels_around((1 - uv.y) * float(size.height), size.height, lookup.clamp_v);
        auto mixed = [&](auto p00, auto p10, auto p01, auto p11) {
            return mix(mix(load(p00), load(p10), x.t), mix(load(p01), load(p11), x.t), y.t);
        };
        if constexpr (tiled) {
            image::TiledFile::Quad const quad(*im.tiles(), level, {x.first, x.second},
                                              {y.first, y.second});
            return mixed(quad.p[0], quad.p[1], quad.p[2], quad.p[3]);
        } else {
            constexpr size_t bytes = image::TexelFormat{type, channels}.bytes();
            size_t const row = size_t(size.width) * bytes, i0 = size_t(x.first) * bytes,
                         i1 = size_t(x.second) * bytes;
            std::byte const *const row0 = im.texels(level) + size_t(y.first) * row,
                                   *const row1 = im.texels(level) + size_t(y.second) * row;
            return mixed(row0 + i0, row0 + i1, row1 + i0, row1 + i1);
        }
    }

    auto trilinear(Vec2 uv, float level) const {
        int const last = im.level_count() - 1;
        if (!(level > 0)) return bilinear(0, uv);
        if (level >= float(last)) return bilinear(last, uv);
        int const finer = int(level);
        return mix(bilinear(finer, uv), bilinear(finer + 1, uv), level - float(finer));
    }
};

Color nearest(ImageLookup const& l, Vec2 uv) {
    image::Texture const& im = *l.image;
    auto index = [](float x, int size, bool clamp) {
        return border_index(int(std::floor(bounded(x))), size, clamp);
    };
    return to_color(im.texel(0, index(uv.x * float(im.width), im.width, l.clamp_u),
                             index((1 - uv.y) * float(im.height), im.height, l.clamp_v)));
}

template <bool tiled>
Color filtered(ImageLookup const& l, Vec2 uv, UvFootprint const& footprint) {
    return image::match_format(l.image->format(), [&]<image::TexelType type, int channels>() {
        Reader<type, channels, tiled> const reader{l};
        return to_color(l.exposure * (l.filter == scene::TextureFilter::bilinear
                                          ? reader.bilinear(0, uv)
                                          : reader.trilinear(uv, l.level_of(footprint))));
    });
}

/// log2(x) / 2, taken as linear between powers of two (at most 0.043 too small): only a filter's
/// width hangs on it.
float half_log2(float x) {
    return 0.5f * (float(std::bit_cast<int32_t>(x) - 0x3f800000) * 0x1p-23f);
}

} // namespace

float ImageLookup::level_of(UvFootprint const& f) const {
    float const w = float(image->width), h = float(image->height);
    float const a = square(f.a.x * w) + square(f.a.y * h),
                b = square(f.b.x * w) + square(f.b.y * h);
    constexpr float anisotropy = 4;
    float const width = std::max(std::min(a, b), std::max(a, b) * (1 / square(anisotropy)));
    return width > 1 ? half_log2(width) : 0;
}

Color ImageLookup::at(Vec2 uv, UvFootprint const& footprint) const {
    FeatureScope const scope(Feature::Textures);
    if (filter == scene::TextureFilter::nearest) return exposure * nearest(*this, uv);
    return image->is_in_memory() ? filtered<false>(*this, uv, footprint)
                                 : filtered<true>(*this, uv, footprint);
}

} // namespace weft::shading
