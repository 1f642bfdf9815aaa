#include "image/tiled_file.h"

#include "base/error.h"
#include "image/input.h"
#include "image/tile_cache.h"

namespace weft::image {

namespace {

/// What stands for a texel that cannot be read.
alignas(16) constexpr auto kNoTexel = [] {
    struct {
        std::byte bytes[16];
    } texel{};
    for (std::byte& b : texel.bytes) b = std::byte(0xff);
    return texel;
}();

/// Reads the last tile of a level: a truncated file lacks the last of one of them.
void check_last_tile(OIIO::ImageInput& input, std::string const& path, int level) {
    OIIO::ImageSpec const spec = input.spec_dimensions(0, level);
    std::vector<std::byte> tile(spec.tile_bytes());
    int const x = spec.x + (spec.width - 1) / spec.tile_width * spec.tile_width,
              y = spec.y + (spec.height - 1) / spec.tile_height * spec.tile_height;
    check_read(input, path,
               input.seek_subimage(0, level) && input.read_tile(x, y, 0, spec.format, tile.data()));
}

} // namespace

TiledFile::TiledFile(std::shared_ptr<TileCache> cache, std::string const& path, Transfer transfer)
    : cache_(std::move(cache)), path_(path) {
    auto const input = open_flat_image(path);
    OIIO::ImageSpec const first = input->spec();
    if (first.tile_width < 1)
        throw InputError({path}, "expected an image in tiles, found one in rows");
    format_ = texel_format(first, transfer);
    for (int i = 0; input->seek_subimage(0, i); ++i) {
        OIIO::ImageSpec const spec = input->spec_dimensions(0, i);
        levels_.push_back({spec.width, spec.height, 0});
        places_.push_back({spec.x, spec.y, spec.tile_width, spec.tile_height});
        check_last_tile(*input, path, i);
    }
    (void)input->geterror(); // of the level after the last
    handle_ = cache_->tiles().get_image_handle(OIIO::ustring(path));
    if (!handle_ || !cache_->tiles().good(static_cast<OIIO::ImageCache::ImageHandle*>(handle_)))
        throw InputError({path}, "expected an image in tiles: " + cache_->tiles().geterror());
}

uint64_t TiledFile::texel_bytes() const {
    uint64_t texels = 0;
    for (MipLevel const& l : levels_) texels += uint64_t(l.width) * uint64_t(l.height);
    return texels * format_.bytes();
}

TiledFile::Quad::Quad(TiledFile const& file, int level, int const (&x)[2], int const (&y)[2])
    : file_(file) {
    OIIO::ImageCache& cache = file.cache_->tiles();
    auto* const handle = static_cast<OIIO::ImageCache::ImageHandle*>(file.handle_);
    auto* const thread = cache.get_perthread_info();
    Place const& place = file.places_[size_t(level)];
    int const tile_x[2] = {x[0] / place.tile_width, x[1] / place.tile_width},
              tile_y[2] = {y[0] / place.tile_height, y[1] / place.tile_height};
    std::byte const* texels[4] = {}; // of the tiles' first texels
    size_t const bytes = file.format_.bytes();
    for (int k = 0; k < 4; ++k) {
        int const i = k & 1, j = k >> 1;
        // Most often all four are in one tile, or two in each of two.
        int same = k;
        if (i == 1 && tile_x[0] == tile_x[1])
            same = k - 1;
        else if (j == 1 && tile_y[0] == tile_y[1])
            same = k - 2;
        if (same != k) {
            texels[k] = texels[same];
        } else {
            auto* const tile = cache.get_tile(handle, thread, 0, level, place.x + x[i],
                                              place.y + y[j], 0, 0, file.format_.channels);
            OIIO::TypeDesc type;
            if (tile) {
                tiles_[count_++] = tile;
                texels[k] = static_cast<std::byte const*>(cache.tile_pixels(tile, type));
            }
            if (!texels[k]) file.cache_->note_failure(file.path_);
        }
        int const within_x = x[i] - tile_x[i] * place.tile_width,
                  within_y = y[j] - tile_y[j] * place.tile_height;
        p[k] = texels[k]
                   ? texels[k] +
                         (size_t(within_y) * size_t(place.tile_width) + size_t(within_x)) * bytes
                   : kNoTexel.bytes;
    }
}

TiledFile::Quad::~Quad() {
    for (int i = 0; i < count_; ++i)
        file_.cache_->tiles().release_tile(static_cast<OIIO::ImageCache::Tile*>(tiles_[i]));
}

} // namespace weft::image
