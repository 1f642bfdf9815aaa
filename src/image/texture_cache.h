// Which textures lie in memory and which in tiles, and the memory that both may take together.
//
// An image of at most 4096 x 4096 texels is read whole, as long as all such images together take no
// more than half of the memory. What is larger is read through OpenImageIO's tile cache
// (tiled_file.h), which has the rest; an image that is not in tiles with mip levels is converted
// once into a folder (texture_file.h), under a name made of its path, size, time of change and
// encoding, so that a changed file is converted anew. Where the folder cannot be written, a warning
// says so and the image is read whole. What is in memory as a file's bytes, and alpha, which few
// ask for, is always read whole. None of this changes a bit of a lookup.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "image/texture.h"

namespace weft::image {

class TileCache;

struct TextureCacheOptions {
    uint64_t memory = uint64_t(2) << 30; ///< bytes for the texels of all textures
    uint64_t small_texels = 4096 * 4096; ///< an image of no more is read whole
    std::string folder;                  ///< of converted images; "": `default_texture_folder()`
    /// Called while an image is converted: its path, and how much is done, in [0, 1].
    std::function<void(std::string const& path, double fraction)> on_conversion;
};

/// $XDG_CACHE_HOME/weft/textures, or ~/.cache/weft/textures; "" where neither is known.
std::string default_texture_folder();

struct TextureStatistics {
    size_t in_memory = 0, in_tiles = 0; ///< textures
    uint64_t memory_bytes = 0;          ///< of texels in memory, mip levels included
    uint64_t tile_bytes = 0;            ///< of all texels of those in tiles, read or not
    uint64_t tile_limit = 0;            ///< what the tile cache may take
    uint64_t read_bytes = 0;            ///< that the tile cache has read so far
};

class TextureCache {
  public:
    explicit TextureCache(TextureCacheOptions options = {});

    /// The texture in a file, with mip levels where asked for; loaded once per path and encoding.
    /// Not to be called by several threads at once, nor while a render reads the textures. Throws
    /// InputError like `read_image`.
    std::shared_ptr<Texture const> load(ImageSource const& source, Encoding encoding,
                                        bool mip_levels, Channels channels = Channels::color);

    /// What the user ought to know, since the last call.
    std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }
    /// Of a file that could not be read any more during a render; "" where there was none.
    std::string failure() const;
    TextureStatistics statistics() const;

  private:
    using Key = std::tuple<std::string, Encoding, Channels>;

    Texture read(ImageSource const& source, Encoding encoding, Channels channels);
    Texture read_whole(ImageSource const& source, Encoding encoding, Channels channels);
    std::string converted(std::string const& path, uint64_t texels, Encoding encoding);
    Texture in_tiles(std::string const& path, Transfer transfer);
    uint64_t tile_limit() const;
    void share_memory();

    TextureCacheOptions options_;
    std::shared_ptr<TileCache> tiles_;
    std::map<Key, std::shared_ptr<Texture>> textures_;
    std::vector<std::string> warnings_;
    uint64_t memory_bytes_ = 0; ///< of texels in memory
};

} // namespace weft::image
