#include "image/texture_cache.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/hash.h"
#include "image/image.h"
#include "image/shown_picture.h"
#include "image/texture_file.h"
#include "image/tile_cache.h"

namespace weft::image {

namespace fs = std::filesystem;

namespace {

/// To be counted up when converted files change, so that old ones are not taken for new.
constexpr char kFormatVersion[] = "2";

struct FileFacts {
    TexelFormat format;
    uint64_t texels = 0;
    bool has_tiles = false; ///< and mip levels, that a cache of tiles may read
    std::vector<std::string> warnings;
};

FileFacts facts_of(std::string const& path, Encoding encoding) {
    ShownPicture const file(path, encoding);
    return {file.format(), uint64_t(file.width()) * uint64_t(file.height()),
            file.is_as_stored() && file.is_in_tiles(), file.warnings()};
}

/// The name that a file's conversion has in the folder.
std::string converted_name(std::string const& path, Encoding encoding) {
    LayerPath const wanted = split_layer(path);
    fs::path const whole = fs::canonical(wanted.file);
    std::string const key = whole.string() + '\n' + wanted.layer + '\n' +
                            std::to_string(fs::file_size(whole)) + '\n' +
                            std::to_string(fs::last_write_time(whole).time_since_epoch().count()) +
                            '\n' + std::to_string(int(encoding.transfer)) +
                            (encoding.stated ? " stated\n" : "\n") + kFormatVersion;
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(hash64(hash_bytes(key))));
    return whole.stem().string() + "-" + digits + ".tx";
}

} // namespace

std::string default_texture_folder() {
    if (char const* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return std::string(cache) + "/weft/textures";
    if (char const* home = std::getenv("HOME"); home && *home)
        return std::string(home) + "/.cache/weft/textures";
    return "";
}

TextureCache::TextureCache(TextureCacheOptions options)
    : options_(std::move(options)), tiles_(std::make_shared<TileCache>()) {
    if (options_.folder.empty()) options_.folder = default_texture_folder();
    share_memory();
}

/// What images in memory leave, but at least a quarter.
uint64_t TextureCache::tile_limit() const {
    uint64_t const left = options_.memory - std::min(memory_bytes_, options_.memory);
    return std::max(left, options_.memory / 4);
}

void TextureCache::share_memory() { tiles_->limit(tile_limit()); }

std::shared_ptr<Texture const> TextureCache::load(ImageSource const& source, Encoding encoding,
                                                  bool mip_levels, Channels channels) {
    Key const key(source.path, encoding, channels);
    auto& texture = textures_[key];
    try {
        if (!texture) {
            texture = std::make_shared<Texture>(read(source, encoding, channels));
            if (!source.bytes) texture->source = std::make_shared<SourceFile const>(source.path);
        }
    } catch (...) {
        textures_.erase(key);
        throw;
    }
    if (mip_levels && texture->is_in_memory()) {
        memory_bytes_ -= texture->memory_bytes();
        texture->add_levels();
        memory_bytes_ += texture->memory_bytes();
        share_memory();
    }
    return texture;
}

Texture TextureCache::read(ImageSource const& source, Encoding encoding, Channels channels) {
    if (source.bytes || channels == Channels::alpha) return read_whole(source, encoding, channels);
    std::string const& path = source.path;
    FileFacts const facts = facts_of(path, encoding);
    auto const warn = [&] {
        for (std::string const& w : facts.warnings) warnings_.push_back(path + ": " + w);
    };
    if (facts.has_tiles) {
        warn();
        return in_tiles(path, facts.format.transfer);
    }
    uint64_t const bytes = facts.texels * facts.format.bytes();
    // Mip levels take another third.
    bool const fits = memory_bytes_ + bytes + bytes / 3 <= options_.memory / 2;
    if (facts.texels > options_.small_texels || !fits) {
        std::string const tiled = converted(path, facts.texels, encoding);
        if (!tiled.empty()) {
            warn();
            return in_tiles(tiled, facts.format.transfer);
        }
    }
    return read_whole(source, encoding, channels);
}

Texture TextureCache::read_whole(ImageSource const& source, Encoding encoding, Channels channels) {
    Texture texture = read_texture(source, encoding, channels, &warnings_);
    memory_bytes_ += texture.memory_bytes();
    share_memory();
    return texture;
}

Texture TextureCache::in_tiles(std::string const& path, Transfer transfer) {
    auto tiles = std::make_shared<TiledFile const>(tiles_, path, transfer);
    return Texture::in_tiles(tiles->format(), tiles->levels(), tiles);
}

/// The path of the converted file; "" where the folder cannot be written.
std::string TextureCache::converted(std::string const& path, uint64_t texels, Encoding encoding) {
    auto warn = [&](std::string const& reason) {
        warnings_.push_back(path +
                            ": read whole, whatever --texture-memory says: its conversion "
                            "cannot be kept in the texture cache folder: " +
                            reason);
        return "";
    };
    if (options_.folder.empty()) return warn("neither XDG_CACHE_HOME nor HOME is set");
    std::string const tiled = (fs::path(options_.folder) / converted_name(path, encoding)).string();
    if (fs::exists(tiled)) {
        try {
            if (facts_of(tiled, {Transfer::linear, true}).texels == texels) return tiled;
        } catch (InputError const&) {
            // Damaged; it is made anew.
        }
    }
    try {
        std::error_code ignored; // the file tells better
        fs::create_directories(options_.folder, ignored);
        make_texture_file(path, tiled, encoding, [&](double fraction) {
            if (options_.on_conversion) options_.on_conversion(path, fraction);
        });
    } catch (IoError const& e) {
        return warn(e.what());
    }
    return tiled;
}

std::string TextureCache::failure() const { return tiles_->failure(); }

TextureStatistics TextureCache::statistics() const {
    TextureStatistics s;
    for (auto const& [key, texture] : textures_) {
        ++(texture->is_in_memory() ? s.in_memory : s.in_tiles);
        s.memory_bytes += texture->memory_bytes();
        if (texture->tiles()) s.tile_bytes += texture->tiles()->texel_bytes();
    }
    s.tile_limit = tile_limit();
    s.read_bytes = tiles_->bytes_read();
    return s;
}

} // namespace weft::image
