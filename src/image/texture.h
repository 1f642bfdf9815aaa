// Textures as a render reads them: texels in the type of their file, with mip levels for lookups
// that see many texels at once.
//
// Texels lie in memory, or in a tiled file of which a cache (tiled_file.h) holds what was used
// last. Both are decoded by the same arithmetic, so that where a texel lies changes no bit. Screen
// colours stay as the file encodes them, a quarter of the size of floats.
//
// A texture holds a file's colours or its alpha: few lookups want both. Left out on purpose:
// further channels.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/mip_levels.h"
#include "image/source_file.h"
#include "image/texel.h"
#include "image/tiled_file.h"

namespace weft::image {

class Texture {
  public:
    /// `texels`: rows from the top, channels interleaved.
    static Texture in_memory(TexelFormat format, int width, int height,
                             std::vector<std::byte> texels);
    static Texture in_tiles(TexelFormat format, std::vector<MipLevel> levels,
                            std::shared_ptr<TiledFile const> tiles);

    /// Adds all smaller levels to a texture in memory that has none.
    void add_levels();

    /// The texels of a level in memory.
    std::byte const* texels(int level) const {
        return texels_.data() + levels_[size_t(level)].offset;
    }
    /// One texel as linear numbers, grey in all channels.
    Texel texel(int level, int x, int y) const;

    int level_count() const { return int(levels_.size()); }
    MipLevel const& level(int i) const { return levels_[size_t(i)]; }
    TexelFormat const& format() const { return format_; }
    float const* table() const { return table_; } ///< see `decode_table`
    bool is_in_memory() const { return !tiles_; }
    /// Of the texels held by this texture itself.
    uint64_t memory_bytes() const { return texels_.size(); }
    TiledFile const* tiles() const { return tiles_.get(); }

    int width = 0, height = 0;                ///< texels of level 0
    std::shared_ptr<SourceFile const> source; ///< null where it is of no file of its own

  private:
    TexelFormat format_;
    float const* table_ = nullptr;
    std::vector<MipLevel> levels_;
    std::vector<std::byte> texels_;
    std::shared_ptr<TiledFile const> tiles_;
};

/// How the user of a file reads its colours.
struct Encoding {
    Transfer transfer = Transfer::gamma22; ///< of integers
    bool stated = false;                   ///< what the file says of its colours does not count
    friend auto operator<=>(Encoding const&, Encoding const&) = default;
};

/// An image file: the one at `path` or, where there are `bytes`, a PNG or JPEG file in memory,
/// which `path` only names.
struct ImageSource {
    ImageSource(std::string file) : path(std::move(file)) {}
    ImageSource(std::string name, std::string_view file) : path(std::move(name)), bytes(file) {}

    std::string path;
    std::optional<std::string_view> bytes;
};

/// The whole picture in an image file (shown_picture.h), in memory. The alpha of a file that has
/// none is one texel of 1. Adds to `warnings` what the file says and we do not follow. Throws like
/// `read_image`.
Texture read_texture(ImageSource const& source, Encoding encoding,
                     Channels channels = Channels::color,
                     std::vector<std::string>* warnings = nullptr);

} // namespace weft::image
