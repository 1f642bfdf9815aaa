#include "image/texture.h"

#include <OpenImageIO/parallel.h>

#include <cassert>

namespace weft::image {

Texture Texture::in_memory(TexelFormat format, int width, int height,
                           std::vector<std::byte> texels) {
    assert(texels.size() == size_t(width) * size_t(height) * format.bytes());
    Texture t;
    t.width = width;
    t.height = height;
    t.format_ = format;
    t.table_ = decode_table(format).data();
    t.levels_ = {{width, height, 0}};
    t.texels_ = std::move(texels);
    return t;
}

Texture Texture::in_tiles(TexelFormat format, std::vector<MipLevel> levels,
                          std::shared_ptr<TiledFile const> tiles) {
    Texture t;
    t.width = levels.front().width;
    t.height = levels.front().height;
    t.format_ = format;
    t.table_ = decode_table(format).data();
    t.levels_ = std::move(levels);
    t.tiles_ = std::move(tiles);
    return t;
}

void Texture::add_levels() {
    if (tiles_ || levels_.size() > 1) return;
    size_t total = texels_.size();
    for (int i = 1; i < image::level_count(width, height); ++i) {
        MipLevel const& l = levels_.back();
        levels_.push_back({half_size(l.width), half_size(l.height), total});
        total += size_t(levels_.back().width) * size_t(levels_.back().height) * format_.bytes();
    }
    texels_.resize(total);
    for (size_t i = 1; i < levels_.size(); ++i) {
        MipLevel const &from = levels_[i - 1], &to = levels_[i];
        LevelReducer const reducer(format_, from.width, from.height);
        auto row_of = [&](MipLevel const& l, int y) {
            return texels_.data() + l.offset + size_t(y) * size_t(l.width) * format_.bytes();
        };
        OIIO::parallel_for(int64_t(0), int64_t(to.height), [&](int64_t y) {
            reducer.reduce_row(
                int(y), [&](int line) { return row_of(from, line); }, row_of(to, int(y)));
        });
    }
}

Texel Texture::texel(int level, int x, int y) const {
    return match_format(format_, [&]<TexelType type, int channels>() -> Texel {
        auto load = [&](std::byte const* p) -> Texel {
            auto const v = load_texel<type, channels>(p, table_);
            if constexpr (channels == 1)
                return Texel{v, v, v, v};
            else
                return v;
        };
        if (tiles_) return load(TiledFile::Quad(*tiles_, level, {x, x}, {y, y}).p[0]);
        return load(texels(level) + (size_t(y) * size_t(levels_[size_t(level)].width) + size_t(x)) *
                                        format_.bytes());
    });
}

} // namespace weft::image
