// A tiled image file with mip levels, of which OpenImageIO's ImageCache holds the tiles that were
// used last.
//
// The cache finds, reads and evicts tiles, for all threads; what is made of the texels is our own
// arithmetic and the same as for textures in memory. Its texture filters are not used: a texel's
// bits would then depend on where the texel lies.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "image/mip_levels.h"
#include "image/texel.h"

namespace weft::image {

class TileCache;

class TiledFile {
  public:
    /// Throws InputError where `path` is not a tiled image that can be read to its end.
    /// `transfer` is how integers in it encode colours.
    TiledFile(std::shared_ptr<TileCache> cache, std::string const& path, Transfer transfer);

    TexelFormat format() const { return format_; }
    std::vector<MipLevel> const& levels() const { return levels_; }
    uint64_t texel_bytes() const; ///< of all levels, unpacked

    /// Pointers to the texels (x0, y0), (x1, y0), (x0, y1), (x1, y1) of a level; their tiles stay
    /// in memory as long as it lives. Where the file cannot be read any more, which the cache
    /// remembers, floats are not-a-number and integers the largest there are.
    class Quad {
      public:
        Quad(TiledFile const& file, int level, int const (&x)[2], int const (&y)[2]);
        ~Quad();
        Quad(Quad const&) = delete;
        Quad& operator=(Quad const&) = delete;
        std::byte const* p[4];

      private:
        TiledFile const& file_;
        void* tiles_[4]; ///< the cache's own
        int count_ = 0;  ///< of tiles
    };

  private:
    std::shared_ptr<TileCache> cache_;
    std::string path_;
    void* handle_ = nullptr; ///< the cache's own
    TexelFormat format_;
    std::vector<MipLevel> levels_;
    /// Of a level: where its first texel is in the file's own coordinates, and its tiles' size.
    struct Place {
        int x, y, tile_width, tile_height;
    };
    std::vector<Place> places_;
};

} // namespace weft::image
